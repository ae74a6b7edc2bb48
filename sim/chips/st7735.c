#include "st7735.h"

/* Counts of parameters from the panel commands (10.2). What burns the NV memory (D1h, D2h, D9h, DEh, DFh) is left out on purpose.
 */
static const sim_dcs_command_t commands[] = {
    {0x26, 1, 1, false},   /* GAMSET */
    {0xB1, 3, 3, false},   /* FRMCTR1 */
    {0xB2, 3, 3, false},   /* FRMCTR2 */
    {0xB3, 6, 6, false},   /* FRMCTR3 */
    {0xB4, 1, 1, false},   /* INVCTR */
    {0xC0, 3, 3, false},   /* PWCTR1 */
    {0xC1, 1, 1, false},   /* PWCTR2 */
    {0xC2, 2, 2, false},   /* PWCTR3 */
    {0xC3, 2, 2, false},   /* PWCTR4 */
    {0xC4, 2, 2, false},   /* PWCTR5 */
    {0xC5, 1, 1, false},   /* VMCTR1 */
    {0xC7, 1, 1, false},   /* VMOFCTR */
    {0xE0, 16, 16, false}, /* GMCTRP1 */
    {0xE1, 16, 16, false}, /* GMCTRN1 */
};

/* 4 and 5 bits go through a table (RGBSET) that is taken to repeat the upper ones. Resets and changes of sleep bar all commands for
 * 120 ms, not for 5 as with the other chips. */
/* clang-format off */
#define PART(columns, rows)                                                                                     \
    {                                                                                                           \
        .name = "ST7735", .width = (columns), .height = (rows),                                                 \
        .commands = commands, .command_count = sizeof commands / sizeof commands[0],                            \
        .formats = {{3, 12}, {5, 16}, {6, 18}}, .format_at_reset = 0x06,                                        \
        .parallel = 0xFF, /* the upper bits do not matter */                                                    \
        .id_command = 0x04, .id = {0x5C, 0x89, 0xF0},                                                           \
        .rated_clock_hz = 15151515, /* TSCYCW = 66 ns */                                                        \
        .settle_ms = 120, .sleep_ms = 120, .reset_pulse_us = 10,                                                \
    }
/* clang-format on */

const sim_dcs_part_t sim_st7735_132x162_part = PART(132, 162);
const sim_dcs_part_t sim_st7735_132x132_part = PART(132, 132);
const sim_dcs_part_t sim_st7735_128x160_part = PART(128, 160);

/* What a module is, but for the way in which all of them lie. */
static sim_chip_t *create(const sim_dcs_part_t *part, sim_dcs_module_t module, sim_error_t *error) {
    module.columns_reversed = module.rows_reversed = true;
    return sim_dcs_create(part, &module, error);
}

sim_chip_t *sim_st7735_128x160_create(sim_error_t *error) {
    return create(&sim_st7735_128x160_part, (sim_dcs_module_t){.bgr = true}, error);
}

sim_chip_t *sim_st7735_128x160_green_create(sim_error_t *error) {
    return create(&sim_st7735_132x162_part,
                  (sim_dcs_module_t){.bgr = true, .first_column = 2, .first_row = 1, .width = 128, .height = 160}, error);
}

sim_chip_t *sim_st7735_128x128_create(sim_error_t *error) {
    return create(&sim_st7735_132x132_part,
                  (sim_dcs_module_t){.bgr = true, .first_column = 2, .first_row = 1, .width = 128, .height = 128}, error);
}

sim_chip_t *sim_st7735_80x160_create(sim_error_t *error) {
    return create(
        &sim_st7735_132x162_part,
        (sim_dcs_module_t){.bgr = true, .normally_black = true, .first_column = 26, .first_row = 1, .width = 80, .height = 160},
        error);
}

sim_chip_t *sim_st7735_80x160_0_create(sim_error_t *error) {
    return create(&sim_st7735_128x160_part, (sim_dcs_module_t){.first_column = 24, .width = 80, .height = 160}, error);
}
