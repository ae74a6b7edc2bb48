#include "../tune.h"

#include "surface.h"

#include "../features.h"
#include "fog_stage.h"
#include "light.h"

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
    if (kind <= PIXEL_RGB565_LE) {
        for (int32_t i = 0; i < count; i++) {
            to[i] = (uint16_t)pixel_pack565(kind, argb[i] >> 16 & 255u, argb[i] >> 8 & 255u, argb[i] & 255u);
        }
        return;
    }
    for (int32_t i = 0; i < count; i++) {
        to[i] = (uint16_t)pixel_pack(kind, argb[i]);
    }
}

void surface_fill_stages(const surface_t *surface, int32_t x, int32_t y, int32_t count, void *samples) {
    uint8_t *to = samples;
    while (count > 0) {
        uint32_t argb[SURFACE_RUN];
        const int32_t now = count < SURFACE_RUN ? count : SURFACE_RUN;
        unsigned i = 0;
        do { /* the first stage is there: without any a face is filled with one sample */
            surface->stage[i](surface, x, y, now, argb);
        } while (++i < SURFACE_STAGES && surface->stage[i] != NULL);
        store(surface->kind, argb, now, to);
        x += now;
        count -= now;
        to += (size_t)now * pixel_bytes(surface->kind);
    }
}

void surface_run(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    for (int32_t i = 0; surface->stage[0] == NULL && i < count; i++) {
        argb[i] = surface->argb;
    }
    for (unsigned i = 0; i < SURFACE_STAGES && surface->stage[i] != NULL; i++) {
        surface->stage[i](surface, x, y, count, argb);
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

/* c * factor / 255, rounded, component by component. */
TUILE_INLINE uint32_t multiply(uint32_t c, uint32_t factor) {
    return pixel_div255((c >> 24) * (factor >> 24) + 127u) << 24 |
           PIXEL_RGB(pixel_div255((c >> 16 & 255u) * (factor >> 16 & 255u) + 127u),
                     pixel_div255((c >> 8 & 255u) * (factor >> 8 & 255u) + 127u),
                     pixel_div255((c & 255u) * (factor & 255u) + 127u));
}

static void stage_multiply(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    (void)x;
    (void)y;
    for (int32_t i = 0; i < count; i++) {
        argb[i] = multiply(argb[i], surface->argb);
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

static void stage_texture(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    texture_run(&surface->texture, x, y, count, argb);
}

/* ---- making one ---- */

/* Texture coordinates of a corner as texels, Q.8: the model's have `uv_bits` bits of fraction and 8 more. */
static texture_corner_t texture_corner(const surface_corner_t *corner, unsigned uv_bits) {
    return (texture_corner_t){corner->at.x, corner->at.y, corner->at.depth_light >> 8, corner->attributes.s >> uv_bits,
                              corner->attributes.t >> uv_bits};
}

/* The light of the three corners as a plane; `a` is a topmost corner, counter-clockwise. */
static void white_light(surface_t *surface, const vertex_t *a, const vertex_t *b, const vertex_t *c) {
    depth_plane_t unused;
    triangle_planes(a, b, c, &unused, &surface->light);
}

/* ---- the fast way of a texture ---- */

static void fill_textured(const surface_t *surface, int32_t x, int32_t y, int32_t count, void *samples) {
    const light_plane_t *light = &surface->light;
    textured_run(&surface->map, x, y, count, light->light + light->dx * (uint32_t)x + light->dy * (uint32_t)y, light->dx,
                 surface->kind == PIXEL_RGB565_BE, samples);
}

static bool textured_open(surface_t *surface, const surface_face_t *face, int32_t alike) {
    const surface_corner_t *corner = face->corner;
    const vertex_t *v0 = &corner[0].at, *v1 = &corner[1].at, *v2 = &corner[2].at;
    const uint8_t *flat = face->flat_light;
    if ((face->flat && (flat[0] != flat[1] || flat[0] != flat[2])) || !face->triangle || face->coloured || face->tinted ||
        surface->kind > PIXEL_RGB565_LE || !triangle_sides_short(v0, v1, v2)) {
        return false;
    }
    textured_material_t material;
    const unsigned uv_bits = face->material.uv_bits;
    unsigned down = 8;
    textured_material_open(&material, &face->material, &face->texture, face->texturing, face->perspective, uv_bits);
    if (!material.fit) { return false; }
    int32_t s[3], t[3], any = 0;
    for (unsigned i = 0; i < 3; i++) {
        any |= corner[i].attributes.s | corner[i].attributes.t;
    }
    if (any & 255) { /* made by clipping: no coordinates of the model, which are whole; 8 bits of fraction are enough */
        down = uv_bits;
        textured_material_open(&material, &face->material, &face->texture, face->texturing, face->perspective, 8);
    }
    for (unsigned i = 0; i < 3; i++) {
        s[i] = corner[i].attributes.s >> down;
        t[i] = corner[i].attributes.t >> down;
    }
    const textured_face_t at = {.x1 = v1->x - v0->x,
                                .y1 = v1->y - v0->y,
                                .x2 = v2->x - v0->x,
                                .y2 = v2->y - v0->y,
                                .depth0 = v0->depth_light >> 8,
                                .depth1 = v1->depth_light >> 8,
                                .depth2 = v2->depth_light >> 8,
                                .s0 = s[0],
                                .t0 = t[0],
                                .s1 = s[1] - s[0],
                                .t1 = t[1] - t[0],
                                .s2 = s[2] - s[0],
                                .t2 = t[2] - t[0]};
    if (!textured_map_at_origin(&surface->map, &material, &at, v0->x, v0->y)) { return false; }
    if (alike < 0) {
        white_light(surface, v0, v1, v2);
    } else {
        surface->light = (light_plane_t){(uint32_t)alike << 24, 0, 0};
    }
    surface->fill = fill_textured;
    return true;
}

/* ---- any texture ---- */

static void texture_open(surface_t *surface, const surface_face_t *face, const texture_corner_t corner[3]) {
    texture_plane_make(
        &surface->texture, &face->texture, corner,
        (texture_wish_t){.bilinear = face->material.flags & TUILE_MATERIAL_BILINEAR && !(face->texturing & TUILE_TEXTURE_NEAREST),
                         .affine = face->texturing & TUILE_TEXTURE_AFFINE,
                         .mips = !(face->texturing & TUILE_TEXTURE_NO_MIPS),
                         .perspective = face->perspective,
                         .least = face->least,
                         .most = face->most});
}

/* The light of a face that is lit alike all over, or -1. */
static int32_t light_alike(const surface_face_t *face) {
    const uint8_t a = (uint8_t)face->corner[0].at.depth_light;
    if (face->material.flags & TUILE_MATERIAL_UNLIT) { return 255; }
    if (face->flat) { return face->flat_light[0]; }
    return (uint8_t)face->corner[1].at.depth_light == a && (uint8_t)face->corner[2].at.depth_light == a ? a : -1;
}

static uint32_t rgb_lit(const uint8_t colour[3], uint32_t light) { return pixel_lit(PIXEL_RGB888, colour, light); }

void surface_make(surface_t *surface, const surface_face_t *face, pixel_kind_t kind) {
    static const uint8_t white[3] = {255, 255, 255};
    const bool textured =
        TUILE_HAS(TEXTURES) && face->material.texture != TUILE_NO_TEXTURE && !(face->texturing & TUILE_TEXTURE_OFF);
    const uint8_t *material = textured && face->material.flags & TUILE_MATERIAL_REPLACED ? white : face->material.colour;
    const bool coloured = TUILE_HAS(LIGHTS) && light_is_coloured(face), fogged = TUILE_HAS(FOG) && face->fog != NULL;
    const int32_t alike = coloured ? 255 : light_alike(face);
    uint8_t colour[3] = {material[0], material[1], material[2]};
    unsigned varies = 0;
    surface_stage_fn *stage = surface->stage;
    surface->kind = kind;
    surface->blend = face->material.blend;
    surface->fill = surface_fill_stages;
    if (coloured) {
        uint8_t factor[3];
        varies = light_make(surface, face, factor);
        for (unsigned c = 0; c < 3; c++) {
            colour[c] = (uint8_t)pixel_div255((unsigned)colour[c] * factor[c] + 127u);
        }
    }
    if (!textured && alike >= 0 && varies == 0 && !fogged) {
        surface->sample = pixel_lit(kind, colour, (uint32_t)alike);
        surface->argb = (uint32_t)face->material.alpha << 24 | rgb_lit(colour, (uint32_t)alike);
        *stage = NULL;
        surface->fill = surface_fill_same;
        return;
    }
    texture_corner_t corner[3];
    for (unsigned i = 0; textured && i < 3; i++) {
        corner[i] = texture_corner(&face->corner[i], face->material.uv_bits);
    }
    if (textured && !coloured && !fogged && textured_open(surface, face, alike)) { return; }
    surface->argb = (uint32_t)face->material.alpha << 24 | rgb_lit(colour, alike >= 0 ? (uint32_t)alike : 255u);
    *stage++ = textured ? stage_texture : stage_same;
    if (textured) {
        texture_open(surface, face, corner);
        if (surface->argb != 0xffffffffu) { *stage++ = stage_multiply; }
    }
    if (alike < 0) {
        white_light(surface, &face->corner[0].at, &face->corner[1].at, &face->corner[2].at);
        *stage++ = stage_white_light;
    }
    if (TUILE_HAS(LIGHTS) && varies & LIGHT_CHANNELS) { *stage++ = light_stage_channels; }
    if (TUILE_HAS(LIGHTS) && varies & LIGHT_HIGHLIGHT) { *stage++ = light_stage_highlight; }
    if (TUILE_HAS(LIGHTS) && varies & LIGHT_ALPHA) { *stage++ = light_stage_alpha; }
    if (fogged) {
        fog_open(surface, face);
        *stage++ = fog_stage;
    }
    *stage = NULL;
}
