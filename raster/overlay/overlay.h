/* What is drawn over the faces: text, gauges, images.
 *
 * The renderer calls config.overlay(context, canvas) for each tile when its faces are drawn, and the callback draws the whole
 * overlay with the functions below, each time: everything is cut to the tile, and where nothing of it lies in the tile it costs a
 * few comparisons. So there is no frame buffer, and what is seen depends neither on tiles nor on memory. It must draw the same in
 * all tiles of a frame.
 *
 * Coordinates are the window's: `int32_t` in whole pixels, `q28_4_t` in 1/16 pixel, where pixel (i, j) has its centre at
 * (16 i + 8, 16 j + 8). Any value is allowed; 1/16 pixels are held to +-TUILE_OVERLAY_RANGE, ends of lines to +-2^29 pixels.
 * Angles begin to the right and grow clockwise as seen: (cos, sin) with y down.
 * Colours are 0xaarrggbb; alpha 255 is opaque, 0 draws nothing.
 *
 * Round shapes have soft edges of 16 steps, by the distance of a pixel's centre from the edge; canvas->crisp = true draws the
 * pixels whose centres are inside, and nothing between. With anti-aliasing (config.aa) both hold for samples.
 */
#ifndef TUILE_OVERLAY_OVERLAY_H
#define TUILE_OVERLAY_OVERLAY_H

#include "../tuile.h"

#define TUILE_ARGB(alpha, red, green, blue) \
    ((uint32_t)(alpha) << 24 | (uint32_t)(red) << 16 | (uint32_t)(green) << 8 | (uint32_t)(blue))
#define TUILE_COLOUR(red, green, blue) TUILE_ARGB(255, red, green, blue)
#define TUILE_PX(x) ((q28_4_t)((x)*16)) /* whole pixels in 1/16; the centre of pixel i is TUILE_PX(i) + 8 */

#define TUILE_OVERLAY_RANGE ((int32_t)1 << 22) /* 1/16 pixels */

/* Pixels left ... right - 1, top ... bottom - 1; none where right <= left or bottom <= top. */
typedef struct tuile_box {
    int32_t left, top, right, bottom;
} tuile_box_t;

struct tuile_canvas {
    void *samples;           /* of the tile, row by row */
    int32_t stride;          /* samples from row to row */
    uint16_t width, height;  /* of the window, pixels */
    tuile_box_t tile;        /* pixels of the window */
    tuile_box_t clip;        /* nothing is drawn outside of it; tuile_canvas_clip sets it */
    uint8_t kind;            /* pixel_kind_t (pixel.h) */
    uint8_t shift;           /* log2 of the samples along a pixel */
    bool crisp;              /* no soft edges */
    uint32_t glyphs_missing; /* boxes drawn in the place of characters that the font has not, each counted in one tile only */
};

/* Clips what is drawn from now on to a rectangle of the window. Each tile begins with the whole window. */
void tuile_canvas_clip(tuile_canvas_t *canvas, int32_t x, int32_t y, int32_t width, int32_t height);

/* ---- rectangles ---- */

void tuile_draw_pixel(tuile_canvas_t *canvas, int32_t x, int32_t y, uint32_t colour);

/* Filled; width or height below 1: nothing. Lines along rows and columns are rectangles 1 pixel high or wide. */
void tuile_draw_rectangle(tuile_canvas_t *canvas, int32_t x, int32_t y, int32_t width, int32_t height, uint32_t colour);

/* Its outermost `thickness` pixels, inside of it; no pixel is drawn twice. */
void tuile_draw_frame(tuile_canvas_t *canvas, int32_t x, int32_t y, int32_t width, int32_t height, int32_t thickness,
                      uint32_t colour);

/* Filled, its corners rounded; radius in pixels, held to half of the smaller side, rounded down. */
void tuile_draw_rounded(tuile_canvas_t *canvas, int32_t x, int32_t y, int32_t width, int32_t height, int32_t radius,
                        uint32_t colour);

/* ---- lines ---- */

/* Bresenham's, one pixel wide, both ends drawn. */
void tuile_draw_line(tuile_canvas_t *canvas, int32_t from_x, int32_t from_y, int32_t to_x, int32_t to_y, uint32_t colour);

/* A straight stroke with round ends and soft edges. width > 0: 1/16 pixel across. */
void tuile_draw_stroke(tuile_canvas_t *canvas, q28_4_t from_x, q28_4_t from_y, q28_4_t to_x, q28_4_t to_y, q28_4_t width,
                       uint32_t colour);

/* ---- round shapes ---- */

/* Radii of 0 and below have nothing in them. disc(r) and ring(r, s) together are disc(s). */
void tuile_draw_disc(tuile_canvas_t *canvas, q28_4_t x, q28_4_t y, q28_4_t radius, uint32_t colour);
void tuile_draw_ring(tuile_canvas_t *canvas, q28_4_t x, q28_4_t y, q28_4_t inner, q28_4_t outer, uint32_t colour);

/* The part of a ring from angle `from` clockwise to angle `to`; nothing when they are equal. inner <= 0: a slice of the disc. */
void tuile_draw_arc(tuile_canvas_t *canvas, q28_4_t x, q28_4_t y, q28_4_t inner, q28_4_t outer, bam16_t from, bam16_t to,
                    uint32_t colour);

/* ---- polygons ---- */

#define TUILE_POLYGON_CORNERS 32

/* Any polygon, even-odd, by the coverage rule of faces. points: x, y; beyond 2047 pixels either side of the window held to that.
 * TUILE_ERROR_ARGUMENT when there are more than TUILE_POLYGON_CORNERS; fewer than 3 have no inside. */
int tuile_draw_polygon(tuile_canvas_t *canvas, const q28_4_t (*points)[2], unsigned count, uint32_t colour);

/* ---- images ---- */

/* Level 0 of a texture of any format with its top left corner at (x, y), each texel a square of `scale` pixels (0 = 1); texels have
 * their own alpha times `alpha` / 255, and those of the key are left out. TUILE_ERROR_ARGUMENT for a texture that is none. */
int tuile_draw_image(tuile_canvas_t *canvas, const tuile_texture_t *image, int32_t x, int32_t y, unsigned scale, uint8_t alpha);

/* ---- fonts ---- */

/* An opened font: pointers into the caller's bytes, which must outlive it. overlay/font.h has the layout. */
typedef struct tuile_font {
    const uint8_t *glyphs, *bits;
    uint16_t glyph_count;
    uint8_t height;      /* of a line, pixels */
    uint8_t ascent;      /* rows above the base line */
    uint8_t advance;     /* of characters that have no glyph */
    int16_t top, bottom; /* rows of a line, from its top, that some glyph or background may reach: top ... bottom - 1 */
} tuile_font_t;

/* Opens a font that `tuile font` wrote. All of it is checked (the check sum too), so that a font that opens can be drawn without a
 * read out of bounds. bytes: 4-byte aligned. Returns 0, TUILE_ERROR_ARGUMENT or TUILE_ERROR_FONT. */
int tuile_font_open(tuile_font_t *font, const void *bytes, size_t size_bytes);

/* ---- text ---- */

typedef enum tuile_align {
    TUILE_ALIGN_LEFT = 0, /* x is the left end of each line */
    TUILE_ALIGN_CENTRE = 1,
    TUILE_ALIGN_RIGHT = 2, /* x is the first pixel right of it */
} tuile_align_t;

typedef struct tuile_text_style {
    uint32_t colour;
    uint32_t background; /* of the lines' boxes; alpha 0: none */
    uint8_t align;       /* tuile_align_t */
    uint8_t scale;       /* pixels along a dot of the font; 0 = 1 */
} tuile_text_style_t;

/* Text is UTF-8, zero-terminated; '\n' begins a new line. Bytes that are no UTF-8 (overlong, surrogates, cut short) are U+FFFD, one
 * for each longest part that a character may begin with. A character without a glyph is drawn as a box and counted.
 * (x, y): top of the first line, and where `align` says. */
void tuile_text_styled(tuile_canvas_t *canvas, const tuile_font_t *font, int32_t x, int32_t y, const char *text,
                       const tuile_text_style_t *style);

/* The same: left-aligned, as it is. */
void tuile_text(tuile_canvas_t *canvas, const tuile_font_t *font, int32_t x, int32_t y, const char *text, uint32_t colour);

/* Width of the widest line in dots of the font, held to INT32_MAX. */
int32_t tuile_text_width(const tuile_font_t *font, const char *text);

/* The next code point; *text moves behind it. At the end it is 0, and *text stays. */
uint32_t tuile_utf8_next(const char **text);

/* ---- numbers ---- */

#define TUILE_DECIMAL_BYTES 16 /* suffices for any value, the zero included */

/* value / 10^decimals as text, decimals 0 ... 9 (more are 9): 375 and 1 make "37.5", -5 and 2 "-0.05". */
void tuile_decimal(char text[TUILE_DECIMAL_BYTES], int32_t value, unsigned decimals);

/* Frames a second, as a mean that follows within some eight frames. Begins as {0}. */
typedef struct tuile_fps {
    uint32_t mean_us; /* of a frame, times 16; 0: none yet */
} tuile_fps_t;

/* To be told once a frame, outside of the callback: from frame to frame, 1 ... 10^7 microseconds; other values are held to that. */
void tuile_fps_frame(tuile_fps_t *fps, uint32_t frame_time_us);

/* Draws "37.5 fps"; "--.- fps" before the first frame. */
void tuile_text_fps(tuile_canvas_t *canvas, const tuile_font_t *font, int32_t x, int32_t y, uint32_t colour,
                    const tuile_fps_t *fps);

/* ---- gauges ---- */

typedef struct tuile_gauge {
    int32_t x, y, radius;         /* centre and size, pixels: the dial spans 2 radius + 1 of them */
    int32_t value, low, high;     /* low < high; the needle is held to them */
    uint8_t decimals;             /* of the number */
    uint32_t face, track, needle; /* colours; alpha 0: left out */
    uint32_t fill;                /* of the track up to the value */
    const tuile_font_t *font;     /* NULL: no number */
} tuile_gauge_t;

/* A dial that leaves a quarter of the turn open below. TUILE_ERROR_ARGUMENT unless low < high and 4 <= radius <= 1024. */
int tuile_draw_gauge(tuile_canvas_t *canvas, const tuile_gauge_t *gauge);

#endif
