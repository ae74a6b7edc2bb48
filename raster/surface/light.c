#include "../tune.h"

#include "light.h"

#include "../fill/gradient.h"

#define LIGHT_HIGHLIGHT_CHANNEL 3
#define LIGHT_ALPHA_CHANNEL 4

bool light_is_coloured(const surface_face_t *face) {
    const uint8_t *e = face->material.emission, *flat = face->flat_light;
    if (face->tinted) { return true; }
    if (face->material.flags & TUILE_MATERIAL_UNLIT) { return false; }
    return face->coloured || (e[0] | e[1] | e[2]) != 0 || (face->flat && (flat[0] != flat[1] || flat[0] != flat[2]));
}

static uint32_t corner_light(const surface_face_t *face, unsigned corner, unsigned channel) {
    const surface_corner_t *at = &face->corner[corner];
    if (face->material.flags & TUILE_MATERIAL_UNLIT) { return 255; }
    const uint32_t light = face->flat && !face->coloured ? face->flat_light[channel]
                           : face->coloured              ? at->attributes.light[channel]
                                                         : (at->at.depth_light & 255u);
    const uint32_t sum = light + face->material.emission[channel];
    return sum > 255 ? 255 : sum;
}

static uint32_t corner_channel(const surface_face_t *face, unsigned corner, unsigned channel) {
    const uint32_t light = corner_light(face, corner, channel);
    return face->tinted ? pixel_div255(light * face->corner[corner].attributes.colour[channel] + 127u) : light;
}

/* What all planes of a face share. */
typedef struct light_ground {
    int32_t x1, y1, x2, y2, area; /* counter-clockwise; below 2^31 in the guard band */
    int32_t reciprocal;           /* of a face within 32 pixels, else 0 */
    int32_t to_x, to_y;           /* from the first corner to the centre of pixel (0, 0) */
    unsigned second, third;       /* corners */
} light_ground_t;

static bool all_short(const light_ground_t *g) {
    const uint32_t side = 512;
    return (uint32_t)(g->x1 + (int32_t)side) < 2 * side && (uint32_t)(g->y1 + (int32_t)side) < 2 * side &&
           (uint32_t)(g->x2 + (int32_t)side) < 2 * side && (uint32_t)(g->y2 + (int32_t)side) < 2 * side;
}

static light_ground_t ground_of(const surface_corner_t corner[3]) {
    const vertex_t *a = &corner[0].at, *b = &corner[1].at, *c = &corner[2].at;
    light_ground_t g = {.x1 = b->x - a->x, .y1 = b->y - a->y, .x2 = c->x - a->x, .y2 = c->y - a->y, .second = 1, .third = 2};
    g.area = g.x2 * g.y1 - g.x1 * g.y2;
    if (g.area < 0) {
        const int32_t x = g.x1, y = g.y1;
        g.x1 = g.x2, g.y1 = g.y2;
        g.x2 = x, g.y2 = y;
        g.area = -g.area;
        g.second = 2, g.third = 1;
    }
    g.reciprocal = all_short(&g) ? INT32_MAX / g.area : 0;
    g.to_x = 8 - a->x;
    g.to_y = 8 - a->y;
    return g;
}

static light_plane_t plane_on(const light_ground_t *f, const uint8_t value[3]) {
    const int32_t c1 = value[f->second] - value[0], c2 = value[f->third] - value[0];
    const gradient_t g = f->reciprocal ? gradient_small(c1, c2, f->x1, f->y1, f->x2, f->y2, f->reciprocal, 27)
                                       : gradient_exact(c1, c2, f->x1, f->y1, f->x2, f->y2, f->area, 27);
    const uint32_t at_corner = ((uint32_t)value[0] + 64u) << 23 | UINT32_C(1) << 22, dx = (uint32_t)g.dx, dy = (uint32_t)g.dy;
    return (light_plane_t){at_corner + (uint32_t)gradient_part(g, f->to_x & 15, f->to_y & 15) + dx * (uint32_t)(f->to_x >> 4) +
                               dy * (uint32_t)(f->to_y >> 4),
                           dx, dy};
}

light_plane_t light_plane(const surface_corner_t corner[3], const uint8_t value[3]) {
    const light_ground_t ground = ground_of(corner);
    return plane_on(&ground, value);
}

unsigned light_make(surface_t *surface, const surface_face_t *face, uint8_t factor[3]) {
    const bool shines = face->coloured && face->material.specular && !(face->material.flags & TUILE_MATERIAL_UNLIT);
    uint8_t value[4][3], alpha[3];
    unsigned varies = 0;
    for (unsigned i = 0; i < 3; i++) {
        const unsigned corner = face->triangle || face->whole ? i : 0;
        for (unsigned c = 0; c < 3; c++) {
            value[c][i] = (uint8_t)corner_channel(face, corner, c);
            if (value[c][i] != value[c][0]) { varies |= LIGHT_CHANNELS; }
        }
        const uint32_t highlight = face->corner[corner].attributes.light[LIGHT_HIGHLIGHT_CHANNEL];
        value[3][i] = (uint8_t)(shines ? pixel_div255(highlight * face->material.specular + 127u) : 0);
        if (value[3][i] != 0) { varies |= LIGHT_HIGHLIGHT; }
        alpha[i] = face->tinted ? face->corner[corner].attributes.colour[3] : 255;
        if (alpha[i] != 255) { varies |= LIGHT_ALPHA; }
    }
    light_ground_t ground = {0};
    if (varies) { ground = ground_of(face->corner); }
    for (unsigned c = 0; c < 3; c++) {
        factor[c] = varies & LIGHT_CHANNELS ? 255 : value[c][0];
        if (varies & LIGHT_CHANNELS) { surface->channel[c] = plane_on(&ground, value[c]); }
    }
    if (varies & LIGHT_HIGHLIGHT) { surface->channel[LIGHT_HIGHLIGHT_CHANNEL] = plane_on(&ground, value[3]); }
    if (varies & LIGHT_ALPHA) { surface->channel[LIGHT_ALPHA_CHANNEL] = plane_on(&ground, alpha); }
    return varies;
}

TUILE_INLINE uint32_t plane_at(const light_plane_t *plane, int32_t x, int32_t y) {
    return plane->light + plane->dx * (uint32_t)x + plane->dy * (uint32_t)y;
}

void light_stage_channels(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    const light_plane_t *plane = surface->channel;
    const uint32_t red_dx = plane[0].dx, green_dx = plane[1].dx, blue_dx = plane[2].dx;
    uint32_t red = plane_at(&plane[0], x, y), green = plane_at(&plane[1], x, y), blue = plane_at(&plane[2], x, y);
    for (int32_t i = 0; i < count; i++, red += red_dx, green += green_dx, blue += blue_dx) {
        const uint32_t c = argb[i];
        argb[i] = (c & 0xff000000u) | PIXEL_RGB(pixel_div255((c >> 16 & 255u) * light_held(red) + 127u),
                                                pixel_div255((c >> 8 & 255u) * light_held(green) + 127u),
                                                pixel_div255((c & 255u) * light_held(blue) + 127u));
    }
}

void light_stage_alpha(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    const light_plane_t *plane = &surface->channel[LIGHT_ALPHA_CHANNEL];
    uint32_t v = plane_at(plane, x, y);
    for (int32_t i = 0; i < count; i++, v += plane->dx) {
        argb[i] = (argb[i] & 0xffffffu) | pixel_div255((argb[i] >> 24) * light_held(v) + 127u) << 24;
    }
}

TUILE_INLINE uint32_t added(uint32_t a, uint32_t b) { return a + b > 255u ? 255u : a + b; }

void light_stage_highlight(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    const light_plane_t *plane = &surface->channel[LIGHT_HIGHLIGHT_CHANNEL];
    uint32_t v = plane_at(plane, x, y);
    for (int32_t i = 0; i < count; i++, v += plane->dx) {
        const uint32_t c = argb[i], highlight = light_held(v);
        argb[i] = (c & 0xff000000u) |
                  PIXEL_RGB(added(c >> 16 & 255u, highlight), added(c >> 8 & 255u, highlight), added(c & 255u, highlight));
    }
}
