/* Lines between points of the world, and edges of faces.
 *
 * A line is walked in the same direction whichever way round it was given, so an edge that two faces share is the same pixels for
 * both. Its depth is affine in the window, as that of faces is.
 *
 * A line on a face must be seen, though a pixel of it may be half a pixel off and the face a step nearer there. Lines are therefore
 * LINE_BIAS steps nearer than they are. Edges have no need of that: a face's edge has the depth of the face's own plane, at the
 * pixel's centre, and one step more, so that no face hides its own edges, and of two faces that share one each shows its own.
 *
 * Outlines are the edges of back faces, a pixel wider on both sides, where no face hides them: what is left is the part outside the
 * silhouette. That needs no table of neighbours, and is the same in all methods and tiles.
 */
#include "layer.h"

#include "../draw/line.h"
#include "../frame/shade.h"

#define LINE_BIAS 8 /* steps of depth */

typedef struct stroke {
    const tuile_t *t;
    layer_band_t *band;
    layer_place_t from, to;     /* from is the upper one, or the left one of two on one row */
    const depth_plane_t *plane; /* NULL: the depth is that along the line */
    uint32_t rank, rgb;
    int32_t bias, wide; /* steps; pixels on either side */
} stroke_t;

static void stroke_turn(stroke_t *s) {
    if (s->from.y < s->to.y || (s->from.y == s->to.y && s->from.x <= s->to.x)) { return; }
    const layer_place_t from = s->from;
    s->from = s->to;
    s->to = from;
}

static uint16_t depth_held(int64_t steps) { return (uint16_t)(steps < 1 ? 1 : steps > 65535 ? 65535 : steps); }

static void stroke_put(const stroke_t *s, int32_t x, int32_t y, uint32_t alpha, int64_t along_depth) {
    layer_band_t *band = s->band;
    if (x < band->left || x >= band->right || y < band->top || y >= band->bottom) { return; }
    const int64_t true_depth = s->plane ? (int64_t)depth_at(s->plane, x, y) : along_depth;
    const uint16_t depth = depth_held(true_depth + s->bias);
    if (!layer_wants(band, x, y, depth, s->rank)) { return; }
    const uint32_t argb = layer_fogged(s->t, (uint32_t)depth_held(true_depth) << 8, alpha << 24 | s->rgb, TUILE_BLEND_OVER);
    layer_put(band, x, y, depth, s->rank, argb);
}

/* The depth after `i` of `count` parts of the way, in steps, rounded. */
static int64_t depth_along(const stroke_t *s, int64_t i, int64_t count) {
    const int64_t from = s->from.depth, way = (int64_t)s->to.depth - from;
    return ((count > 0 ? from + fixed_floor_div64(way * i, count) : from) + 128) >> 8;
}

/* Bresenham's line from the pixel of one end to that of the other. */
static void stroke_plain(const stroke_t *s) {
    const layer_band_t *band = s->band;
    const int32_t from[2] = {s->from.x >> 4, s->from.y >> 4}, to[2] = {s->to.x >> 4, s->to.y >> 4};
    /* Wide ones reach into the band from beside it. */
    const raster_tile_t tile = {
        .left = band->left - s->wide, .top = band->top - s->wide, .right = band->right + s->wide, .bottom = band->bottom + s->wide};
    line_t line;
    if (!line_start(&line, from, to, &tile)) { return; }
    for (;; line_step(&line)) {
        const bool flat = line.along_x != 0;
        const int32_t i = flat ? (line.x - from[0]) * line.along_x : (line.y - from[1]) * line.along_y;
        const int64_t depth = s->plane ? 0 : depth_along(s, i, line.major);
        for (int32_t k = -s->wide; k <= s->wide; k++) {
            stroke_put(s, line.x + (flat ? 0 : k), line.y + (flat ? k : 0), 255, depth);
        }
        if (line.count == 1) { return; }
    }
}

/* One pixel wide, as coverage: in each column of a flat line (or row of a steep one) whose centre the line passes, the two pixels
 * whose centres are next to it share 255 by their distances. */
static void stroke_smooth(const stroke_t *s) {
    const layer_band_t *band = s->band;
    const int32_t dx = s->to.x - s->from.x, dy = s->to.y - s->from.y;
    const bool flat = (dx < 0 ? -dx : dx) > dy;
    layer_place_t a = s->from, b = s->to;
    if (flat && dx < 0) { a = s->to, b = s->from; }
    const int32_t a_along = flat ? a.x : a.y, b_along = flat ? b.x : b.y, a_aside = flat ? a.y : a.x, b_aside = flat ? b.y : b.x;
    const int32_t low = flat ? band->left : band->top, high = flat ? band->right : band->bottom;
    const int64_t length = b_along - a_along;
    if (length <= 0) { return; } /* no middle of a pixel is between the ends */
    int32_t first = (a_along + 7) >> 4, end = (b_along + 7) >> 4;
    if (first < low) { first = low; }
    if (end > high) { end = high; }
    for (int32_t i = first; i < end; i++) {
        const int64_t way = 16 * (int64_t)i + 8 - a_along; /* < length */
        /* 1/256 pixel from the centre of pixel 0: 2^18 * 2^18 * 2^4 */
        const int64_t aside =
            16 * ((int64_t)a_aside - 8) + fixed_floor_div64(16 * (int64_t)(b_aside - a_aside) * way + length / 2, length);
        const int32_t pixel = (int32_t)(aside >> 8);
        const uint32_t part = ((uint32_t)(aside & 255) * 255 + 128) >> 8;
        const int64_t depth = ((int64_t)a.depth + fixed_floor_div64(((int64_t)b.depth - a.depth) * way, length) + 128) >> 8;
        stroke_put(s, flat ? i : pixel, flat ? pixel : i, 255 - part, depth);
        stroke_put(s, flat ? i : pixel + 1, flat ? pixel + 1 : i, part, depth);
    }
}

/* ---- lines of the scene ---- */

static layer_view_t middle(const layer_view_t *a, const layer_view_t *b) {
    return (layer_view_t){(a->x + b->x) >> 1, (a->y + b->y) >> 1, (a->w + b->w) >> 1};
}

/* The last point inside on the way from `in` to `out`, to the units of view coordinates: what is inside is convex. */
static layer_view_t last_inside(const tuile_camera_t *camera, layer_view_t in, layer_view_t out) {
    for (unsigned i = 0; i < 36; i++) {
        const layer_view_t at = middle(&in, &out);
        if (layer_inside(camera, &at)) {
            in = at;
        } else {
            out = at;
        }
    }
    return in;
}

/* Some point inside, where both ends are outside: the half in which the ends are beyond the same plane has none. */
typedef struct codes {
    unsigned a, b;
} codes_t;

static unsigned code_of(const tuile_camera_t *camera, const layer_view_t *at) {
    if (at->w < camera->near) { return 1; }
    if (at->w > camera->far) { return 2; }
    if (layer_inside(camera, at)) { return 0; }
    const int64_t w = camera->projection == TUILE_PERSPECTIVE ? at->w : INT32_C(1) << 16, edge = (int64_t)LAYER_GUARD * 256 * w;
    const int64_t x = (int64_t)(camera->focal_x >> 8) * at->x, y = (int64_t)(camera->focal_y >> 8) * at->y;
    return (x > edge ? 4u : x < -edge ? 8u : 0u) | (y > edge ? 16u : y < -edge ? 32u : 0u);
}

static bool point_inside(const tuile_camera_t *camera, layer_view_t a, layer_view_t b, layer_view_t *in) {
    codes_t code = {code_of(camera, &a), code_of(camera, &b)};
    for (unsigned i = 0; i < 36 && (code.a & code.b) == 0; i++) {
        *in = middle(&a, &b);
        const unsigned c = code_of(camera, in);
        if (c == 0) { return true; }
        if (c & code.a) {
            a = *in;
            code.a = c;
        } else {
            b = *in;
            code.b = c;
        }
    }
    return false;
}

static bool line_clip(const tuile_camera_t *camera, layer_view_t *a, layer_view_t *b) {
    const bool a_in = layer_inside(camera, a), b_in = layer_inside(camera, b);
    layer_view_t in = *a;
    if (a_in && b_in) { return true; }
    if (!a_in && !b_in && !point_inside(camera, *a, *b, &in)) { return false; }
    if (!a_in) { *a = last_inside(camera, b_in ? *b : in, *a); }
    if (!b_in) { *b = last_inside(camera, a_in ? *a : in, *b); }
    return true;
}

void layer_lines(tuile_t *t, layer_band_t *band) {
    for (unsigned i = 0; i < t->scene->line_count; i++) {
        const tuile_line_t *line = &t->scene->lines[i];
        layer_view_t a = layer_to_view(&t->camera, line->from), b = layer_to_view(&t->camera, line->to);
        if (!line_clip(&t->camera, &a, &b)) { continue; }
        stroke_t stroke = {.t = t,
                           .band = band,
                           .from = layer_project(&t->camera, &a),
                           .to = layer_project(&t->camera, &b),
                           .rank = layer_rank(LAYER_LINES, i, TUILE_BLEND_OVER),
                           .rgb = PIXEL_RGB(line->colour[0], line->colour[1], line->colour[2]),
                           .bias = LINE_BIAS};
        stroke_turn(&stroke);
        if (line->smooth) {
            stroke_smooth(&stroke);
        } else {
            stroke_plain(&stroke);
        }
    }
}

/* ---- edges of faces ---- */

static layer_place_t corner_place(const vertex_t *v) { return (layer_place_t){v->x, v->y, v->depth_light >> 8}; }

static void edge_offer(stroke_t *stroke, const vertex_t *a, const vertex_t *b) {
    stroke->from = corner_place(a);
    stroke->to = corner_place(b);
    stroke_turn(stroke);
    stroke_plain(stroke);
}

void layer_edges(tuile_t *t, layer_band_t *band, uint32_t number, uint32_t rank_number) {
    const record_t *record = frame_record(t, number);
    const uint8_t *colour = t->config.edge_colour;
    const bool outline = t->config.edges == TUILE_EDGES_OUTLINE;
    depth_plane_t plane;
    if (!shade_depth(t, record, &plane)) { return; }
    stroke_t stroke = {.t = t,
                       .band = band,
                       .plane = outline ? NULL : &plane,
                       .rank = layer_rank(LAYER_EDGES, rank_number, TUILE_BLEND_OVER),
                       .rgb = PIXEL_RGB(colour[0], colour[1], colour[2]),
                       .bias = outline ? 0 : 1,
                       .wide = outline};
    if (frame_record_is_triangle(record)) {
        const vertex_t *v0 = &t->vertices[record->v0], *v1 = v0 + record->d1, *v2 = v0 + record->d2;
        edge_offer(&stroke, v0, v1);
        edge_offer(&stroke, v1, v2);
        edge_offer(&stroke, v2, v0);
        return;
    }
    const polygon_ring_t ring = frame_record_ring(t, record);
    for (uint32_t i = 0; i < ring.count; i++) {
        edge_offer(&stroke, polygon_ring_vertex(&ring, i), polygon_ring_vertex(&ring, i + 1 == ring.count ? 0 : i + 1));
    }
}
