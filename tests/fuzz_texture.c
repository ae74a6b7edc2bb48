/* Nothing outside a texture is read, whatever the coordinates are. Textures of all formats, odd sizes, levels and flags lie in
 * memory of exactly their size; planes through corners anywhere in the window, with any coordinates and depths, are walked far
 * beyond their faces; texels are fetched at any coordinates; and models are drawn whose texels lie at the very end of their block,
 * behind bytes that must not be read. A sanitizer sees what leads out; without one, wrong colours and colours that are no texel's
 * are seen. */
#include "../raster/geometry/model.h"
#include "../raster/surface/texture.h"
#include "../sim/mesh/mesh.h"
#include "reference/fuzz_driver.h"
#include "support/check.h"
#include "support/models.h"
#include "support/random.h"

#if CHECK_SANITIZED
#include <sanitizer/asan_interface.h>
#define FORBID(at, bytes) __asan_poison_memory_region(at, bytes)
#define ALLOW(at, bytes) __asan_unpoison_memory_region(at, bytes)
#else
#define FORBID(at, bytes) ((void)(at), (void)(bytes))
#define ALLOW(at, bytes) ((void)(at), (void)(bytes))
#endif

enum { GAP_BYTES = 4096, DRAWN_WIDTH = 48, DRAWN_HEIGHT = 40 };

static unsigned long frames, frames_seen; /* drawn; with anything in them but background */

static void require(bool condition, const char *what) {
    if (!condition) {
        (void)fprintf(stderr, "fuzz_texture: %s\n", what);
        abort();
    }
}

/* ---- choices out of an input: zeros when it is used up ---- */

typedef struct input {
    const uint8_t *bytes;
    size_t size, at;
} input_t;

static uint32_t take(input_t *in, unsigned count) {
    uint32_t value = 0;
    for (unsigned i = 0; i < count; i++) {
        value = value << 8 | (in->at < in->size ? in->bytes[in->at++] : 0);
    }
    return value;
}

static uint32_t take_below(input_t *in, uint32_t limit) { return take(in, 3) % limit; }

/* -2^bits ... 2^bits, the ends more often than anything else. */
static int32_t take_signed(input_t *in, unsigned bits) {
    const uint32_t kind = take(in, 1), value = take(in, 4);
    const int32_t most = bits == 31 ? INT32_MAX : (1 << bits) - 1;
    switch (kind % 8) {
    case 0: return most;
    case 1: return -most - 1;
    case 2: return (int32_t)(value % 5) - 2;
    default: return (int32_t)(value >> (kind / 8)) >> (31 - bits);
    }
}

/* ---- a texture in memory of its size ---- */

typedef struct fuzz_texture {
    tuile_texture_t texture;
    uint8_t *texels, *palette;
    size_t size_bytes, palette_bytes;
} fuzz_texture_t;

static uint16_t take_size(input_t *in) {
    static const uint16_t sizes[] = {1, 1, 2, 3, 4, 5, 7, 8, 13, 16, 31, 32, 33, 64, 100, 255, 256, 1023, 2047, 2048};
    return sizes[take_below(in, take(in, 1) % 8 ? 15 : CHECK_COUNT(sizes))];
}

static uint8_t *some_bytes(input_t *in, size_t count) {
    uint8_t *bytes = malloc(count ? count : 1);
    uint32_t state = take(in, 2) * 2 + 1;
    require(bytes != NULL, "out of memory");
    for (size_t i = 0; i < count; i++) {
        state = state * 1664525u + 1013904223u;
        bytes[i] = (uint8_t)(state >> 24);
    }
    return bytes;
}

static void texture_take(input_t *in, fuzz_texture_t *to) {
    tuile_texture_t *t = &to->texture;
    unsigned most = 1;
    *t = (tuile_texture_t){
        .format = (uint8_t)take_below(in, TUILE_TEXEL_ARGB4444 + 1), .width = take_size(in), .height = take_size(in)};
    if ((size_t)t->width * t->height > 1 << 18) { t->height = 3; }
    for (unsigned size = t->width > t->height ? t->width : t->height; size > 1; size /= 2) {
        most++;
    }
    t->levels = (uint8_t)(1 + take_below(in, most));
    t->flags = (uint8_t)(take(in, 1) & (TUILE_TEXTURE_CLAMP_S | TUILE_TEXTURE_CLAMP_T | TUILE_TEXTURE_KEY));
    to->palette_bytes = 2 * (size_t)model_palette_entries(t->format);
    if (to->palette_bytes) { t->flags |= (uint8_t)(take(in, 1) & TUILE_TEXTURE_PALETTE_ALPHA); }
    if (t->flags & TUILE_TEXTURE_KEY) { t->key = (uint16_t)take_below(in, 16); }
    to->size_bytes = model_texture_bytes(t->format, t->width, t->height, t->levels);
    t->texels = to->texels = some_bytes(in, to->size_bytes);
    to->palette = to->palette_bytes ? some_bytes(in, to->palette_bytes) : NULL;
    t->palette = to->palette;
}

static void texture_free(fuzz_texture_t *texture) {
    free(texture->texels);
    free(texture->palette);
}

/* ---- coordinates ---- */

/* By the definition: floor, then the remainder or the nearest texel there is. */
static uint32_t brought_in(int32_t at, uint32_t size, bool clamp) {
    const int64_t whole = at >> 16;
    if (clamp) { return whole < 0 ? 0 : whole >= (int64_t)size ? size - 1 : (uint32_t)whole; }
    const int64_t rest = whole % (int64_t)size;
    return (uint32_t)(rest < 0 ? rest + (int64_t)size : rest);
}

/* Of every level; of level 0 the nearest ones are those that the definition names. */
static void fetch(input_t *in, const tuile_texture_t *texture) {
    int32_t s[32], t[32];
    uint32_t argb[32];
    for (unsigned i = 0; i < 32; i++) {
        s[i] = take_signed(in, 31);
        t[i] = take_signed(in, 31);
        (void)texture_texel(texture, s[i], t[i]);
    }
    for (unsigned number = 0; number < texture->levels; number++) {
        const texture_level_t level = texture_level(texture, number);
        for (int bilinear = 0; bilinear < 2; bilinear++) {
            const texture_plane_t plane = {.texture = *texture, .level = level, .bilinear = bilinear};
            texture_fetch(&plane, &level, number, s, t, 1 + (int32_t)take_below(in, 32), argb);
            if (bilinear || number) { continue; }
            const uint32_t x = brought_in(s[0], texture->width, texture->flags & TUILE_TEXTURE_CLAMP_S),
                           y = brought_in(t[0], texture->height, texture->flags & TUILE_TEXTURE_CLAMP_T);
            require(argb[0] == texture_level_texel(texture, &level, x, y), "another texel than the definition names");
        }
    }
}

/* Corners as the renderer may have them, and pixels anywhere in the largest window, inside of the face or not. */
static void walk(input_t *in, const tuile_texture_t *texture) {
    const texture_wish_t wish = {
        .bilinear = take(in, 1) % 2, .affine = take(in, 1) % 4 == 0, .mips = take(in, 1) % 2, .perspective = take(in, 1) % 2};
    texture_corner_t corner[3];
    texture_plane_t plane;
    for (unsigned i = 0; i < 3; i++) {
        const int32_t depth = take_signed(in, 24);
        corner[i] = (texture_corner_t){.x = take_signed(in, 13),
                                       .y = take_signed(in, 13),
                                       .depth = (uint32_t)(depth < 0 ? -depth : depth) % (65529u * 256u - 511u) + 512u,
                                       .s = take_signed(in, 23),
                                       .t = take_signed(in, 23)};
    }
    const int64_t area = (int64_t)(corner[2].x - corner[0].x) * (corner[1].y - corner[0].y) -
                         (int64_t)(corner[1].x - corner[0].x) * (corner[2].y - corner[0].y);
    if (area == 0) { return; }
    texture_plane_make(&plane, texture, corner, wish);
    for (unsigned i = 0; i < 24; i++) {
        uint32_t argb[32];
        const int32_t x = (int32_t)take_below(in, TUILE_SAMPLES_MAX), y = (int32_t)take_below(in, TUILE_SAMPLES_MAX);
        texture_run(&plane, x, y, 1 + (int32_t)take_below(in, 32), argb);
    }
}

/* ---- drawn ---- */

static void surface_take(input_t *in, mesh_t *mesh) {
    mesh->surfaces = calloc(1, sizeof *mesh->surfaces);
    mesh->texcoords = calloc(mesh->corner_count, sizeof *mesh->texcoords);
    require(mesh->surfaces && mesh->texcoords, "out of memory");
    mesh->surfaces[0] = (tuile_material_t){.alpha = 255,
                                           .uv_bits = (uint8_t)take_below(in, MODEL_UV_BITS_MAX + 1),
                                           .flags = (uint8_t)(take(in, 1) & (TUILE_MATERIAL_BILINEAR | TUILE_MATERIAL_UNLIT))};
    for (size_t c = 0; c < mesh->corner_count; c++) {
        for (int k = 0; k < 2; k++) {
            mesh->texcoords[c][k] = take_signed(in, 15) / (double)(1 << mesh->surfaces[0].uv_bits);
        }
    }
}

/* A soup of triangles about the origin. */
static void soup(input_t *in, mesh_t *mesh, const fuzz_texture_t *texture) {
    model_start(mesh);
    for (unsigned f = 0; f < 6; f++) {
        uint32_t corner[3];
        for (unsigned i = 0; i < 3; i++) {
            corner[i] = model_position(mesh, (int32_t)take_below(in, 2001) - 1000, (int32_t)take_below(in, 2001) - 1000,
                                       (int32_t)take_below(in, 2001) - 1000);
        }
        model_face(mesh, corner, 3, model_material(mesh, 255, 255, 255));
    }
    surface_take(in, mesh);
    mesh->textures = calloc(1, sizeof *mesh->textures);
    require(mesh->textures != NULL, "out of memory");
    mesh->texture_count = 1;
    mesh->textures[0] = (mesh_texture_t){.name = strdup("soup"),
                                         .texels = malloc(texture->size_bytes),
                                         .palette = texture->palette ? malloc(texture->palette_bytes) : NULL,
                                         .size_bytes = texture->size_bytes,
                                         .palette_bytes = texture->palette_bytes,
                                         .width = texture->texture.width,
                                         .height = texture->texture.height,
                                         .key = texture->texture.key,
                                         .format = texture->texture.format,
                                         .levels = texture->texture.levels,
                                         .flags = texture->texture.flags};
    memcpy(mesh->textures[0].texels, texture->texels, texture->size_bytes);
    if (texture->palette) { memcpy(mesh->textures[0].palette, texture->palette, texture->palette_bytes); }
}

static void put32(uint8_t *at, size_t value) {
    for (unsigned i = 0; i < 4; i++) {
        at[i] = (uint8_t)(value >> (8 * i));
    }
}

typedef struct apart {
    uint8_t *bytes, *gap[2];
    size_t size;
} apart_t;

/* The model once more: | model | gap | palette | gap | texels |, and not a byte behind them. */
static apart_t set_apart(const uint8_t *bytes, size_t size, const fuzz_texture_t *texture) {
    const size_t palette = (size + 3) / 4 * 4 + GAP_BYTES, texels = palette + texture->palette_bytes + GAP_BYTES;
    apart_t a = {.size = texels + texture->size_bytes};
    a.bytes = calloc(1, a.size);
    require(a.bytes != NULL, "out of memory");
    memcpy(a.bytes, bytes, size);
    if (texture->palette) { memcpy(a.bytes + palette, texture->palette, texture->palette_bytes); }
    memcpy(a.bytes + texels, texture->texels, texture->size_bytes);
    uint8_t *entry = a.bytes + model_u32(a.bytes + MODEL_AT_TEXTURES);
    put32(entry + TEXTURE_AT_TEXELS, texels);
    if (texture->palette) { put32(entry + TEXTURE_AT_PALETTE, palette); }
    put32(a.bytes + MODEL_AT_SIZE, a.size);
    put32(a.bytes + MODEL_AT_CRC32, model_crc32(0, a.bytes + MODEL_AT_VERSION, a.size - MODEL_AT_VERSION));
    a.gap[0] = a.bytes + palette - GAP_BYTES;
    a.gap[1] = a.bytes + texels - GAP_BYTES;
    return a;
}

static void draw_tiles(const tuile_scene_t *scene, const tuile_config_t *config) {
    enum { ROOM = 1 << 18 };
    static uint64_t block[ROOM / 8];
    tuile_t *renderer;
    tuile_tile_t tile;
    int result = tuile_init(&renderer, config, block, sizeof block, NULL);
    if (result == TUILE_OK) { result = tuile_begin(renderer, scene); }
    bool seen = false;
    while (result >= 0 && (result = tuile_next(renderer, &tile)) == 1) {
        for (uint32_t i = 0; i < tile.size_bytes; i++) {
            seen |= tile.bytes[i] != 0;
        }
    }
    frames++;
    frames_seen += seen;
    require(result == 0 || result == TUILE_ERROR_MEMORY || result == TUILE_ERROR_RANGE, "an error that has no cause");
}

static void draw(input_t *in, const tuile_model_t *model) {
    tuile_instance_t instance = {.model = model, .pose = {.scale = {1, -8}}, .two_sided = true};
    const tuile_light_t light = {.direction = {0, -11585, -11585}, .intensity = 200};
    tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .lights = &light, .light_count = 1, .ambient = 40};
    tuile_rotation(instance.pose.rotation, 1, (bam16_t)take(in, 2));
    const q16_16_t up[3] = {0, TUILE_Q16(1), 0}, at[3] = {0, 0, 0};
    const q16_16_t eye[3] = {take_signed(in, 19), take_signed(in, 19), TUILE_Q16(1) + (q16_16_t)take_below(in, 8 << 16)};
    scene.camera = (tuile_camera_t){.projection = take(in, 1) % 4 ? TUILE_PERSPECTIVE : TUILE_ORTHOGRAPHIC,
                                    .focal_x = TUILE_Q16(30),
                                    .focal_y = TUILE_Q16(30),
                                    .centre_x = TUILE_Q16(24),
                                    .centre_y = TUILE_Q16(20),
                                    .near = 600,
                                    .far = TUILE_Q16(40)};
    if (tuile_camera_look_at(&scene.camera, eye, at, up) != TUILE_OK) { return; }
    const tuile_config_t config = {.width = DRAWN_WIDTH,
                                   .height = DRAWN_HEIGHT,
                                   .tile_height = 8,
                                   .method = (uint8_t)take_below(in, TUILE_TREE),
                                   .shade = (uint8_t)take_below(in, 2),
                                   .cluster_vertices = model->cluster_vertices_max,
                                   .effects = take(in, 1) % 2 ? TUILE_SURFACES : TUILE_SURFACES | TUILE_LAYERS,
                                   .texturing = take(in, 1) % 4 ? 0 : (uint8_t)(take(in, 1) % 8)};
    draw_tiles(&scene, &config);
}

static void drawn(input_t *in, const fuzz_texture_t *texture) {
    mesh_t mesh;
    uint8_t *bytes = NULL;
    size_t size = 0;
    sim_error_t error = {""};
    tuile_model_t model;
    soup(in, &mesh, texture);
    if (mesh_compile(&mesh, NULL, &bytes, &size, NULL, &error) == 0) {
        apart_t apart = set_apart(bytes, size, texture);
        require(tuile_model_open(&model, apart.bytes, apart.size) == TUILE_OK, "a model that does not open");
        FORBID(apart.gap[0], GAP_BYTES);
        FORBID(apart.gap[1], GAP_BYTES);
        for (unsigned i = 0; i < 4; i++) {
            draw(in, &model);
        }
        ALLOW(apart.gap[0], GAP_BYTES);
        ALLOW(apart.gap[1], GAP_BYTES);
        free(apart.bytes);
    }
    free(bytes);
    mesh_free(&mesh);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    input_t in = {bytes, size, 0};
    fuzz_texture_t texture;
    const bool whole = take(&in, 1) % 16 == 0;
    texture_take(&in, &texture);
    fetch(&in, &texture.texture);
    walk(&in, &texture.texture);
    if (whole) { drawn(&in, &texture); }
    texture_free(&texture);
    return 0;
}

#ifdef FUZZ_DRIVER
int main(int argc, char **argv) {
    enum { SIZE = 1400, ROUNDS = 20000 };
    random_source_t random = random_seed(29);
    if (argc > 1) { return fuzz_drive(argc, argv, NULL); } /* files */
    for (unsigned n = 0; n < ROUNDS; n++) {
        uint8_t *bytes = malloc(SIZE);
        require(bytes != NULL, "out of memory");
        for (size_t i = 0; i < SIZE; i++) {
            bytes[i] = (uint8_t)(random_bits(&random) >> 40);
        }
        (void)LLVMFuzzerTestOneInput(bytes, SIZE);
        free(bytes);
    }
    (void)printf("%s: %d inputs, %lu frames, %lu of them with faces\n", argv[0], ROUNDS, frames, frames_seen);
    require(frames_seen > 1000, "hardly a face was drawn");
    return 0;
}
#endif
