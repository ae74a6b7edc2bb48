#include "oled.h"

/* 0: one of those without parameters; 1: none of them. */
static int without_parameters(sim_oled_t *oled, uint8_t code) {
    switch (code) {
    case 0xA0:
    case 0xA1: oled->segments_remapped = code == 0xA1; return 0;
    case 0xA4:
    case 0xA5: oled->all_on = code == 0xA5; return 0;
    case 0xA6:
    case 0xA7: oled->inverse = code == 0xA7; return 0;
    case 0xAE:
    case 0xAF: oled->on = code == 0xAF; return 0;
    case 0xC0:
    case 0xC8: oled->commons_remapped = code == 0xC8; return 0;
    default: return 1;
    }
}

int sim_oled_mono_execute(sim_oled_t *oled, uint8_t code, const uint8_t *p) {
    if (code <= 0x0F) { return sim_oled_page_column(oled, (oled->columns.first & 0xF0u) | code); }
    if (code <= 0x1F) { return sim_oled_page_column(oled, (code & 15u) << 4 | (oled->columns.first & 15u)); }
    if (code >= 0x40 && code <= 0x7F) {
        oled->start_line = code & 63u;
        return 0;
    }
    if (code >= 0xB0 && code <= 0xB7) { return sim_oled_rows(oled, code & 7u, code & 7u); }
    if (without_parameters(oled, code) == 0) { return 0; }
    switch (code) {
    case 0x81: oled->contrast[0] = oled->contrast[1] = oled->contrast[2] = p[0]; return 0;
    case 0xA8: oled->multiplex = (uint16_t)(p[0] + 1u); return sim_oled_check(oled, "multiplex ratio", p[0], 15, 63);
    case 0xD3: oled->offset = p[0]; return sim_oled_check(oled, "display offset", p[0], 0, 63);
    case 0xD9:
        return sim_oled_check(oled, "phase 1", p[0] & 15u, 1, 15) || sim_oled_check(oled, "phase 2", p[0] >> 4, 1, 15) ? -1 : 0;
    case 0xDA:
        oled->commons_split = (p[0] & 0x10) != 0;
        if ((p[0] & ~0x10) == 0x02) { return 0; }
        return SIM_OLED_REFUSE(oled, "%s: wiring of the commons %02Xh is not modelled", oled->chip.name, p[0]);
    default: return 0;
    }
}

void sim_oled_mono_store(sim_oled_t *oled, const uint8_t *bytes) {
    const unsigned segment = oled->segments_remapped ? oled->part->width - 1u - oled->column : oled->column;

    for (unsigned bit = 0; bit < 8; bit++) {
        *sim_oled_at(oled, segment, 8u * oled->row + bit) = bytes[0] >> bit & 1u;
    }
}

void sim_oled_mono_colour(const sim_oled_t *oled, uint32_t value, uint8_t *rgb) {
    (void)oled;
    rgb[0] = rgb[1] = rgb[2] = value ? 255 : 0;
}
