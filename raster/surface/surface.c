#include "../tune.h"

#include "surface.h"

#include "../fill/gradient.h"

/* ---- into the tile ---- */

void surface_fill_same(const surface_t *surface, int32_t x, int32_t y, int32_t count, void *samples) {
    (void)x;
    (void)y;
    if (pixel_bytes(surface->kind) == 4) {
        paint_ids(samples, count, surface->sample);
    } else {
        paint_flat(samples, count, (uint16_t)surface->sample);
    }
}

static void store(pixel_kind_t kind, const uint32_t *argb, int32_t count, void *samples) {
    if (kind == PIXEL_RGB888) {
        uint32_t *to = samples;
        for (int32_t i = 0; i < count; i++) {
            to[i] = argb[i] & 0xffffffu;
        }
        return;
    }
    uint16_t *to = samples;
    for (int32_t i = 0; i < count; i++) {
        to[i] = (uint16_t)pixel_pack(kind, argb[i]);
    }
}

void surface_fill_stages(const surface_t *surface, int32_t x, int32_t y, int32_t count, void *samples) {
    uint8_t *to = samples;
    while (count > 0) {
        uint32_t argb[SURFACE_RUN];
        const int32_t now = count < SURFACE_RUN ? count : SURFACE_RUN;
        for (unsigned i = 0; i < SURFACE_STAGES && surface->stage[i] != NULL; i++) {
            surface->stage[i](surface, x, y, now, argb);
        }
        store(surface->kind, argb, now, to);
        x += now;
        count -= now;
        to += (size_t)now * pixel_bytes(surface->kind);
    }
}

/* ---- stages ---- */

static void stage_same(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    (void)x;
    (void)y;
    for (int32_t i = 0; i < count; i++) {
        argb[i] = surface->argb;
    }
}

static void stage_white_light(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    const light_plane_t *plane = &surface->light;
    uint32_t light = plane->light + plane->dx * (uint32_t)x + plane->dy * (uint32_t)y;
    for (int32_t i = 0; i < count; i++, light += plane->dx) {
        const uint32_t l = light >> 24, c = argb[i];
        argb[i] = (c & 0xff000000u) | PIXEL_RGB(pixel_div255((c >> 16 & 255u) * l + 127u), pixel_div255((c >> 8 & 255u) * l + 127u),
                                                pixel_div255((c & 255u) * l + 127u));
    }
}

/* ---- making one ---- */

/* The light of the three corners as a plane; `a` is a topmost corner, counter-clockwise. */
static void white_light(surface_t *surface, const vertex_t *a, const vertex_t *b, const vertex_t *c) {
    depth_plane_t unused;
    triangle_planes(a, b, c, &unused, &surface->light);
}

void surface_make(surface_t *surface, const surface_face_t *face, pixel_kind_t kind) {
    const uint8_t *colour = face->material.colour;
    const vertex_t *a = &face->corner[0].at, *b = &face->corner[1].at, *c = &face->corner[2].at;
    surface->kind = kind;
    surface->blend = face->material.blend;
    surface->argb = (uint32_t)face->material.alpha << 24 | PIXEL_RGB(colour[0], colour[1], colour[2]);
    const bool same_light = face->flat || ((uint8_t)a->depth_light == (uint8_t)b->depth_light && (uint8_t)a->depth_light == (uint8_t)c->depth_light);
    if (same_light) {
        const uint8_t light = face->flat ? face->flat_light[0] : (uint8_t)a->depth_light;
        surface->sample = pixel_lit(kind, colour, light);
        surface->fill = surface_fill_same;
        return;
    }
    white_light(surface, a, b, c);
    surface->stage[0] = stage_same;
    surface->stage[1] = stage_white_light;
    surface->stage[2] = NULL;
    surface->fill = surface_fill_stages;
}
