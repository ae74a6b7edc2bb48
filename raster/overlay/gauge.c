/* A dial: what the other files draw, put together. */
#include "../fixed.h"
#include "overlay.h"

#define GAUGE_FROM 0x6000u  /* three eighths of a turn: left below */
#define GAUGE_SWEEP 0xc000u /* to right below */

static bool is_seen(uint32_t colour) { return colour >> 24 != 0; }

/* A point of the dial, radius in 1/16 pixel, rounded to nearest: |radius| < 2^15. */
static void polar(const tuile_gauge_t *gauge, bam16_t angle, int32_t radius, q28_4_t at[2]) {
    at[0] = TUILE_PX(gauge->x) + 8 + (int32_t)(((int64_t)tuile_cos(angle) * radius + (INT32_C(1) << 29)) >> 30);
    at[1] = TUILE_PX(gauge->y) + 8 + (int32_t)(((int64_t)tuile_sin(angle) * radius + (INT32_C(1) << 29)) >> 30);
}

static void draw_needle(tuile_canvas_t *canvas, const tuile_gauge_t *gauge, bam16_t angle) {
    const int32_t r = TUILE_PX(gauge->radius);
    q28_4_t tail[2], tip[2];
    polar(gauge, angle, -r / 8, tail);
    polar(gauge, angle, r * 3 / 4, tip);
    tuile_draw_stroke(canvas, tail[0], tail[1], tip[0], tip[1], r / 16 + 16, gauge->needle);
    tuile_draw_disc(canvas, TUILE_PX(gauge->x) + 8, TUILE_PX(gauge->y) + 8, r / 10, gauge->needle);
}

/* Ten ticks of the scale, or rather the eleven ends of its tenths. */
static void draw_ticks(tuile_canvas_t *canvas, const tuile_gauge_t *gauge) {
    const int32_t r = TUILE_PX(gauge->radius);
    for (uint32_t i = 0; i <= 10; i++) {
        const bam16_t angle = (bam16_t)(GAUGE_FROM + GAUGE_SWEEP * i / 10);
        q28_4_t outer[2], inner[2];
        polar(gauge, angle, r * 13 / 16, outer);
        polar(gauge, angle, r * (i % 5 == 0 ? 11 : 12) / 16, inner);
        tuile_draw_stroke(canvas, inner[0], inner[1], outer[0], outer[1], r / 64 + 12, gauge->track);
    }
}

static void draw_value(tuile_canvas_t *canvas, const tuile_gauge_t *gauge) {
    const tuile_text_style_t style = {
        .colour = gauge->needle, .align = TUILE_ALIGN_CENTRE, .scale = (uint8_t)(gauge->radius >= 48 ? gauge->radius / 24 : 1)};
    char text[TUILE_DECIMAL_BYTES];
    tuile_decimal(text, gauge->value, gauge->decimals);
    tuile_text_styled(canvas, gauge->font, gauge->x + 1, gauge->y + gauge->radius / 2, text, &style);
}

/* Dials farther out than that are out of the window, whatever their radius. */
static int32_t held_place(int32_t at) { return at > 1 << 14 ? 1 << 14 : at < -(1 << 14) ? -(1 << 14) : at; }

int tuile_draw_gauge(tuile_canvas_t *canvas, const tuile_gauge_t *given) {
    tuile_gauge_t held_gauge = *given;
    const tuile_gauge_t *gauge = &held_gauge;
    held_gauge.x = held_place(given->x);
    held_gauge.y = held_place(given->y);
    const int64_t low = gauge->low, range = gauge->high - low;
    if (range <= 0 || gauge->radius < 4 || gauge->radius > 1024) { return TUILE_ERROR_ARGUMENT; }
    const int64_t within = gauge->value - low, held = within < 0 ? 0 : within > range ? range : within;
    const bam16_t angle = (bam16_t)(GAUGE_FROM + held * GAUGE_SWEEP / range), end = (bam16_t)(GAUGE_FROM + GAUGE_SWEEP);
    const q28_4_t x = TUILE_PX(gauge->x) + 8, y = TUILE_PX(gauge->y) + 8, r = TUILE_PX(gauge->radius);
    if (is_seen(gauge->face)) { tuile_draw_disc(canvas, x, y, r + 8, gauge->face); }
    if (is_seen(gauge->track)) {
        tuile_draw_arc(canvas, x, y, r * 7 / 8, r, angle, end, gauge->track);
        draw_ticks(canvas, gauge);
    }
    if (is_seen(gauge->fill)) { tuile_draw_arc(canvas, x, y, r * 7 / 8, r, GAUGE_FROM, angle, gauge->fill); }
    if (gauge->font) { draw_value(canvas, gauge); }
    if (is_seen(gauge->needle)) { draw_needle(canvas, gauge, angle); }
    return TUILE_OK;
}
