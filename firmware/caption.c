#include "caption.h"

#define LARGE_WIDTH_PX 200u

const char *const caption_methods[5] = {
    [TUILE_ZBUFFER] = "zbuffer", [TUILE_SCANLINE] = "scanline", [TUILE_WARNOCK] = "warnock",
    [TUILE_PAINTER] = "painter", [TUILE_TREE] = "tree",
};

/* The product stays below 2^32 * 10^7 < 2^56. */
uint16_t caption_rate(uint32_t frames, uint32_t us) {
    const uint64_t rate = ((uint64_t)frames * 10000000u + us / 2u) / us;

    return rate == 0 ? 1 : rate > CAPTION_RATE_MOST ? CAPTION_RATE_MOST : (uint16_t)rate;
}

static void rate_text(char text[TUILE_DECIMAL_BYTES + 4], uint16_t rate) {
    static const char unknown[] = "--.-", unit[] = " fps";
    unsigned at = 0;

    if (rate) {
        tuile_decimal(text, rate, 1);
    } else {
        for (unsigned i = 0; i < sizeof unknown; i++) {
            text[i] = unknown[i];
        }
    }
    while (text[at]) {
        at++;
    }
    for (unsigned i = 0; i < sizeof unit; i++) {
        text[at + i] = unit[i];
    }
}

void caption_draw(void *context, tuile_canvas_t *canvas) {
    const caption_t *caption = context;
    tuile_text_style_t style = {
        .colour = TUILE_COLOUR(255, 255, 255),
        .background = TUILE_COLOUR(0, 0, 0),
        .scale = canvas->width < LARGE_WIDTH_PX ? 1 : 2,
    };

    if (caption->show_rate) {
        char text[TUILE_DECIMAL_BYTES + 4];

        rate_text(text, caption->rate);
        tuile_text_styled(canvas, &caption->font, 0, 0, text, &style);
    }
    if (caption->show_method) {
        style.align = TUILE_ALIGN_RIGHT;
        tuile_text_styled(canvas, &caption->font, canvas->width, 0, caption_methods[caption->method], &style);
    }
}
