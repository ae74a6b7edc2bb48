#include "ssd0323.h"

static const sim_oled_command_t commands[] = {
    {0x15, 0x15, 2, 0},                     /* columns */
    {0x23, 0x23, 1, SIM_OLED_NOT_MODELLED}, /* options of drawing */
    {0x24, 0x24, 5, SIM_OLED_NOT_MODELLED}, /* rectangle */
    {0x25, 0x25, 6, SIM_OLED_NOT_MODELLED}, /* copy */
    {0x26, 0x26, 3, SIM_OLED_NOT_MODELLED}, /* horizontal scroll */
    {0x2E, 0x2E, 0, 0},                     /* scroll off */
    {0x2F, 0x2F, 0, SIM_OLED_NOT_MODELLED}, /* scroll on */
    {0x75, 0x75, 2, 0},                     /* rows */
    {0x81, 0x81, 1, 0},                     /* contrast */
    {0x84, 0x86, 0, 0},                     /* a quarter, half, all of the current */
    {0xA0, 0xA0, 1, 0},                     /* remap */
    {0xA1, 0xA1, 1, 0},                     /* start line */
    {0xA2, 0xA2, 1, 0},                     /* display offset */
    {0xA4, 0xA7, 0, 0},                     /* normal, all on, all off, inverse */
    {0xA8, 0xA8, 1, 0},                     /* multiplex ratio */
    {0xAD, 0xAD, 1, 0},                     /* master configuration */
    {0xAE, 0xAF, 0, 0},                     /* off, on */
    {0xB0, 0xB0, 1, 0},                     /* pre-charge compensation */
    {0xB1, 0xB1, 1, 0},                     /* phases */
    {0xB2, 0xB2, 1, 0},                     /* row period */
    {0xB3, 0xB3, 1, 0},                     /* clock */
    {0xB4, 0xB4, 1, 0},                     /* level of compensation */
    {0xB8, 0xB8, 8, 0},                     /* table of greys */
    {0xBC, 0xBC, 1, 0},                     /* pre-charge voltage */
    {0xBE, 0xBE, 1, 0},                     /* VCOMH */
    {0xBF, 0xBF, 1, 0},                     /* low voltage of the segments */
    {0xE3, 0xE3, 0, 0},                     /* nothing */
};

static void defaults(sim_oled_t *oled) {
    oled->contrast[0] = oled->contrast[1] = oled->contrast[2] = 0x40;
    oled->master = 7;
}

static int remap(sim_oled_t *oled, uint8_t p) {
    oled->segments_remapped = (p & 0x01) != 0;
    oled->nibbles_remapped = (p & 0x02) != 0;
    oled->vertical = (p & 0x04) != 0;
    oled->commons_remapped = (p & 0x10) != 0;
    oled->commons_split = (p & 0x40) != 0;
    oled->placed = 0;
    return p & 0xA8 ? SIM_OLED_REFUSE(oled, "%s: remap %02Xh has reserved bits", oled->chip.name, p) : 0;
}

static int execute(sim_oled_t *oled, uint8_t code, const uint8_t *p) {
    switch (code) {
    case 0x15: return sim_oled_columns(oled, p[0], p[1]);
    case 0x75: return sim_oled_rows(oled, p[0], p[1]);
    case 0x81:
        oled->contrast[0] = oled->contrast[1] = oled->contrast[2] = p[0];
        return sim_oled_check(oled, "contrast", p[0], 0, 127);
    case 0x84:
    case 0x85:
    case 0x86: oled->master = (uint8_t)((4u << (code - 0x84u)) - 1u); return 0;
    case 0xA0: return remap(oled, p[0]);
    case 0xA1: oled->start_line = p[0]; return sim_oled_check(oled, "start line", p[0], 0, 79);
    case 0xA2: oled->offset = p[0]; return sim_oled_check(oled, "display offset", p[0], 0, 79);
    case 0xA4:
    case 0xA5:
    case 0xA6:
    case 0xA7:
        oled->all_on = code == 0xA5;
        oled->all_off = code == 0xA6;
        oled->inverse = code == 0xA7;
        return 0;
    case 0xA8: oled->multiplex = (uint16_t)(p[0] + 1u); return sim_oled_check(oled, "multiplex ratio", p[0], 15, 79);
    case 0xAE:
    case 0xAF: oled->on = code == 0xAF; return 0;
    default: return 0;
    }
}

/* After a reset the lower half of a byte is the lower of its two segments. Column remap leaves the order within a byte alone: it
 * takes both remaps to turn a row round. */
static void store(sim_oled_t *oled, const uint8_t *bytes) {
    const unsigned segment = 2u * (oled->segments_remapped ? 63u - oled->column : oled->column);

    *sim_oled_at(oled, segment + (oled->nibbles_remapped ? 1 : 0), oled->row) = bytes[0] & 15u;
    *sim_oled_at(oled, segment + (oled->nibbles_remapped ? 0 : 1), oled->row) = bytes[0] >> 4;
}

static const sim_oled_part_t part = {
    .name = "SSD0323",
    .width = 128,
    .height = 80,
    .column_pixels = 2,
    .row_pixels = 1,
    .unit_bytes = 1,
    .white = 15,
    .parameters_low = true,
    .reverses_all = true,
    .commands = commands,
    .command_count = sizeof commands / sizeof commands[0],
    .defaults = defaults,
    .execute = execute,
    .store = store,
    .colour = sim_oled_grey,
    .rated_clock_hz = 4000000, /* a cycle of 250 ns */
    .reset_pulse_us = 3,       /* unverified: as its younger kin ask for */
    .settle_us = 3,
};

sim_chip_t *sim_ssd0323_create(sim_error_t *error) {
    static const sim_oled_module_t module = {
        .width = 128,
        .height = 64,
        .commons_reversed = true,
        .commons_split = true,
        .full = {0x70, 0x70, 0x70},
    };
    return sim_oled_create(&part, &module, error);
}
