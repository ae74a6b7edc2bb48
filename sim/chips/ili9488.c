#include "ili9488.h"

/* Counts of parameters from the list of commands (5.1). What burns the NV memory (D0h, D1h) is left out on purpose. */
static const sim_dcs_command_t commands[] = {
    {0x44, 2, 2, false},   /* tear scan line on */
    {0x51, 1, 1, false},   /* write display brightness */
    {0x53, 1, 1, false},   /* write CTRL display */
    {0x55, 1, 1, false},   /* adaptive brightness */
    {0x5E, 1, 1, false},   /* adaptive brightness, minimum */
    {0xB0, 1, 1, false},   /* interface mode control */
    {0xB1, 2, 2, false},   /* frame rate, normal mode */
    {0xB2, 2, 2, false},   /* frame rate, idle mode */
    {0xB3, 2, 2, false},   /* frame rate, partial mode */
    {0xB4, 1, 1, false},   /* display inversion control */
    {0xB5, 4, 4, false},   /* blanking porch */
    {0xB6, 3, 3, false},   /* display function */
    {0xB7, 1, 1, false},   /* entry mode */
    {0xB9, 1, 1, false},   /* colour enhancement 1 */
    {0xBA, 1, 1, false},   /* 2 */
    {0xBE, 1, 1, false},   /* HS lanes */
    {0xC0, 2, 2, false},   /* power control 1 */
    {0xC1, 1, 1, false},   /* 2 */
    {0xC2, 1, 1, false},   /* 3: normal mode */
    {0xC3, 1, 1, false},   /* 4: idle mode */
    {0xC4, 1, 1, false},   /* 5: partial mode */
    {0xC5, 3, 4, false},   /* VCOM control; the fourth can only be read */
    {0xE0, 15, 15, false}, /* positive gamma */
    {0xE1, 15, 15, false}, /* negative gamma */
    {0xE2, 16, 16, false}, /* digital gamma 1 */
    {0xE3, 64, 64, false}, /* 2 */
    {0xE9, 1, 1, false},   /* set image function */
    {0xF7, 4, 4, false},   /* adjust control 3 */
};

static const sim_dcs_rule_t rules[] = {
    {0xB6, 0, 0x2C, 0x00}, /* RM, DM: memory and display by the command interface */
    {0xB6, 1, 0x10, 0x00}, /* SM: gates in one run; GS and SS are decoded */
    {0xB6, 2, 0x3F, 0x3B}, /* NL: 480 lines */
    {0xB7, 0, 0x0F, 0x06}, /* normal display, not in deep standby */
};

const sim_dcs_part_t sim_ili9488_part = {
    .name = "ILI9488",
    .width = 320,
    .height = 480,
    .commands = commands,
    .command_count = sizeof commands / sizeof commands[0],
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
    .formats = {{1, 3}, {6, 18}}, /* 16 and 24 bits are the parallel interfaces' */
    .parallel = 1 << 0 | 1 << 5 | 1 << 6 | 1 << 7,
    .format_at_reset = 0x66,
    .scan_command = 0xB6,
    .id_command = 0xD3,
    .id = {0x00, 0x94, 0x88},
    .rated_clock_hz = 20000000, /* 50 ns, 17.4.3 */
    .settle_ms = 5,
    .sleep_ms = 120,
    .reset_pulse_us = 10,
};

sim_chip_t *sim_ili9488_create(sim_error_t *error) {
    return sim_dcs_create(&sim_ili9488_part, &(sim_dcs_module_t){.columns_reversed = true, .bgr = true}, error);
}
