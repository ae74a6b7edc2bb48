#include "st7789.h"

/* Counts of parameters from the two tables of commands. What burns the NV memory (ECh, FAh, FCh, FEh) is left out on purpose. */
static const sim_dcs_command_t commands[] = {
    {0x26, 1, 1, false},   /* GAMSET */
    {0x44, 2, 2, false},   /* STE */
    {0x51, 1, 1, false},   /* WRDISBV */
    {0x53, 1, 1, false},   /* WRCTRLD */
    {0x55, 1, 1, false},   /* WRCACE */
    {0x5E, 1, 1, false},   /* WRCABCMB */
    {0xB0, 2, 2, false},   /* RAMCTRL */
    {0xB1, 3, 3, false},   /* RGBCTRL */
    {0xB2, 5, 5, false},   /* PORCTRL */
    {0xB3, 3, 3, false},   /* FRCTRL1 */
    {0xB5, 1, 1, false},   /* PARCTRL */
    {0xB7, 1, 1, false},   /* GCTRL */
    {0xB8, 4, 4, false},   /* GTADJ */
    {0xBA, 1, 1, false},   /* DGMEN */
    {0xBB, 1, 1, false},   /* VCOMS */
    {0xBC, 1, 1, false},   /* POWSAVE */
    {0xBD, 1, 1, false},   /* DLPOFFSAVE */
    {0xC0, 1, 1, false},   /* LCMCTRL */
    {0xC1, 3, 3, false},   /* IDSET */
    {0xC2, 1, 2, false},   /* VDVVRHEN; the second is always FFh, and drivers leave it out */
    {0xC3, 1, 1, false},   /* VRHS */
    {0xC4, 1, 1, false},   /* VDVS */
    {0xC5, 1, 1, false},   /* VCMOFSET */
    {0xC6, 1, 1, false},   /* FRCTRL2 */
    {0xC7, 1, 1, false},   /* CABCCTRL */
    {0xC8, 1, 1, false},   /* REGSEL1 */
    {0xCA, 1, 1, false},   /* REGSEL2 */
    {0xCC, 1, 1, false},   /* PWMFRSEL */
    {0xD0, 2, 2, false},   /* PWCTRL1 */
    {0xD2, 1, 1, false},   /* VAPVANEN */
    {0xDF, 4, 4, false},   /* CMD2EN */
    {0xE0, 14, 14, false}, /* PVGAMCTRL */
    {0xE1, 14, 14, false}, /* NVGAMCTRL */
    {0xE2, 64, 64, false}, /* DGMLUTR */
    {0xE3, 64, 64, false}, /* DGMLUTB */
    {0xE4, 3, 3, false},   /* GATECTRL */
    {0xE8, 1, 1, false},   /* PWCTRL2 */
    {0xE9, 3, 3, false},   /* EQCTRL */
};

static const sim_dcs_rule_t rules[] = {
    {0xB0, 0, 0xFF, 0x00}, /* RAMCTRL: memory and display by the command interface */
    {0xB0, 1, 0xC7, 0xC0}, /* two fixed bits, RIM and MDT as at reset; EPF and ENDIAN are decoded */
    {0xC0, 0, 0xFF, 0x2C}, /* LCMCTRL turns bits of MADCTL about: as at reset, which the modules are made for */
    {0xE4, 0, 0xFF, 0x27}, /* GATECTRL: 320 lines from G1 on */
    {0xE4, 1, 0xFF, 0x00}, {0xE4, 2, 0xFF, 0x10},
};

const sim_dcs_part_t sim_st7789_part = {
    .name = "ST7789",
    .width = 240,
    .height = 320,
    .commands = commands,
    .command_count = sizeof commands / sizeof commands[0],
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
    .formats = {{3, 12}, {5, 16}, {6, 18}},
    .parallel = 1 << 0 | 1 << 5 | 1 << 6,
    .format_at_reset = 0x66,
    .ram_control_command = 0xB0,
    .id_command = 0x04,
    .id = {0x85, 0x85, 0x52},
    .rated_clock_hz = 62500000, /* TSCYCW = 16 ns */
    .settle_ms = 5,
    .sleep_ms = 120,
    .reset_pulse_us = 10,
};

/* All of them IPS, red first, upright as the memory is. */
static sim_chip_t *create(uint16_t width, uint16_t height, uint16_t first_column, uint16_t first_row, sim_error_t *error) {
    const sim_dcs_module_t module = {
        .normally_black = true, .first_column = first_column, .first_row = first_row, .width = width, .height = height};

    return sim_dcs_create(&sim_st7789_part, &module, error);
}

sim_chip_t *sim_st7789_240x320_create(sim_error_t *error) { return create(240, 320, 0, 0, error); }
sim_chip_t *sim_st7789_240x240_create(sim_error_t *error) { return create(240, 240, 0, 0, error); }
sim_chip_t *sim_st7789_135x240_create(sim_error_t *error) { return create(135, 240, 52, 40, error); }
sim_chip_t *sim_st7789_170x320_create(sim_error_t *error) { return create(170, 320, 35, 0, error); }
sim_chip_t *sim_st7789_172x320_create(sim_error_t *error) { return create(172, 320, 34, 0, error); }
sim_chip_t *sim_st7789_240x280_create(sim_error_t *error) { return create(240, 280, 0, 20, error); }
