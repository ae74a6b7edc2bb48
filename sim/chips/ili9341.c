#include "ili9341.h"

/* Counts of parameters from the list of commands (8.1) and the descriptions (8.2 to 8.4). The two disagree about B8h to BBh,
 * where the list has one dummy parameter more. NV memory (D0h, D1h) is left out on purpose: it burns fuses. */
static const sim_dcs_command_t commands[] = {
    {0x26, 1, 1},   /* gamma set */
    {0x44, 2, 2},   /* set tear scanline */
    {0x51, 1, 1},   /* write display brightness */
    {0x53, 1, 1},   /* write CTRL display */
    {0x55, 1, 1},   /* adaptive brightness */
    {0x5E, 1, 1},   /* adaptive brightness, minimum */
    {0xB0, 1, 1},   /* RGB interface signal control */
    {0xB1, 2, 2},   /* frame rate, normal mode */
    {0xB2, 2, 2},   /* frame rate, idle mode */
    {0xB3, 2, 2},   /* frame rate, partial mode */
    {0xB4, 1, 1},   /* display inversion control */
    {0xB5, 4, 4},   /* blanking porch */
    {0xB6, 3, 4},   /* display function; the fourth divides a clock of the RGB interface, and drivers leave it out */
    {0xB7, 1, 1},   /* entry mode */
    {0xB8, 1, 2},   /* backlight control 1 */
    {0xB9, 1, 2},   /* 2 */
    {0xBA, 1, 2},   /* 3 */
    {0xBB, 1, 2},   /* 4 */
    {0xBC, 1, 1},   /* 5 */
    {0xBE, 1, 1},   /* 7 */
    {0xBF, 1, 1},   /* 8 */
    {0xC0, 1, 1},   /* power control 1 */
    {0xC1, 1, 1},   /* power control 2 */
    {0xC5, 2, 2},   /* VCOM control 1 */
    {0xC7, 1, 1},   /* VCOM control 2 */
    {0xCB, 5, 5},   /* power control A */
    {0xCF, 3, 3},   /* power control B */
    {0xE0, 15, 15}, /* positive gamma */
    {0xE1, 15, 15}, /* negative gamma */
    {0xE2, 16, 16}, /* digital gamma 1 */
    {0xE3, 64, 64}, /* digital gamma 2 */
    {0xE8, 3, 3},   /* driver timing A */
    {0xEA, 2, 2},   /* driver timing B */
    {0xED, 4, 4},   /* power on sequence */
    {0xEF, 3, 3},   /* undocumented; the modules' own programs send it so */
    {0xF2, 1, 1},   /* enable 3 gamma */
    {0xF6, 3, 3},   /* interface control */
    {0xF7, 1, 1},   /* pump ratio */
};

/* Interface control (8.3.31): all at reset's values but WEMODE. */
static const sim_dcs_rule_t rules[] = {{0xF6, 0, 0xFE, 0}, {0xF6, 1, 0xFF, 0}, {0xF6, 2, 0xFF, 0}};

const sim_dcs_part_t sim_ili9341_part = {
    .name = "ILI9341",
    .width = 240,
    .height = 320,
    .commands = commands,
    .command_count = sizeof commands / sizeof commands[0],
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
    .formats = {{5, 16}, {6, 18}}, /* 8.2.33 */
    .parallel = 1 << 0 | 1 << 5 | 1 << 6,
    .format_at_reset = 0x66,
    .scan_command = 0xB6,
    .wrap_command = 0xF6,
    .id_command = 0xD3, /* 8.3.23 */
    .id = {0x00, 0x93, 0x41},
    .rated_clock_hz = 10000000, /* twc = 100 ns, 18.3.4 */
    .settle_ms = 5,             /* 8.2.2, 8.2.11, 8.2.12 */
    .sleep_ms = 120,            /* the same */
    .reset_pulse_us = 10,       /* 12.2 */
};

sim_chip_t *sim_ili9341_create(sim_error_t *error) {
    return sim_dcs_create(&sim_ili9341_part, &(sim_dcs_module_t){.rows_reversed = true, .bgr = true}, error);
}
