#include "ssd1351.h"

/* Section 9. */
static const sim_oled_command_t commands[] = {
    {0x15, 0x15, 2, 0},                     /* columns */
    {0x5C, 0x5C, 0, 0},                     /* memory write */
    {0x5D, 0x5D, 0, SIM_OLED_NOT_MODELLED}, /* memory read */
    {0x75, 0x75, 2, 0},                     /* rows */
    {0x96, 0x96, 5, SIM_OLED_NOT_MODELLED}, /* horizontal scroll */
    {0x9E, 0x9E, 0, 0},                     /* scroll off */
    {0x9F, 0x9F, 0, SIM_OLED_NOT_MODELLED}, /* scroll on */
    {0xA0, 0xA0, 1, 0},                     /* remap, colours */
    {0xA1, 0xA1, 1, 0},                     /* start line */
    {0xA2, 0xA2, 1, SIM_OLED_GUARDED},      /* display offset */
    {0xA4, 0xA7, 0, 0},                     /* all off, all on, normal, inverse */
    {0xAB, 0xAB, 1, 0},                     /* regulator, interface */
    {0xAD, 0xAD, 0, 0},                     /* nothing */
    {0xAE, 0xAF, 0, 0},                     /* off, on */
    {0xB0, 0xB0, 0, 0},                     /* nothing */
    {0xB1, 0xB1, 1, SIM_OLED_GUARDED},      /* phases */
    {0xB2, 0xB2, 3, 0},                     /* enhancement */
    {0xB3, 0xB3, 1, SIM_OLED_GUARDED},      /* clock */
    {0xB4, 0xB4, 3, 0},                     /* low voltage of the segments */
    {0xB5, 0xB5, 1, 0},                     /* pins */
    {0xB6, 0xB6, 1, 0},                     /* second pre-charge */
    {0xB8, 0xB8, 63, 0},                    /* table of greys */
    {0xB9, 0xB9, 0, 0},                     /* linear greys */
    {0xBB, 0xBB, 1, SIM_OLED_GUARDED},      /* pre-charge voltage */
    {0xBE, 0xBE, 1, SIM_OLED_GUARDED},      /* VCOMH */
    {0xC1, 0xC1, 3, SIM_OLED_GUARDED},      /* contrasts of A, B and C */
    {0xC7, 0xC7, 1, 0},                     /* master current */
    {0xCA, 0xCA, 1, 0},                     /* multiplex ratio */
    {0xD1, 0xD1, 0, 0},                     /* nothing */
    {0xE3, 0xE3, 0, 0},                     /* nothing */
    {0xFD, 0xFD, 1, 0},                     /* lock */
};

static void defaults(sim_oled_t *oled) {
    oled->guarded = true;
    oled->offset = 0x60;
    oled->commons_split = true;
    oled->contrast[0] = oled->contrast[2] = 0x8A;
    oled->contrast[1] = 0x51;
}

static int remap(sim_oled_t *oled, uint8_t p) {
    oled->vertical = (p & 0x01) != 0;
    oled->segments_remapped = (p & 0x02) != 0;
    oled->colours_swapped = (p & 0x04) != 0;
    oled->commons_remapped = (p & 0x10) != 0;
    oled->commons_split = (p & 0x20) != 0;
    oled->placed = 0;
    if (p & 0x08) { return SIM_OLED_REFUSE(oled, "%s: remap %02Xh has a reserved bit", oled->chip.name, p); }
    return p >> 6 == 1 ? 0 : SIM_OLED_REFUSE(oled, "%s: remap %02Xh: only 65k colours are modelled", oled->chip.name, p);
}

static int execute(sim_oled_t *oled, uint8_t code, const uint8_t *p) {
    switch (code) {
    case 0x15: return sim_oled_columns(oled, p[0], p[1]);
    case 0x5C: oled->writing = true; return 0;
    case 0x75: return sim_oled_rows(oled, p[0], p[1]);
    case 0xA0: return remap(oled, p[0]);
    case 0xA1: oled->start_line = p[0]; return sim_oled_check(oled, "start line", p[0], 0, 127);
    case 0xA2: oled->offset = p[0]; return sim_oled_check(oled, "display offset", p[0], 0, 127);
    case 0xA4:
    case 0xA5:
    case 0xA6:
    case 0xA7:
        oled->all_off = code == 0xA4;
        oled->all_on = code == 0xA5;
        oled->inverse = code == 0xA7;
        return 0;
    case 0xAE:
    case 0xAF: oled->on = code == 0xAF; return 0;
    case 0xC1: /* red is C */
        oled->contrast[0] = p[2];
        oled->contrast[1] = p[1];
        oled->contrast[2] = p[0];
        return 0;
    case 0xC7: oled->master = p[0]; return sim_oled_check(oled, "master current", p[0], 0, 15);
    case 0xCA: oled->multiplex = (uint16_t)(p[0] + 1u); return sim_oled_check(oled, "multiplex ratio", p[0], 15, 127);
    case 0xFD: return sim_oled_lock(oled, p[0], true);
    default: return 0;
    }
}

/* 5 bits become 6 by repeating the highest. */
static void store(sim_oled_t *oled, const uint8_t *bytes) {
    const uint32_t upper = bytes[0] >> 3, middle = (bytes[0] & 7u) << 3 | bytes[1] >> 5, lower = bytes[1] & 31u;

    *sim_oled_at(oled, oled->segments_remapped ? 127u - oled->column : oled->column, oled->row) =
        (upper << 1 | upper >> 4) << 12 | middle << 6 | lower << 1 | lower >> 4;
}

/* The upper bits are A's in the sequence A, B, C and C's in the sequence C, B, A, and C is red. */
static void colour(const sim_oled_t *oled, uint32_t value, uint8_t *rgb) {
    for (unsigned i = 0; i < 3; i++) {
        const uint32_t six = value >> (oled->colours_swapped ? 12u - 6u * i : 6u * i) & 63u;

        rgb[i] = (uint8_t)(six << 2 | six >> 4);
    }
}

static const sim_oled_part_t part = {
    .name = "SSD1351",
    .width = 128,
    .height = 128,
    .column_pixels = 1,
    .row_pixels = 1,
    .unit_bytes = 2,
    .white = 0x3FFFF,
    .write_command = true,
    .commands = commands,
    .command_count = sizeof commands / sizeof commands[0],
    .defaults = defaults,
    .execute = execute,
    .store = store,
    .colour = colour,
    .rated_clock_hz = 20000000, /* a cycle of 50 ns, table 13-4 */
    .reset_pulse_us = 2,        /* 8.9 */
    .settle_us = 2,
};

static sim_chip_t *create(uint16_t height, sim_error_t *error) {
    const sim_oled_module_t module = {
        .width = 128,
        .height = height,
        .commons_reversed = true,
        .commons_split = true,
        .full = {0xC8, 0x80, 0xC8},
    };
    return sim_oled_create(&part, &module, error);
}

sim_chip_t *sim_ssd1351_create(sim_error_t *error) { return create(128, error); }
sim_chip_t *sim_ssd1351_128x96_create(sim_error_t *error) { return create(96, error); }
