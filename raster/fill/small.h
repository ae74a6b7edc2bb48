/* Small triangles under a z-buffer, set up and filled in one go, so that their state is never written to memory: most faces of a
 * mesh begin and end within one row of tiles, and for one that does not it is cheaper to be set up again below than to be carried
 * there. The numbers are those of fill/triangle.c, to the bit.
 *
 * Small: all sides short (fill/edge.h). Columns are counted from that of the top corner, so that
 * |column| <= 32. Numbers that fit in 32 bits are held as whole registers: where those have 64 bits nothing is widened again and
 * again.
 */
#ifndef TUILE_FILL_SMALL_H
#define TUILE_FILL_SMALL_H

#include "../divide.h"
#include "textured.h"
#include "triangle_set_up.h"

typedef int_fast32_t small_int_t;

/* Where a loop in assembly has come to in a list of records. */
typedef struct small_place {
    uint32_t list;  /* number + 1 of the next face's record */
    uint16_t *end;  /* where the number of the next face that reaches below the tile is put */
    uint32_t count; /* faces that were drawn */
} small_place_t;

/* How a triangle is drawn: a constant wherever these functions are called. */
typedef enum small_kind {
    SMALL_FLAT,
    SMALL_GOURAUD,
    SMALL_TEXTURED, /* in light as it is interpolated, RGB565, high byte first */
} small_kind_t;

/* What is drawn, by kind. */
typedef struct small_paint {
    uint16_t value;       /* flat */
    const uint16_t *ramp; /* Gouraud: 64 colours */
    textured_map_t map;   /* textured; v is that of the pixel (row, column) of small_face_t */
    textured_constants_t constants;
} small_paint_t;

/* A tile as small triangles see it. */
typedef struct small_tile {
    uint16_t *depth;
    ptrdiff_t colour;        /* from a pixel's depth to its colour, in pixels of 2 bytes */
    small_int_t stride;      /* pixels */
    small_int_t origin;      /* of pixel (0, 0) of the window, counted from `depth` */
    small_int_t top, bottom; /* rows of the window */
    small_int_t first, end;  /* columns of the window */
    int32_t left, width;     /* corners whose x - left is in 0 ... width - 1 touch no column beside the tile; 1/16 pixel */
} small_tile_t;

TUILE_INLINE small_tile_t small_tile(const raster_tile_t *tile) {
    return (small_tile_t){.depth = tile->depth,
                          .colour = (uint16_t *)tile->colour - tile->depth,
                          .stride = tile->stride_px,
                          .origin = -((small_int_t)tile->top * tile->stride_px + tile->left),
                          .top = tile->top,
                          .bottom = tile->bottom,
                          .first = tile->left,
                          .end = tile->right,
                          .left = 16 * tile->left - 7,
                          .width = 16 * (tile->right - tile->left + 1)};
}

/* Corners relative to the first one, which is a topmost: 1/16 pixel. */
typedef struct small_corners {
    small_int_t x0, y0, x1, y1, x2, y2;
} small_corners_t;

TUILE_INLINE bool small_within(small_int_t difference) { return (uint32_t)(difference + (SHORT_SIDE - 1)) <= 2 * SHORT_SIDE - 2; }

TUILE_INLINE bool small_in_columns(const small_tile_t *tile, small_int_t x) {
    return (uint32_t)(x - tile->left) < (uint32_t)tile->width;
}

TUILE_INLINE bool small_short(const small_corners_t *c) {
    return small_within(c->x1) && small_within(c->x2) && small_within(c->x1 - c->x2) && (c->y1 | c->y2) < SHORT_SIDE;
}

TUILE_INLINE bool small_inside(const small_corners_t *c, const small_tile_t *tile) {
    return small_in_columns(tile, c->x0) && small_in_columns(tile, c->x0 + c->x1) && small_in_columns(tile, c->x0 + c->x2);
}

/* What is affine over the triangle, at the centre of a pixel: to_x right and to_y below the top corner, sixteenths of a pixel, 1
 * ... 16 and 1 ... 2^9. |gradients| < 2^46: the sum stays below 2^57. */
TUILE_INLINE uint64_t small_at(gradient_t g, int64_t at_corner, small_int_t to_x, small_int_t to_y) {
    if (FIXED_BY_HALVES) { /* modulo 2^32, which is enough where registers have 32 bits */
        const uint32_t x = (uint32_t)to_x, y = (uint32_t)to_y;
        const uint32_t whole = (uint32_t)(g.dx >> 16) * x + (uint32_t)(g.dy >> 16) * y;
        const uint32_t part = fixed_low_half((uint32_t)g.dx) * x + fixed_low_half((uint32_t)g.dy) * y; /* < 2^20 + 2^25 */
        return (uint32_t)at_corner + (whole << 12) + (part >> 4);
    }
    const uint64_t sum = fixed_mul_part((uint64_t)g.dx, (uint32_t)to_x) + fixed_mul_part((uint64_t)g.dy, (uint32_t)to_y);
    return (uint64_t)(at_corner + ((int64_t)sum >> 4));
}

/* Depth and light as fill/triangle.c packs them, in one register where that has 64 bits. Elsewhere in two that carry nothing to one
 * another, which is the same wherever a pixel is drawn: light is within its 32 bits there, so the sum of both has the depth above.
 */
#if FIXED_WIDE_REGISTERS
typedef uint64_t small_shade_t;

TUILE_INLINE small_shade_t small_shade(uint64_t depth, uint64_t light) {
    return triangle_shade_pack((int64_t)depth, (int64_t)light);
}
TUILE_INLINE small_shade_t small_shade_sum(small_shade_t a, small_shade_t b) { return a + b; }
TUILE_INLINE small_shade_t small_shade_times(small_shade_t a, small_int_t n) { return a * (uint64_t)n; }
TUILE_INLINE uint32_t small_shade_depth(small_shade_t a) { return (uint32_t)(a >> 32); }
TUILE_INLINE uint32_t small_shade_light(small_shade_t a) { return (uint32_t)a; }
#else
typedef struct small_shade {
    uint32_t depth, light;
} small_shade_t;

TUILE_INLINE small_shade_t small_shade(uint64_t depth, uint64_t light) { return (small_shade_t){(uint32_t)depth, (uint32_t)light}; }
TUILE_INLINE small_shade_t small_shade_sum(small_shade_t a, small_shade_t b) {
    return (small_shade_t){a.depth + b.depth, a.light + b.light};
}
TUILE_INLINE small_shade_t small_shade_times(small_shade_t a, small_int_t n) {
    return (small_shade_t){a.depth * (uint32_t)n, a.light * (uint32_t)n};
}
TUILE_INLINE uint32_t small_shade_depth(small_shade_t a) { return a.depth; }
TUILE_INLINE uint32_t small_shade_light(small_shade_t a) { return a.light; }
#endif

/* Of triangles whose depths are far apart: one in six. Where that takes much code it is not in line. */
#if FIXED_BY_HALVES
TUILE_SELDOM
#else
TUILE_INLINE
#endif
triangle_gradients_t small_gradients_exact(const small_corners_t *c, int32_t z1, int32_t z2, int32_t light1, int32_t light2,
                                           bool gouraud) {
    const int32_t x1 = (int32_t)c->x1, y1 = (int32_t)c->y1, x2 = (int32_t)c->x2, y2 = (int32_t)c->y2, area = x2 * y1 - x1 * y2;
    const int32_t reciprocal = FIXED_BY_HALVES ? divide_area(area) : 0;
    triangle_gradients_t g = {{0, 0}, {0, 0}};
    g.depth = gradient_exact_short(z1, z2, x1, y1, x2, y2, area, reciprocal, 12);
    if (gouraud) { g.light = gradient_exact_short(light1, light2, x1, y1, x2, y2, area, reciprocal, 28); }
    return g;
}

TUILE_INLINE triangle_gradients_t small_gradients(const small_corners_t *c, const vertex_t *v0, const vertex_t *v1,
                                                  const vertex_t *v2, bool gouraud) {
    const int32_t x1 = (int32_t)c->x1, y1 = (int32_t)c->y1, x2 = (int32_t)c->x2, y2 = (int32_t)c->y2;
    const int32_t z0 = (int32_t)(v0->depth_light >> 8), z1 = (int32_t)(v1->depth_light >> 8) - z0,
                  z2 = (int32_t)(v2->depth_light >> 8) - z0;
    const int32_t light0 = (int32_t)(v0->depth_light & 0xff), light1 = (int32_t)(v1->depth_light & 0xff) - light0,
                  light2 = (int32_t)(v2->depth_light & 0xff) - light0;
    triangle_gradients_t g = {{0, 0}, {0, 0}};
    if (TUILE_LIKELY(triangle_depths_near(z1, z2))) {
        const int32_t reciprocal = divide_area(x2 * y1 - x1 * y2);
        g.depth = gradient_small(z1, z2, x1, y1, x2, y2, reciprocal, 12);
        if (gouraud) { g.light = gradient_small(light1, light2, x1, y1, x2, y2, reciprocal, 28); }
    } else {
        const small_corners_t copy = *c; /* so that here they stay in registers */
        g = small_gradients_exact(&copy, z1, z2, light1, light2, gouraud);
    }
    return g;
}

typedef struct small_side {
    small_int_t x, slope; /* short_edge_t */
} small_side_t;

/* One side at the centre of a row `t` sixteenths below its upper end, which is `start` in columns (small_start). With the bias of
 * fill/edge.h, 1 + e, any slope is good that keeps that above 0 and up to 128, 64 lying in the middle. One that is off changes e by
 * t / 16 times as much, t <= dy < 512: divide_side's by less than 32 for its floor and |dx| / 64 < 8 for the rest. */
TUILE_INLINE small_side_t small_side(small_int_t start, small_int_t dx, small_int_t dy, small_int_t t) {
    const int32_t slope = divide_side((int32_t)dx, (int32_t)dy);
    return (small_side_t){start + ((t * slope) >> 4), slope};
}

/* x sixteenths right of the column's centre. */
TUILE_INLINE small_int_t small_start(small_int_t x) { return x * (INT32_C(1) << 16) + ((INT32_C(1) << 20) - 64); }

/* ---- rows and pixels ---- */

/* The rows of a triangle that are being filled. */
typedef struct small_rows {
    small_side_t a, b;        /* left and right, in columns */
    small_shade_t at, dx, dy; /* in the column, and per pixel right and down */
    uint32_t map;             /* of the texture, in the column */
    uint16_t *depth;          /* of the column */
    small_int_t left, right;  /* the tile's columns */
} small_rows_t;

TUILE_INLINE void small_span_flat(uint16_t *depth, const uint16_t *end, ptrdiff_t colour, uint32_t shade, uint32_t dx,
                                  uint16_t value) {
    do {
        const uint16_t z = (uint16_t)(shade >> 16);
        if (z > *depth) {
            *depth = z;
            depth[colour] = value;
        }
        shade += dx;
    } while (++depth != end);
}

TUILE_INLINE void small_span_gouraud(uint16_t *depth, const uint16_t *end, ptrdiff_t colour, small_shade_t shade, small_shade_t dx,
                                     const uint16_t *ramp) {
    do {
        const uint16_t z = (uint16_t)(small_shade_depth(shade) >> 16);
        if (z > *depth) {
            *depth = z;
            depth[colour] = ramp[small_shade_light(shade) >> 26];
        }
        shade = small_shade_sum(shade, dx);
    } while (++depth != end);
}

TUILE_INLINE void small_span_textured(uint16_t *depth, const uint16_t *end, ptrdiff_t colour, small_shade_t shade, small_shade_t dx,
                                      const small_paint_t *paint, uint32_t at, bool paletted) {
    const textured_map_t *map = &paint->map;
    const uint32_t at_dx = map->dx, mask = map->mask, shift = map->shift;
    do {
        const uint16_t z = (uint16_t)(small_shade_depth(shade) >> 16);
        if (z > *depth) {
            const uint32_t index = textured_index(at, mask, shift, &paint->constants),
                           texel = textured_texel(map->texels, map->palette, index, paletted);
            *depth = z;
            depth[colour] = textured_lit(texel, textured_levels_of(small_shade_light(shade)), &paint->constants, true);
        }
        shade = small_shade_sum(shade, dx);
        at += at_dx;
    } while (++depth != end);
}

/* Pixels from ... to - 1 of a row, from < to. */
TUILE_INLINE void small_span(const small_rows_t *r, const small_tile_t *tile, small_int_t from, small_int_t to, small_kind_t kind,
                             const small_paint_t *paint) {
    uint16_t *depth = r->depth + from;
    const uint16_t *const end = r->depth + to;
    const small_shade_t shade = small_shade_sum(r->at, small_shade_times(r->dx, from));
    if (kind == SMALL_FLAT) {
        small_span_flat(depth, end, tile->colour, small_shade_depth(shade), small_shade_depth(r->dx), paint->value);
    } else if (kind == SMALL_GOURAUD) {
        small_span_gouraud(depth, end, tile->colour, shade, r->dx, paint->ramp);
    } else if (paint->map.palette) {
        small_span_textured(depth, end, tile->colour, shade, r->dx, paint, r->map + paint->map.dx * (uint32_t)from, true);
    } else {
        small_span_textured(depth, end, tile->colour, shade, r->dx, paint, r->map + paint->map.dx * (uint32_t)from, false);
    }
}

TUILE_INLINE small_int_t small_step(small_side_t side) { /* may wrap behind the last row */
    return (small_int_t)((uint_fast32_t)side.x + (uint_fast32_t)side.slope);
}

/* count > 0. clamp: the triangle may touch columns beside the tile, whose own are left ... right - 1; a constant. */
TUILE_INLINE void small_rows_fill(small_rows_t *r, const small_tile_t *tile, small_int_t count, small_kind_t kind,
                                  const small_paint_t *paint, bool clamp) {
    const small_int_t left = r->left, right = r->right;
    do {
        small_int_t from = r->a.x >> 20, to = r->b.x >> 20;
        if (clamp) {
            from = from > left ? from : left;
            to = to < right ? to : right;
        }
        if (from < to) { small_span(r, tile, from, to, kind, paint); }
        r->a.x = small_step(r->a);
        r->b.x = small_step(r->b);
        r->at = small_shade_sum(r->at, r->dy);
        if (kind == SMALL_TEXTURED) { r->map += paint->map.dy; }
        r->depth += tile->stride;
    } while (--count);
}

/* ---- set-up ---- */

/* Which corner is where: `low` is the lowest one, which the long side ends at. */
typedef struct small_bend {
    small_int_t mid_x, mid_y, low_x, low_y;
    bool left; /* the corner between is on the left side */
} small_bend_t;

TUILE_INLINE void small_turn(small_rows_t *r, bool left, small_side_t side) {
    if (left) {
        r->a = side;
    } else {
        r->b = side;
    }
}

/* A small triangle in a tile: where it begins there. */
typedef struct small_face {
    small_corners_t corners;
    small_int_t row, column; /* the pixel that all is counted from */
    small_int_t to_x, to_y;  /* its centre from the top corner, sixteenths of a pixel */
} small_face_t;

/* What is known of a triangle beforehand. */
enum { SMALL_IS_SHORT = 1, SMALL_IS_INSIDE = 2 };

/* v0 is a topmost corner, v0 v1 v2 is counter-clockwise as seen, with an area above 0, and it spans some row of the tile. False: it
 * is not small. known: SMALL_IS_... */
TUILE_INLINE bool small_open(small_face_t *face, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                             const small_tile_t *tile, unsigned known) {
    const small_corners_t c = {v0->x, v0->y, v1->x - v0->x, v1->y - v0->y, v2->x - v0->x, v2->y - v0->y};
    const small_int_t first = (c.y0 + 7) >> 4;
    face->corners = c;
    face->row = first > tile->top ? first : tile->top;
    face->column = (c.x0 + 7) >> 4;
    face->to_x = 16 * face->column + 8 - c.x0;
    face->to_y = 16 * face->row + 8 - c.y0;
    return known & SMALL_IS_SHORT || small_short(&c);
}

/* Draws it from the tile's first row to its last. smooth: light is interpolated; else it is `light`. clamp: small_rows_fill. True:
 * it reaches below. */
TUILE_INLINE bool small_fill(const small_face_t *face, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                             const small_tile_t *tile, small_kind_t kind, bool smooth, uint8_t light, const small_paint_t *paint,
                             bool clamp) {
    const small_corners_t c = face->corners;
    const small_int_t to_x = face->to_x, to_y = face->to_y, row = face->row;
    const triangle_gradients_t g = small_gradients(&c, v0, v1, v2, smooth);
    small_rows_t r;
    const uint64_t light_at = smooth ? small_at(g.light, triangle_light_of(v0), to_x, to_y) : (uint64_t)light << 24;
    r.at = small_shade(small_at(g.depth, triangle_depth_of(v0), to_x, to_y), kind == SMALL_FLAT ? 0 : light_at);
    r.dx = small_shade((uint64_t)g.depth.dx, (uint64_t)g.light.dx);
    r.dy = small_shade((uint64_t)g.depth.dy, (uint64_t)g.light.dy);
    if (kind == SMALL_TEXTURED) {
        r.at = small_shade_sum(r.at, small_shade(0, TEXTURED_BIAS));
        r.map = paint->map.v;
    }
    r.left = clamp ? tile->first - face->column : 0;
    r.right = clamp ? tile->end - face->column : 0;
    r.depth = tile->depth + (tile->origin + row * tile->stride + face->column);

    small_bend_t bend = {c.x1, c.y1, c.x2, c.y2, true};
    if (c.y1 >= c.y2) { bend = (small_bend_t){c.x2, c.y2, c.x1, c.y1, false}; }
    const small_int_t row_mid = (c.y0 + bend.mid_y + 7) >> 4, row_end = (c.y0 + bend.low_y + 7) >> 4,
                      end = row_end < tile->bottom ? row_end : tile->bottom;
    const small_int_t start = small_start(-to_x);
    small_int_t from = row;
    r.a = r.b = small_side(start, bend.low_x, bend.low_y, to_y);
    if (row < row_mid) {
        from = row_mid < end ? row_mid : end;
        small_turn(&r, bend.left, small_side(start, bend.mid_x, bend.mid_y, to_y));
        small_rows_fill(&r, tile, from - row, kind, paint, clamp);
    }
    if (from < end) {
        small_turn(&r, bend.left,
                   small_side(start + bend.mid_x * (INT32_C(1) << 16), bend.low_x - bend.mid_x, bend.low_y - bend.mid_y,
                              16 * from + 8 - c.y0 - bend.mid_y));
        small_rows_fill(&r, tile, end - from, kind, paint, clamp);
    }
    return row_end > tile->bottom;
}

#endif
