#include "ssd1322.h"

/* Section 9. */
static const sim_oled_command_t commands[] = {
    {0x00, 0x00, 0, 0},                     /* the table of greys that was told */
    {0x15, 0x15, 2, 0},                     /* columns */
    {0x5C, 0x5C, 0, 0},                     /* memory write */
    {0x5D, 0x5D, 0, SIM_OLED_NOT_MODELLED}, /* memory read */
    {0x75, 0x75, 2, 0},                     /* rows */
    {0xA0, 0xA0, 2, 0},                     /* remap */
    {0xA1, 0xA1, 1, 0},                     /* start line */
    {0xA2, 0xA2, 1, 0},                     /* display offset */
    {0xA4, 0xA7, 0, 0},                     /* all off, all on, normal, inverse */
    {0xA8, 0xA8, 2, SIM_OLED_NOT_MODELLED}, /* partial display */
    {0xA9, 0xA9, 0, 0},                     /* all of it */
    {0xAB, 0xAB, 1, 0},                     /* regulator */
    {0xAE, 0xAF, 0, 0},                     /* off, on */
    {0xB1, 0xB1, 1, 0},                     /* phases */
    {0xB3, 0xB3, 1, 0},                     /* clock */
    {0xB4, 0xB4, 2, 0},                     /* enhancement A */
    {0xB5, 0xB5, 1, 0},                     /* pins */
    {0xB6, 0xB6, 1, 0},                     /* second pre-charge */
    {0xB8, 0xB8, 15, 0},                    /* table of greys */
    {0xB9, 0xB9, 0, 0},                     /* linear greys */
    {0xBB, 0xBB, 1, 0},                     /* pre-charge voltage */
    {0xBE, 0xBE, 1, 0},                     /* VCOMH */
    {0xC1, 0xC1, 1, 0},                     /* contrast */
    {0xC7, 0xC7, 1, 0},                     /* master current */
    {0xCA, 0xCA, 1, 0},                     /* multiplex ratio */
    {0xD1, 0xD1, 2, 0},                     /* enhancement B */
    {0xFD, 0xFD, 1, 0},                     /* lock */
};

static void defaults(sim_oled_t *oled) { oled->contrast[0] = oled->contrast[1] = oled->contrast[2] = 0x7F; }

/* 10.1.6. Two commons at a time leave no pins for a split, nor for more than 64 of them. */
static int remap(sim_oled_t *oled, const uint8_t *p) {
    oled->vertical = (p[0] & 0x01) != 0;
    oled->segments_remapped = (p[0] & 0x02) != 0;
    oled->nibbles_remapped = (p[0] & 0x04) != 0;
    oled->commons_remapped = (p[0] & 0x10) != 0;
    oled->commons_split = (p[0] & 0x20) != 0;
    oled->placed = 0;
    if (p[0] & 0xC8 || (p[1] & ~0x10) != 0x01) {
        return SIM_OLED_REFUSE(oled, "%s: remap %02X %02X has reserved bits", oled->chip.name, p[0], p[1]);
    }
    if (p[1] & 0x10 && (oled->commons_split || oled->multiplex > 64)) {
        return SIM_OLED_REFUSE(oled, "%s: commons in pairs (%02X %02X) take no split and a multiplex ratio of 64 at most",
                               oled->chip.name, p[0], p[1]);
    }
    return 0;
}

static int execute(sim_oled_t *oled, uint8_t code, const uint8_t *p) {
    switch (code) {
    case 0x15: return sim_oled_columns(oled, p[0], p[1]);
    case 0x5C: oled->writing = true; return 0;
    case 0x75: return sim_oled_rows(oled, p[0], p[1]);
    case 0xA0: return remap(oled, p);
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
    case 0xC1: oled->contrast[0] = oled->contrast[1] = oled->contrast[2] = p[0]; return 0;
    case 0xC7: oled->master = p[0]; return sim_oled_check(oled, "master current", p[0], 0, 15);
    case 0xCA: oled->multiplex = (uint16_t)(p[0] + 1u); return sim_oled_check(oled, "multiplex ratio", p[0], 15, 127);
    case 0xFD: return sim_oled_lock(oled, p[0], false);
    default: return 0;
    }
}

/* A column is four segments and takes four halves of bytes, as they come or the other way round (8.4, A[2] of 10.1.6): after a
 * reset the last half is the lowest segment. Column remap numbers the segments, not just the columns, from the other end. */
static void store(sim_oled_t *oled, const uint8_t *bytes) {
    const unsigned halves[4] = {bytes[0] >> 4, bytes[0] & 15u, bytes[1] >> 4, bytes[1] & 15u};

    for (unsigned i = 0; i < 4; i++) {
        const unsigned place = 4u * oled->column + (oled->nibbles_remapped ? i : 3u - i);

        *sim_oled_at(oled, oled->segments_remapped ? 479u - place : place, oled->row) = halves[i];
    }
}

static const sim_oled_part_t part = {
    .name = "SSD1322",
    .width = 480,
    .height = 128,
    .column_pixels = 4,
    .row_pixels = 1,
    .unit_bytes = 2,
    .white = 15,
    .write_command = true,
    .commands = commands,
    .command_count = sizeof commands / sizeof commands[0],
    .defaults = defaults,
    .execute = execute,
    .store = store,
    .colour = sim_oled_grey,
    .rated_clock_hz = 10000000, /* a cycle of 100 ns, section 13 */
    .reset_pulse_us = 2,
    .settle_us = 2, /* unverified */
};

sim_chip_t *sim_ssd1322_create(sim_error_t *error) {
    static const sim_oled_module_t module = {
        .width = 256,
        .height = 64,
        .first_segment = 112,
        .segments_reversed = true,
        .full = {0x9F, 0x9F, 0x9F},
    };
    return sim_oled_create(&part, &module, error);
}
