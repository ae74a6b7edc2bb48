/* Numbers as text, and frames a second. */
#include "overlay.h"

void tuile_decimal(char text[TUILE_DECIMAL_BYTES], int32_t value, unsigned decimals) {
    char reversed[TUILE_DECIMAL_BYTES];
    unsigned count = 0, at = 0;
    uint32_t rest = value < 0 ? 0u - (uint32_t)value : (uint32_t)value;
    decimals = decimals > 9 ? 9 : decimals;
    for (unsigned digit = 0; rest > 0 || digit <= decimals; digit++) {
        if (digit == decimals && decimals > 0) { reversed[count++] = '.'; }
        reversed[count++] = (char)('0' + rest % 10);
        rest /= 10;
    }
    if (value < 0) { text[at++] = '-'; }
    while (count > 0) {
        text[at++] = reversed[--count];
    }
    text[at] = '\0';
}

#define FRAME_MOST_US 10000000u

void tuile_fps_frame(tuile_fps_t *fps, uint32_t frame_time_us) {
    const uint32_t us = frame_time_us == 0 ? 1 : frame_time_us > FRAME_MOST_US ? FRAME_MOST_US : frame_time_us;
    /* < 2^28; an eighth of the way, rounded to nearest */
    fps->mean_us = fps->mean_us == 0 ? 16 * us : (fps->mean_us * 7 + 16 * us + 4) / 8;
}

void tuile_text_fps(tuile_canvas_t *canvas, const tuile_font_t *font, int32_t x, int32_t y, uint32_t colour,
                    const tuile_fps_t *fps) {
    static const char unit[] = " fps";
    char text[TUILE_DECIMAL_BYTES + sizeof unit] = "--.-";
    unsigned at = 0;
    if (fps->mean_us) { tuile_decimal(text, (int32_t)((160000000u + fps->mean_us / 2) / fps->mean_us), 1); }
    while (text[at] != '\0') {
        at++;
    }
    for (unsigned i = 0; i < sizeof unit; i++) {
        text[at + i] = unit[i];
    }
    tuile_text(canvas, font, x, y, text, colour);
}
