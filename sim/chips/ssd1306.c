#include "ssd1306.h"

enum { HORIZONTAL = 0, VERTICAL = 1, PAGE = 2 };

/* Section 9; the charge pump is in the application note at its end. */
static const sim_oled_command_t commands[] = {
    {0x00, 0x0F, 0, 0},                     /* column of page addressing, lower half */
    {0x10, 0x1F, 0, 0},                     /* upper half */
    {0x20, 0x20, 1, 0},                     /* addressing mode */
    {0x21, 0x21, 2, 0},                     /* columns */
    {0x22, 0x22, 2, 0},                     /* pages */
    {0x26, 0x27, 6, SIM_OLED_NOT_MODELLED}, /* horizontal scroll */
    {0x29, 0x2A, 5, SIM_OLED_NOT_MODELLED}, /* vertical and horizontal scroll */
    {0x2E, 0x2E, 0, 0},                     /* scroll off */
    {0x2F, 0x2F, 0, SIM_OLED_NOT_MODELLED}, /* scroll on */
    {0x40, 0x7F, 0, 0},                     /* start line */
    {0x81, 0x81, 1, 0},                     /* contrast */
    {0x8D, 0x8D, 1, 0},                     /* charge pump */
    {0xA0, 0xA1, 0, 0},                     /* segment remap */
    {0xA3, 0xA3, 2, SIM_OLED_NOT_MODELLED}, /* vertical scroll area */
    {0xA4, 0xA5, 0, 0},                     /* memory shown, all on */
    {0xA6, 0xA7, 0, 0},                     /* normal, inverse */
    {0xA8, 0xA8, 1, 0},                     /* multiplex ratio */
    {0xAE, 0xAF, 0, 0},                     /* off, on */
    {0xB0, 0xB7, 0, 0},                     /* page of page addressing */
    {0xC0, 0xC0, 0, 0},                     /* scan from COM0 */
    {0xC8, 0xC8, 0, 0},                     /* scan to COM0 */
    {0xD3, 0xD3, 1, 0},                     /* display offset */
    {0xD5, 0xD5, 1, 0},                     /* clock */
    {0xD9, 0xD9, 1, 0},                     /* pre-charge */
    {0xDA, 0xDA, 1, 0},                     /* wiring of the commons */
    {0xDB, 0xDB, 1, 0},                     /* VCOMH */
    {0xE3, 0xE3, 0, 0},                     /* nothing */
};

static void defaults(sim_oled_t *oled) {
    oled->addressing = PAGE;                                          /* 10.1.3 */
    oled->contrast[0] = oled->contrast[1] = oled->contrast[2] = 0x7F; /* 10.1.7 */
    oled->commons_split = true;                                       /* 10.1.18 */
    oled->unpowered = true;
}

static int set_addressing(sim_oled_t *oled, uint8_t mode) {
    oled->addressing = mode;
    oled->vertical = mode == VERTICAL;
    oled->placed = 0;
    return sim_oled_check(oled, "addressing mode", mode, HORIZONTAL, PAGE);
}

/* 10.1.4 and 10.1.5 are for horizontal and vertical addressing, 10.1.1, 10.1.2 and 10.1.13 for page addressing. */
static int check_addressing(sim_oled_t *oled, bool of_pages) {
    if ((oled->addressing == PAGE) == of_pages) { return 0; }
    return SIM_OLED_REFUSE(oled, "%s: command %02Xh is not for addressing mode %u", oled->chip.name, oled->code, oled->addressing);
}

static int execute(sim_oled_t *oled, uint8_t code, const uint8_t *p) {
    if ((code <= 0x1F || (code >= 0xB0 && code <= 0xB7)) && check_addressing(oled, true)) { return -1; }
    switch (code) {
    case 0x20: return set_addressing(oled, p[0]);
    case 0x21: return check_addressing(oled, false) ? -1 : sim_oled_columns(oled, p[0], p[1]);
    case 0x22: return check_addressing(oled, false) ? -1 : sim_oled_rows(oled, p[0], p[1]);
    case 0x8D: oled->unpowered = !(p[0] & 0x04); return sim_oled_check(oled, "charge pump", p[0] & 0xFBu, 0x10, 0x10);
    default: return sim_oled_mono_execute(oled, code, p);
    }
}

static const sim_oled_part_t part = {
    .name = "SSD1306",
    .width = 128,
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
    .rated_clock_hz = 10000000, /* a cycle of 100 ns, table 13-4 */
    .reset_pulse_us = 3,        /* 8.9 */
    .settle_us = 3,             /* the same */
};

/* Modules are run at a contrast of CFh and are no brighter here beyond it. */
sim_chip_t *sim_ssd1306_128x64_create(sim_error_t *error) {
    static const sim_oled_module_t module = {
        .width = 128,
        .height = 64,
        .segments_reversed = true,
        .commons_reversed = true,
        .commons_split = true,
        .full = {0xCF, 0xCF, 0xCF},
    };
    return sim_oled_create(&part, &module, error);
}

sim_chip_t *sim_ssd1306_128x32_create(sim_error_t *error) {
    static const sim_oled_module_t module = {
        .width = 128,
        .height = 32,
        .segments_reversed = true,
        .commons_reversed = true,
        .full = {0xCF, 0xCF, 0xCF},
    };
    return sim_oled_create(&part, &module, error);
}
