/* Canvases, and colours put into samples. */
#include "canvas.h"

void tuile_canvas_clip(tuile_canvas_t *canvas, int32_t x, int32_t y, int32_t width, int32_t height) {
    const int64_t right = (int64_t)x + width, bottom = (int64_t)y + height;
    canvas->clip.left = x > 0 ? x : 0;
    canvas->clip.top = y > 0 ? y : 0;
    canvas->clip.right = right > canvas->width ? canvas->width : right < 0 ? 0 : (int32_t)right;
    canvas->clip.bottom = bottom > canvas->height ? canvas->height : bottom < 0 ? 0 : (int32_t)bottom;
}

bool overlay_cut(const tuile_canvas_t *canvas, int64_t left, int64_t top, int64_t right, int64_t bottom, tuile_box_t *box) {
    const tuile_box_t *tile = &canvas->tile, *clip = &canvas->clip;
    box->left = tile->left > clip->left ? tile->left : clip->left;
    box->top = tile->top > clip->top ? tile->top : clip->top;
    box->right = tile->right < clip->right ? tile->right : clip->right;
    box->bottom = tile->bottom < clip->bottom ? tile->bottom : clip->bottom;
    if (left >= box->right || top >= box->bottom || right <= box->left || bottom <= box->top) { return false; }
    if (left > box->left) { box->left = (int32_t)left; }
    if (top > box->top) { box->top = (int32_t)top; }
    if (right < box->right) { box->right = (int32_t)right; }
    if (bottom < box->bottom) { box->bottom = (int32_t)bottom; }
    return box->left < box->right && box->top < box->bottom;
}

bool overlay_samples(const tuile_canvas_t *canvas, tuile_box_t *area) {
    const tuile_box_t *tile = &canvas->tile;
    if (!overlay_cut(canvas, tile->left, tile->top, tile->right, tile->bottom, area)) { return false; }
    area->left <<= canvas->shift;
    area->top <<= canvas->shift;
    area->right <<= canvas->shift;
    area->bottom <<= canvas->shift;
    return true;
}

overlay_paint_t overlay_paint(const tuile_canvas_t *canvas, uint32_t argb) {
    return (overlay_paint_t){argb, pixel_pack((pixel_kind_t)canvas->kind, argb & 0xffffffu)};
}

/* (behind * (255 - alpha) + colour * alpha) / 255, rounded; components of 8 bits. */
static uint32_t mix8(uint32_t behind, uint32_t colour, uint32_t alpha) {
    return pixel_div255(behind * (255 - alpha) + colour * alpha + 127);
}

static uint32_t mix(uint32_t behind, uint32_t colour, uint32_t alpha) {
    return PIXEL_RGB(mix8(behind >> 16 & 255, colour >> 16 & 255, alpha), mix8(behind >> 8 & 255, colour >> 8 & 255, alpha),
                     mix8(behind & 255, colour & 255, alpha));
}

/* x / 31 and x / 63, rounded, of a step times 255: exact for all steps (tests/test_overlay.c). */
static uint32_t spread31(uint32_t step) { return (step * 527u + 23u) >> 6; }
static uint32_t spread63(uint32_t step) { return (step * 259u + 33u) >> 6; }

static uint32_t swap16(uint32_t x) { return (x >> 8 | x << 8) & 0xffffu; }

/* What pixel_unpack, mix and pixel_pack make, for the formats that most panels take; `behind` and the result in the machine's
 * order. */
static uint32_t mix565(uint32_t behind, uint32_t colour, uint32_t alpha) {
    const uint32_t red = mix8(spread31(behind >> 11), colour >> 16 & 255, alpha),
                   green = mix8(spread63(behind >> 5 & 63), colour >> 8 & 255, alpha),
                   blue = mix8(spread31(behind & 31), colour & 255, alpha);
    return pixel_div255(red * 31 + 127) << 11 | pixel_div255(green * 63 + 127) << 5 | pixel_div255(blue * 31 + 127);
}

static uint32_t mix_sample(pixel_kind_t kind, const overlay_paint_t *paint, uint32_t sample, uint32_t alpha) {
    switch (kind) {
    case PIXEL_RGB565_LE: return mix565(sample, paint->argb, alpha);
    case PIXEL_RGB565_BE: return swap16(mix565(swap16(sample), paint->argb, alpha));
    case PIXEL_LUMA16: return (sample * (255 - alpha) + paint->sample * alpha + 127) / 255; /* whole: not by way of 8 bits */
    default: return pixel_pack(kind, mix(pixel_unpack(kind, sample), paint->argb, alpha));
    }
}

/* Neighbours are often equal, above all where nothing but the background is. */
static void blend_run(pixel_kind_t kind, const overlay_paint_t *paint, void *samples, int32_t count, uint32_t alpha) {
    const bool is_narrow = pixel_bytes(kind) == 2;
    uint16_t *narrow = samples;
    uint32_t *wide = samples;
    uint32_t behind = is_narrow ? narrow[0] : wide[0], mixed = mix_sample(kind, paint, behind, alpha);
    for (int32_t i = 0; i < count; i++) {
        const uint32_t sample = is_narrow ? narrow[i] : wide[i];
        if (sample != behind) {
            behind = sample;
            mixed = mix_sample(kind, paint, sample, alpha);
        }
        if (is_narrow) {
            narrow[i] = (uint16_t)mixed;
        } else {
            wide[i] = mixed;
        }
    }
}

void overlay_run(const tuile_canvas_t *canvas, const overlay_paint_t *paint, int32_t x, int32_t y, int32_t count,
                 unsigned coverage) {
    const pixel_kind_t kind = (pixel_kind_t)canvas->kind;
    const uint32_t alpha = ((paint->argb >> 24) * coverage + COVERAGE_FULL / 2) / COVERAGE_FULL;
    const int32_t left = canvas->tile.left << canvas->shift, top = canvas->tile.top << canvas->shift;
    const size_t at = (size_t)(y - top) * (size_t)canvas->stride + (size_t)(x - left);
    uint8_t *samples = (uint8_t *)canvas->samples + at * pixel_bytes(kind);
    if (alpha == 0) { return; }
    if (alpha < 255) {
        blend_run(kind, paint, samples, count, alpha);
    } else if (pixel_bytes(kind) == 2) {
        for (int32_t i = 0; i < count; i++) {
            ((uint16_t *)(void *)samples)[i] = (uint16_t)paint->sample;
        }
    } else {
        for (int32_t i = 0; i < count; i++) {
            ((uint32_t *)(void *)samples)[i] = paint->sample;
        }
    }
}

void overlay_fill(const tuile_canvas_t *canvas, const overlay_paint_t *paint, const tuile_box_t *box) {
    const unsigned shift = canvas->shift;
    for (int32_t y = box->top << shift; y < box->bottom << shift; y++) {
        overlay_run(canvas, paint, box->left << shift, y, (box->right - box->left) << shift, COVERAGE_FULL);
    }
}

/* ---- rectangles ---- */

/* 64 bits, so that no sum overflows. */
static void fill_cut(tuile_canvas_t *canvas, int64_t left, int64_t top, int64_t right, int64_t bottom, uint32_t colour) {
    tuile_box_t box;
    if (!overlay_cut(canvas, left, top, right, bottom, &box)) { return; }
    const overlay_paint_t paint = overlay_paint(canvas, colour);
    overlay_fill(canvas, &paint, &box);
}

void tuile_draw_pixel(tuile_canvas_t *canvas, int32_t x, int32_t y, uint32_t colour) {
    fill_cut(canvas, x, y, (int64_t)x + 1, (int64_t)y + 1, colour);
}

void tuile_draw_rectangle(tuile_canvas_t *canvas, int32_t x, int32_t y, int32_t width, int32_t height, uint32_t colour) {
    if (width > 0 && height > 0) { fill_cut(canvas, x, y, (int64_t)x + width, (int64_t)y + height, colour); }
}

void tuile_draw_frame(tuile_canvas_t *canvas, int32_t x, int32_t y, int32_t width, int32_t height, int32_t thickness,
                      uint32_t colour) {
    const int64_t right = (int64_t)x + width, bottom = (int64_t)y + height, t = thickness;
    if (width <= 0 || height <= 0 || thickness <= 0) { return; }
    if (2 * t >= width || 2 * t >= height) {
        tuile_draw_rectangle(canvas, x, y, width, height, colour);
        return;
    }
    fill_cut(canvas, x, y, right, y + t, colour);
    fill_cut(canvas, x, y + t, x + t, bottom - t, colour);
    fill_cut(canvas, right - t, y + t, right, bottom - t, colour);
    fill_cut(canvas, x, bottom - t, right, bottom, colour);
}
