/* Sprites: rectangles and ellipses across the view, all of one depth. A sample is drawn iff its centre is inside, or on the left or
 * the top side. */
#include "layer.h"

#include "../surface/texture.h"

typedef struct sprite {
    const tuile_sprite_t *given;
    int64_t left, top, width, height; /* 1/16 sample */
    uint16_t depth;
    uint32_t fine_depth; /* 1/256 step */
    uint32_t rank, argb;
    int64_t s_step, t_step; /* texels a sixteenth, Q.32 */
} sprite_t;

static uint32_t multiply(uint32_t a, uint32_t b) {
    uint32_t product = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) {
        product |= pixel_div255((a >> shift & 255u) * (b >> shift & 255u) + 127u) << shift;
    }
    return product;
}

/* Within the ellipse that touches all four sides: (x / a)^2 + (y / b)^2 <= 1, in 1/16 sample from its centre, doubled. */
static bool in_ellipse(const sprite_t *sprite, int32_t x, int32_t y) {
    int64_t dx = 2 * (16 * (int64_t)x + 8 - sprite->left) - sprite->width, a = sprite->width;
    int64_t dy = 2 * (16 * (int64_t)y + 8 - sprite->top) - sprite->height, b = sprite->height;
    while (a >= INT32_C(1) << 15) { /* |dx| <= a, |dy| <= b: products of four stay below 2^60 */
        dx /= 2;
        a /= 2;
    }
    while (b >= INT32_C(1) << 15) {
        dy /= 2;
        b /= 2;
    }
    return dx * dx * b * b + dy * dy * a * a <= a * a * b * b;
}

static uint32_t sprite_argb(const sprite_t *sprite, int32_t x, int32_t y) {
    if (sprite->given->round && !in_ellipse(sprite, x, y)) { return 0; }
    if (sprite->given->texture == NULL) { return sprite->argb; }
    const int32_t s = (int32_t)(((16 * (int64_t)x + 8 - sprite->left) * sprite->s_step) >> 32);
    const int32_t v = (int32_t)(((16 * (int64_t)y + 8 - sprite->top) * sprite->t_step) >> 32);
    return multiply(texture_texel(sprite->given->texture, s, v), sprite->argb);
}

static bool sprite_place(const tuile_t *t, const tuile_sprite_t *given, sprite_t *sprite) {
    const layer_view_t view = layer_to_view(&t->camera, given->at);
    if (!layer_inside(&t->camera, &view)) { return false; }
    const layer_place_t at = layer_project(&t->camera, &view);
    if (given->pixels) {
        sprite->width = ((int64_t)given->width * (1 << t->samples) + (1 << 11)) >> 12;
        sprite->height = ((int64_t)given->height * (1 << t->samples) + (1 << 11)) >> 12;
    } else {
        sprite->width = layer_project_length(&t->camera, t->camera.focal_x, given->width, view.w);
        sprite->height = layer_project_length(&t->camera, t->camera.focal_y, given->height, view.w);
    }
    if (sprite->width <= 0 || sprite->height <= 0) { return false; }
    sprite->given = given;
    sprite->left = at.x - sprite->width / 2;
    sprite->top = at.y - sprite->height / 2;
    sprite->depth = (uint16_t)((at.depth + 128) >> 8);
    sprite->fine_depth = at.depth;
    sprite->argb = (uint32_t)given->alpha << 24 | PIXEL_RGB(given->colour[0], given->colour[1], given->colour[2]);
    if (given->texture != NULL) {
        sprite->s_step = ((int64_t)given->texture->width << 32) / sprite->width;
        sprite->t_step = ((int64_t)given->texture->height << 32) / sprite->height;
    }
    return true;
}

/* The first sample whose centre is at or beyond a coordinate in 1/16, held to low ... high. */
static int32_t first_sample(int64_t coordinate, int32_t low, int32_t high) {
    const int64_t first = (coordinate + 7) >> 4;
    return first < low ? low : first > high ? high : (int32_t)first;
}

static void sprite_offer(const tuile_t *t, const sprite_t *sprite, layer_band_t *band) {
    const int32_t left = first_sample(sprite->left, band->left, band->right);
    const int32_t right = first_sample(sprite->left + sprite->width, band->left, band->right);
    const int32_t top = first_sample(sprite->top, band->top, band->bottom);
    const int32_t bottom = first_sample(sprite->top + sprite->height, band->top, band->bottom);
    for (int32_t y = top; y < bottom; y++) {
        for (int32_t x = left; x < right; x++) {
            if (!layer_wants(band, x, y, sprite->depth, sprite->rank)) { continue; }
            const uint32_t argb = layer_fogged(t, sprite->fine_depth, sprite_argb(sprite, x, y), sprite->given->blend);
            layer_put(band, x, y, sprite->depth, sprite->rank, argb);
        }
    }
}

void layer_sprites(tuile_t *t, layer_band_t *band) {
    for (unsigned i = 0; i < t->scene->sprite_count; i++) {
        sprite_t sprite = {0};
        if (!sprite_place(t, &t->scene->sprites[i], &sprite)) { continue; }
        sprite.rank = layer_rank(LAYER_SPRITES, i, sprite.given->blend);
        sprite_offer(t, &sprite, band);
    }
}
