/* An image becomes smaller by halves: each texel is the mean of what it covers of the level above, by area (2x2 texels, or, where a
 * side is odd, parts of 3). Where sides are to be powers of two, it is made so first, in the same way. Colours are weighted by
 * alpha, so that what is not there does not tint its neighbours, and values are averaged as they stand in the file. Levels are made
 * of one another without rounding.
 */
#include "texels.h"

#include "stages.h"

#include <math.h>
#include <string.h>

typedef struct plane { /* red, green, blue, 0 ... 255, times alpha, and alpha, 0 ... 1: exact where nothing is translucent */
    uint32_t width, height;
    float (*at)[4];
} plane_t;

#define LEVELS_MAX 12u /* of TUILE_TEXTURE_MAX */

typedef struct level {
    uint32_t width, height;
    uint8_t (*pixels)[4];
} level_t;

typedef struct making {
    const mesh_options_t *options;
    level_t levels[LEVELS_MAX];
    unsigned level_count;
    bool alpha, grey; /* of the image, but for its key */
    bool keyed;       /* texels with an alpha below 1/2 are the key */
    uint8_t palette[256][4];
    size_t palette_count;
    uint32_t *index; /* of each texel of level 0, in the palette */
} making_t;

static void making_free(making_t *m) {
    for (unsigned i = 0; i < m->level_count; i++) {
        free(m->levels[i].pixels);
    }
    free(m->index);
}

/* ---- levels ------------------------------------------------------------------------------------------------------ */

static bool is_key(const mesh_options_t *options, const uint8_t pixel[4]) {
    return options->texture_keyed && !memcmp(pixel, options->texture_key, 3);
}

static bool plane_of(plane_t *plane, const image_t *image, making_t *m) {
    const size_t count = (size_t)image->width * image->height;
    *plane = (plane_t){image->width, image->height, malloc(count * sizeof *plane->at)};
    if (!plane->at) { return false; }
    m->grey = true;
    for (size_t i = 0; i < count; i++) {
        const uint8_t *pixel = image->pixels[i];
        const bool key = is_key(m->options, pixel);
        const float alpha = key ? 0 : (float)pixel[3] / 255;
        m->alpha = m->alpha || (!key && pixel[3] < 255);
        m->grey = m->grey && (key || (pixel[0] == pixel[1] && pixel[1] == pixel[2]));
        for (int k = 0; k < 3; k++) {
            plane->at[i][k] = (float)pixel[k] * alpha;
        }
        plane->at[i][3] = alpha;
    }
    return true;
}

/* Of `from` texels across, those that texel i of `to` covers: parts[j] of texel first + j, j < the result <= 3. */
static int covered(uint32_t from, uint32_t to, uint32_t i, uint32_t *first, float parts[3]) {
    const uint64_t low = (uint64_t)i * from, high = low + from; /* in 1 / to of a texel */
    int count = 0;
    *first = (uint32_t)(low / to);
    for (uint64_t at = *first; at * to < high; at++) {
        const uint64_t begin = at * to > low ? at * to : low, end = (at + 1) * to < high ? (at + 1) * to : high;
        parts[count++] = (float)(end - begin) / (float)from;
    }
    return count;
}

/* Each side at least a third of what it was. */
static bool resample(plane_t *plane, uint32_t width, uint32_t height) {
    plane_t made = {width, height, calloc((size_t)width * height, sizeof *made.at)};
    if (!made.at) { return false; }
    for (uint32_t y = 0; y < height; y++) {
        uint32_t top, left;
        float down[3], across[3];
        const int rows = covered(plane->height, height, y, &top, down);
        for (uint32_t x = 0; x < width; x++) {
            const int columns = covered(plane->width, width, x, &left, across);
            float *to = made.at[(size_t)y * width + x];
            for (int i = 0; i < rows * columns; i++) {
                const int row = i / columns, column = i % columns;
                const float *from = plane->at[((size_t)top + (size_t)row) * plane->width + left + (size_t)column];
                for (int k = 0; k < 4; k++) {
                    to[k] += from[k] * down[row] * across[column];
                }
            }
        }
    }
    free(plane->at);
    *plane = made;
    return true;
}

static bool halve(plane_t *plane) {
    return resample(plane, plane->width > 1 ? plane->width / 2 : 1, plane->height > 1 ? plane->height / 2 : 1);
}

/* The nearest power of two, of two as near the lower; `most` at most, and 2 at least where that allows it. */
static uint32_t power_of_two(uint32_t side, uint32_t most) {
    uint32_t power = most < 2 ? 1 : 2;
    while (2 * power <= most && 2 * side > 3 * power) {
        power *= 2;
    }
    return power;
}

/* Halves up. */
static uint8_t to_byte(float value) { return (uint8_t)floorf(fmaxf(0, fminf(255, value)) + 0.5F); }

static bool add_level(making_t *m, const plane_t *plane) {
    const size_t count = (size_t)plane->width * plane->height;
    level_t *level = &m->levels[m->level_count];
    *level = (level_t){plane->width, plane->height, calloc(count, sizeof *level->pixels)};
    if (!level->pixels) { return false; }
    m->level_count++;
    for (size_t i = 0; i < count; i++) {
        const float alpha = plane->at[i][3];
        for (int k = 0; k < 3; k++) {
            level->pixels[i][k] = alpha > 0 ? to_byte(plane->at[i][k] / alpha) : 0;
        }
        level->pixels[i][3] = to_byte(alpha * 255);
    }
    return true;
}

/* 0, -1 without memory, or 1: too large. */
static int make_levels(making_t *m, const image_t *image) {
    plane_t plane;
    bool good = plane_of(&plane, image, m);
    const uint32_t size = m->options->texture_size ? m->options->texture_size : UINT32_MAX;
    while (good && (plane.width > size || plane.height > size)) {
        good = halve(&plane);
    }
    const bool large = good && (plane.width > TUILE_TEXTURE_MAX || plane.height > TUILE_TEXTURE_MAX);
    if (good && !large && m->options->texture_fast) {
        const uint32_t most = size < TUILE_TEXTURE_MAX ? size : TUILE_TEXTURE_MAX;
        good = resample(&plane, power_of_two(plane.width, most), power_of_two(plane.height, most));
    }
    good = good && (large || add_level(m, &plane));
    while (good && !large && !m->options->no_mips && (plane.width > 1 || plane.height > 1)) {
        good = halve(&plane) && add_level(m, &plane);
    }
    free(plane.at);
    return !good ? -1 : large;
}

/* ---- texels ------------------------------------------------------------------------------------------------------ */

static uint32_t steps(uint8_t value, uint32_t most) { return (value * most + 127) / 255; }

static uint32_t rgb565(const uint8_t pixel[4]) {
    return steps(pixel[0], 31) << 11 | steps(pixel[1], 63) << 5 | steps(pixel[2], 31);
}

static uint32_t argb4444(const uint8_t pixel[4]) {
    return steps(pixel[3], 15) << 12 | steps(pixel[0], 15) << 8 | steps(pixel[1], 15) << 4 | steps(pixel[2], 15);
}

/* Rec. 601, as the renderer's. */
static uint32_t grey8(const uint8_t pixel[4]) { return (pixel[0] * 77u + pixel[1] * 150u + pixel[2] * 29u + 128u) >> 8; }

/* The colour that is left of a pixel in a palette's entry. */
static void rounded(const making_t *m, const uint8_t pixel[4], uint8_t to[4]) {
    const uint32_t most[4] = {m->alpha ? 15 : 31, m->alpha ? 15 : 63, m->alpha ? 15 : 31, 15};
    for (int k = 0; k < 4; k++) {
        to[k] = (uint8_t)((steps(pixel[k], most[k]) * 255 + most[k] / 2) / most[k]);
    }
    if (!m->alpha) { to[3] = 255; }
}

/* A palette of at most `most` colours for level 0, whose last entry is kept for the key. count: how many it has; index as well. */
static bool make_palette(making_t *m, size_t most) {
    const level_t *level = &m->levels[0];
    const size_t count = (size_t)level->width * level->height;
    uint8_t(*colours)[4] = mesh_array(count, sizeof *colours);
    uint32_t *index = mesh_array(count, sizeof *index);
    size_t used = 0;
    m->index = mesh_array(count, sizeof *m->index);
    bool good = colours && index && m->index;
    for (size_t i = 0; good && i < count; i++) {
        if (!m->keyed || level->pixels[i][3] >= 128) { rounded(m, level->pixels[i], colours[used++]); }
    }
    m->palette_count = 0;
    if (good && used) {
        good = !mesh_palette_of((const uint8_t(*)[4])colours, used, most - m->keyed, m->palette, &m->palette_count, index);
    }
    used = 0;
    for (size_t i = 0; good && i < count; i++) {
        m->index[i] = !m->keyed || level->pixels[i][3] >= 128 ? index[used++] : (uint32_t)m->palette_count;
    }
    free(colours);
    free(index);
    return good;
}

static uint32_t nearest_entry(const making_t *m, const uint8_t pixel[4]) {
    uint32_t best = 0;
    int least = INT32_MAX;
    for (size_t i = 0; i < m->palette_count; i++) {
        int distance = 0;
        for (int k = 0; k < (m->alpha ? 4 : 3); k++) {
            distance += (pixel[k] - m->palette[i][k]) * (pixel[k] - m->palette[i][k]);
        }
        if (distance < least) {
            least = distance;
            best = (uint32_t)i;
        }
    }
    return best;
}

/* How many colours of palette entries the image has: at most 257 are counted. */
static size_t count_colours(const making_t *m) {
    static const size_t enough = 257;
    uint8_t seen[257][4];
    const level_t *level = &m->levels[0];
    size_t count = m->keyed ? 1 : 0;
    for (size_t i = 0; i < (size_t)level->width * level->height && count < enough; i++) {
        uint8_t colour[4];
        size_t at = m->keyed ? 1 : 0;
        if (m->keyed && level->pixels[i][3] < 128) { continue; }
        rounded(m, level->pixels[i], colour);
        while (at < count && memcmp(seen[at], colour, 4) != 0) {
            at++;
        }
        if (at == count) { memcpy(seen[count++], colour, 4); }
    }
    return count;
}

static uint8_t choose_format(const making_t *m) {
    if (m->alpha) { return TUILE_TEXEL_ARGB4444; }
    const size_t colours = count_colours(m);
    if (m->options->texture_fast) { return colours <= 256 ? TUILE_TEXEL_PALETTE8 : TUILE_TEXEL_RGB565; }
    return colours <= 16    ? TUILE_TEXEL_PALETTE4
           : m->grey        ? TUILE_TEXEL_GREY8
           : colours <= 256 ? TUILE_TEXEL_PALETTE8
                            : TUILE_TEXEL_RGB565;
}

/* A pixel's texel. Where there is a key, others that would look like it move by one step. */
static uint32_t texel_of(const making_t *m, const mesh_texture_t *texture, unsigned level, size_t i) {
    const uint8_t *pixel = m->levels[level].pixels[i];
    const bool keyed = texture->flags & TUILE_TEXTURE_KEY;
    uint32_t texel;
    if (keyed && pixel[3] < 128) { return texture->key; }
    switch (texture->format) {
    case TUILE_TEXEL_PALETTE8:
    case TUILE_TEXEL_PALETTE4: return level || !m->index ? nearest_entry(m, pixel) : m->index[i];
    case TUILE_TEXEL_GREY8: texel = grey8(pixel); break;
    case TUILE_TEXEL_ARGB4444: return argb4444(pixel);
    default: texel = rgb565(pixel); break;
    }
    return keyed && texel == texture->key ? texel ^ (texture->format == TUILE_TEXEL_GREY8 ? 1u : 0x20u) : texel;
}

static void write_level(const making_t *m, const mesh_texture_t *texture, unsigned number, uint8_t *to) {
    const level_t *level = &m->levels[number];
    const size_t row_bytes = model_texture_bytes(texture->format, level->width, 1, 1);
    for (uint32_t y = 0; y < level->height; y++, to += row_bytes) {
        for (uint32_t x = 0; x < level->width; x++) {
            const uint32_t texel = texel_of(m, texture, number, (size_t)y * level->width + x);
            if (texture->format == TUILE_TEXEL_PALETTE4) {
                to[x / 2] = (uint8_t)(to[x / 2] | texel << 4 * (x % 2));
            } else if (row_bytes == level->width) {
                to[x] = (uint8_t)texel;
            } else {
                to[2 * x] = (uint8_t)texel;
                to[2 * x + 1] = (uint8_t)(texel >> 8);
            }
        }
    }
}

static void choose_key(const making_t *m, mesh_texture_t *texture) {
    const uint8_t *colour = m->options->texture_key, pixel[4] = {colour[0], colour[1], colour[2], 255};
    if (!m->keyed || texture->format == TUILE_TEXEL_ARGB4444) { return; } /* which has alpha for it */
    texture->flags |= TUILE_TEXTURE_KEY;
    texture->key = (uint16_t)(texture->format == TUILE_TEXEL_RGB565  ? rgb565(pixel)
                              : texture->format == TUILE_TEXEL_GREY8 ? grey8(pixel)
                                                                     : m->palette_count);
}

static bool encode(const making_t *m, mesh_texture_t *texture) {
    const level_t *level = &m->levels[0];
    const unsigned entries = model_palette_entries(texture->format);
    texture->width = (uint16_t)level->width;
    texture->height = (uint16_t)level->height;
    texture->levels = (uint8_t)m->level_count;
    texture->size_bytes = model_texture_bytes(texture->format, level->width, level->height, m->level_count);
    texture->texels = mesh_array(texture->size_bytes, 1);
    texture->palette_bytes = 2 * entries;
    texture->palette = entries ? mesh_array(entries, 2) : NULL;
    if (!texture->texels || (entries && !texture->palette)) { return false; }
    if (entries && m->alpha) { texture->flags |= TUILE_TEXTURE_PALETTE_ALPHA; }
    choose_key(m, texture);
    for (size_t i = 0; entries && i < m->palette_count; i++) {
        const uint32_t entry = m->alpha ? argb4444(m->palette[i]) : rgb565(m->palette[i]);
        texture->palette[2 * i] = (uint8_t)entry;
        texture->palette[2 * i + 1] = (uint8_t)(entry >> 8);
    }
    for (unsigned number = 0; number < m->level_count; number++) {
        const size_t before = model_texture_bytes(texture->format, level->width, level->height, number);
        write_level(m, texture, number, texture->texels + before + before % 2);
    }
    return true;
}

int texels_make(mesh_texture_t *texture, const image_t *image, unsigned flags, const mesh_options_t *options, const char *name,
                sim_error_t *error) {
    making_t m = {.options = options, .keyed = options->texture_keyed};
    *texture = (mesh_texture_t){.flags = (uint8_t)flags};
    const int large = make_levels(&m, image);
    int status = 0;
    if (large > 0) {
        status = sim_fail(error, "%s: is %ux%u pixels, and a texture has %u at most; make it smaller (--texture-size %u)", name,
                          image->width, image->height, TUILE_TEXTURE_MAX, TUILE_TEXTURE_MAX);
    }
    if (!large) {
        texture->format = options->texture_format == MESH_TEXELS_AUTO ? choose_format(&m) : (uint8_t)(options->texture_format - 1);
        if (m.alpha && (texture->format == TUILE_TEXEL_RGB565 || texture->format == TUILE_TEXEL_GREY8)) {
            status = sim_fail(error, "%s: has alpha, and %s has none; take argb4444, palette8 or palette4", name,
                              texture->format == TUILE_TEXEL_GREY8 ? "grey8" : "rgb565");
        }
    }
    const unsigned entries = model_palette_entries(texture->format);
    if (!status && (large < 0 || (entries && !make_palette(&m, entries)) || !encode(&m, texture))) {
        status = sim_fail(error, "%s: out of memory for a texture of %ux%u", name, image->width, image->height);
    }
    making_free(&m);
    if (status) {
        free(texture->texels);
        free(texture->palette);
        *texture = (mesh_texture_t){0};
    }
    return status;
}
