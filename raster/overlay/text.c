/* Text: lines, and in them glyphs. Positions are 64-bit, since text may lead anywhere. */
#include "canvas.h"
#include "font.h"

/* Width of the line in dots; *text moves to its end, a '\n' or the zero. */
static int64_t line_width(const tuile_font_t *font, const char **text) {
    int64_t width = 0;
    while (**text != '\0' && **text != '\n') {
        width += font_advance(font, tuile_utf8_next(text));
    }
    return width;
}

int32_t tuile_text_width(const tuile_font_t *font, const char *text) {
    int64_t widest = 0;
    for (;; text++) {
        const int64_t width = line_width(font, &text);
        widest = width > widest ? width : widest;
        if (*text == '\0') { return widest > INT32_MAX ? INT32_MAX : (int32_t)widest; }
    }
}

typedef struct text_pen {
    tuile_canvas_t *canvas;
    const tuile_font_t *font;
    overlay_paint_t paint;
    int64_t x, y; /* of the character: left end, top of the line */
    int32_t scale;
} text_pen_t;

static bool glyph_bit(const uint8_t *bits, uint32_t number) { return bits[number >> 3] >> (7 - (number & 7)) & 1; }

/* Row `row` of a glyph whose box begins at x, cut to the box `seen`: runs of dots. */
static void glyph_row(const text_pen_t *pen, const uint8_t *glyph, unsigned row, int64_t x, tuile_box_t seen) {
    const uint8_t *bits = pen->font->bits + (glyph[GLYPH_AT_BITS] | (uint32_t)glyph[GLYPH_AT_BITS + 1] << 8 |
                                             (uint32_t)glyph[GLYPH_AT_BITS + 2] << 16 | (uint32_t)glyph[GLYPH_AT_BITS + 3] << 24);
    const uint32_t width = glyph[GLYPH_AT_WIDTH], first = row * width;
    for (uint32_t dot = 0; dot < width; dot++) {
        const uint32_t from = dot;
        while (dot < width && glyph_bit(bits, first + dot)) {
            dot++;
        }
        if (dot == from) { continue; }
        const int64_t left = x + (int64_t)from * pen->scale, right = x + (int64_t)dot * pen->scale;
        const tuile_box_t run = {left > seen.left ? (int32_t)left : seen.left, seen.top,
                                 right < seen.right ? (int32_t)right : seen.right, seen.bottom};
        if (run.left < run.right) { overlay_fill(pen->canvas, &pen->paint, &run); }
    }
}

static void draw_glyph(const text_pen_t *pen, const uint8_t *glyph) {
    const int64_t scale = pen->scale, x = pen->x + (int8_t)glyph[GLYPH_AT_LEFT] * scale,
                  y = pen->y + (int8_t)glyph[GLYPH_AT_TOP] * scale;
    tuile_box_t box, seen;
    if (!overlay_cut(pen->canvas, x, y, x + glyph[GLYPH_AT_WIDTH] * scale, y + glyph[GLYPH_AT_HEIGHT] * scale, &box)) { return; }
    seen = box;
    for (int64_t row = (box.top - y) / scale; seen.top < box.bottom; row++, seen.top = seen.bottom) {
        const int64_t end = y + (row + 1) * scale;
        seen.bottom = end < box.bottom ? (int32_t)end : box.bottom;
        glyph_row(pen, glyph, (unsigned)row, x, seen);
    }
}

/* Is the first pixel that is seen of a rectangle of the window in this tile? Of all tiles it is in one. */
static bool begins_here(const tuile_canvas_t *canvas, int64_t left, int64_t top, int64_t right, int64_t bottom) {
    const tuile_box_t *clip = &canvas->clip, *tile = &canvas->tile;
    left = left > clip->left ? left : clip->left;
    top = top > clip->top ? top : clip->top;
    return left < right && left < clip->right && top < bottom && top < clip->bottom && tile->left <= left && left < tile->right &&
           tile->top <= top && top < tile->bottom;
}

/* A box one dot thick on the base line, with a dot's room at its right. */
static void draw_missing(const text_pen_t *pen) {
    const tuile_font_t *font = pen->font;
    const int32_t scale = pen->scale, height = (font->ascent ? font->ascent : font->height) * scale;
    const int32_t width = (font->advance > 1 ? font->advance - 1 : 1) * scale;
    tuile_box_t box;
    if (begins_here(pen->canvas, pen->x, pen->y, pen->x + width, pen->y + height)) { pen->canvas->glyphs_missing++; }
    if (!overlay_cut(pen->canvas, pen->x, pen->y, pen->x + width, pen->y + height, &box)) { return; }
    tuile_draw_frame(pen->canvas, (int32_t)pen->x, (int32_t)pen->y, width, height, scale, pen->paint.argb);
}

/* The line at *text, whose box begins at pen->x; *text moves to its end. */
static void draw_line(text_pen_t *pen, const char **text) {
    while (**text != '\0' && **text != '\n') {
        const uint32_t code = tuile_utf8_next(text);
        const uint8_t *glyph = font_glyph(pen->font, code);
        if (glyph) {
            draw_glyph(pen, glyph);
        } else {
            draw_missing(pen);
        }
        pen->x += (int64_t)(glyph ? glyph[GLYPH_AT_CODE + 3] : pen->font->advance) * pen->scale;
    }
}

/* May some dot of a line be in the tile? */
static bool line_near(const text_pen_t *pen) {
    const tuile_box_t *tile = &pen->canvas->tile;
    return pen->y + pen->font->top * pen->scale < tile->bottom && pen->y + pen->font->bottom * pen->scale > tile->top;
}

/* A line, its background first; x and pen->y as tuile_text_styled has them. Where it ends. */
static const char *draw_aligned(text_pen_t *pen, int32_t x, const char *text, const tuile_text_style_t *style) {
    const char *end = text;
    pen->x = x;
    if (style->align != TUILE_ALIGN_LEFT || style->background >> 24) {
        const overlay_paint_t background = overlay_paint(pen->canvas, style->background);
        const int64_t width = line_width(pen->font, &end) * pen->scale, height = pen->font->height * pen->scale;
        tuile_box_t box;
        pen->x -= style->align == TUILE_ALIGN_RIGHT ? width : style->align == TUILE_ALIGN_CENTRE ? width >> 1 : 0;
        if (background.argb >> 24 && overlay_cut(pen->canvas, pen->x, pen->y, pen->x + width, pen->y + height, &box)) {
            overlay_fill(pen->canvas, &background, &box);
        }
    }
    draw_line(pen, &text);
    return text;
}

void tuile_text_styled(tuile_canvas_t *canvas, const tuile_font_t *font, int32_t x, int32_t y, const char *text,
                       const tuile_text_style_t *style) {
    text_pen_t pen = {canvas, font, overlay_paint(canvas, style->colour), 0, y, style->scale ? style->scale : 1};
    for (;; text++, pen.y += font->height * pen.scale) {
        if (line_near(&pen)) {
            text = draw_aligned(&pen, x, text, style);
        } else {
            while (*text != '\0' && *text != '\n') {
                text++;
            }
        }
        if (*text == '\0') { return; }
    }
}

void tuile_text(tuile_canvas_t *canvas, const tuile_font_t *font, int32_t x, int32_t y, const char *text, uint32_t colour) {
    const tuile_text_style_t style = {.colour = colour};
    tuile_text_styled(canvas, font, x, y, text, &style);
}
