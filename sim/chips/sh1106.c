#include "sh1106.h"

/* The list of commands; there is no window, and no mode but that of pages. */
static const sim_oled_command_t commands[] = {
    {0x00, 0x0F, 0, 0},                     /* column, lower half */
    {0x10, 0x1F, 0, 0},                     /* upper half */
    {0x30, 0x33, 0, 0},                     /* voltage of the charge pump */
    {0x40, 0x7F, 0, 0},                     /* start line */
    {0x81, 0x81, 1, 0},                     /* contrast */
    {0xA0, 0xA1, 0, 0},                     /* segment remap */
    {0xA4, 0xA5, 0, 0},                     /* memory shown, all on */
    {0xA6, 0xA7, 0, 0},                     /* normal, inverse */
    {0xA8, 0xA8, 1, 0},                     /* multiplex ratio */
    {0xAD, 0xAD, 1, 0},                     /* charge pump */
    {0xAE, 0xAF, 0, 0},                     /* off, on */
    {0xB0, 0xB7, 0, 0},                     /* page */
    {0xC0, 0xC0, 0, 0},                     /* scan from COM0 */
    {0xC8, 0xC8, 0, 0},                     /* scan to COM0 */
    {0xD3, 0xD3, 1, 0},                     /* display offset */
    {0xD5, 0xD5, 1, 0},                     /* clock */
    {0xD9, 0xD9, 1, 0},                     /* discharge, pre-charge */
    {0xDA, 0xDA, 1, 0},                     /* wiring of the commons */
    {0xDB, 0xDB, 1, 0},                     /* VCOM */
    {0xE0, 0xE0, 0, SIM_OLED_NOT_MODELLED}, /* read, modify and write */
    {0xE3, 0xE3, 0, 0},                     /* nothing */
    {0xEE, 0xEE, 0, SIM_OLED_NOT_MODELLED}, /* the end of read, modify and write */
};

static void defaults(sim_oled_t *oled) {
    oled->column_ends = true; /* the counter stops at 83h */
    oled->contrast[0] = oled->contrast[1] = oled->contrast[2] = 0x80;
    oled->commons_split = true;
}

static int execute(sim_oled_t *oled, uint8_t code, const uint8_t *p) {
    if (code != 0xAD) { return sim_oled_mono_execute(oled, code, p); }
    oled->unpowered = p[0] == 0x8A;
    return sim_oled_check(oled, "charge pump", p[0], 0x8A, 0x8B);
}

static const sim_oled_part_t part = {
    .name = "SH1106",
    .width = 132,
    .height = 64,
    .column_pixels = 1,
    .row_pixels = 8,
    .unit_bytes = 1,
    .white = 1,
    .parameters_low = true,
    .commands = commands,
    .command_count = sizeof commands / sizeof commands[0],
    .defaults = defaults,
    .execute = execute,
    .store = sim_oled_mono_store,
    .colour = sim_oled_mono_colour,
    .rated_clock_hz = 4000000, /* a cycle of 250 ns */
    .reset_pulse_us = 10,      /* unverified, and the next too */
    .settle_us = 2,
};

sim_chip_t *sim_sh1106_create(sim_error_t *error) {
    static const sim_oled_module_t module = {
        .width = 128,
        .height = 64,
        .first_segment = 2,
        .segments_reversed = true,
        .commons_reversed = true,
        .commons_split = true,
        .full = {0xCF, 0xCF, 0xCF},
    };
    return sim_oled_create(&part, &module, error);
}
