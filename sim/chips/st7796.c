#include "st7796.h"

/* Counts of parameters from the two tables of commands. The second is closed until CSCON has opened both its parts. What burns the
 * NV memory (D0h to D2h) is left out on purpose. */
static const sim_dcs_command_t commands[] = {
    {0x44, 2, 2, false},  /* STE */
    {0x51, 1, 1, false},  /* WRDISBV */
    {0x53, 1, 1, false},  /* WRCTRLD */
    {0x55, 1, 1, false},  /* WRCABC */
    {0x5E, 1, 1, false},  /* WRCABCMB */
    {0xF0, 1, 1, false},  /* CSCON */
    {0xB0, 1, 1, true},   /* IFMODE */
    {0xB1, 2, 2, true},   /* FRMCTR1 */
    {0xB2, 2, 2, true},   /* FRMCTR2 */
    {0xB3, 2, 2, true},   /* FRMCTR3 */
    {0xB4, 1, 1, true},   /* DIC */
    {0xB5, 4, 4, true},   /* BPC */
    {0xB6, 3, 3, true},   /* DFC */
    {0xB7, 1, 1, true},   /* EM */
    {0xC0, 2, 2, true},   /* PWR1 */
    {0xC1, 1, 1, true},   /* PWR2 */
    {0xC2, 1, 1, true},   /* PWR3 */
    {0xC5, 1, 1, true},   /* VCMPCTL */
    {0xC6, 1, 1, true},   /* VCM offset */
    {0xE0, 14, 14, true}, /* PGC */
    {0xE1, 14, 14, true}, /* NGC */
    {0xE2, 64, 64, true}, /* DGC1 */
    {0xE3, 64, 64, true}, /* DGC2 */
    {0xE8, 8, 8, true},   /* DOCA */
};

static const sim_dcs_key_t keys[] = {
    {.code = 0xF0, .parameter = 0xC3, .opens = 1},
    {.code = 0xF0, .parameter = 0x96, .opens = 2},
    {.code = 0xF0, .parameter = 0x3C, .closes = 1},
    {.code = 0xF0, .parameter = 0x69, .closes = 2},
};

static const sim_dcs_rule_t rules[] = {
    {0xB6, 0, 0x2C, 0x00}, /* RM, DM: memory and display by the command interface */
    {0xB6, 1, 0x10, 0x00}, /* SM: gates in one run; GS and SS are decoded */
    {0xB6, 2, 0x3F, 0x3B}, /* NL: 480 lines */
};

const sim_dcs_part_t sim_st7796_part = {
    .name = "ST7796S",
    .width = 320,
    .height = 480,
    .commands = commands,
    .command_count = sizeof commands / sizeof commands[0],
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
    .keys = keys,
    .key_count = sizeof keys / sizeof keys[0],
    .locks = 3,
    .formats = {{5, 16}, {6, 18}},
    .parallel = 1 << 0 | 1 << 5 | 1 << 6 | 1 << 7,
    .format_at_reset = 0x66,
    .scan_command = 0xB6,
    .id_command = 0xD3,
    .id = {0x00, 0x77, 0x96},
    .rated_clock_hz = 15151515, /* TSCYCW = 66 ns */
    .settle_ms = 5,
    .sleep_ms = 120,
    .reset_pulse_us = 10,
};

sim_chip_t *sim_st7796_create(sim_error_t *error) {
    return sim_dcs_create(&sim_st7796_part, &(sim_dcs_module_t){.columns_reversed = true, .bgr = true}, error);
}
