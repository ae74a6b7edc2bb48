/* Damaged compiled models: whatever tuile_model_open lets pass is drawn completely, by every hidden-surface method, in memory of
 * every size, and picked. Reads out of bounds and overflows are left to the sanitizers.
 *
 * Without arguments the program damages small models of its own, with display trees and without: bytes to other values, every
 * length, as it is and with the check sum put right again, and then many bytes at once. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../raster/geometry/model.h"
#include "../raster/tuile.h"
#include "../sim/mesh/mesh.h"
#include "../sim/mesh/stages.h"
#include "reference/fuzz_driver.h"
#include "support/check.h"
#include "support/models.h"
#include "support/random.h"

#define WIDTH 64u
#define HEIGHT 48u

enum { METHODS = TUILE_TREE + 1, GROWN_MOST = 64, BLOCK_MOST = 8 << 20 };
static const char *const names[METHODS] = {"zbuffer", "scanline", "warnock", "painter", "tree"};

static struct {
    unsigned long inputs, loaded;
    unsigned long drawn[METHODS], grown[METHODS], out_of_range[METHODS];
    unsigned long too_deep, deeper_than_told; /* trees: than the configuration allows, than their header says */
} counts;
static unsigned turn; /* of configurations and cameras, so that all meet all */

static void require(bool condition, const char *what) {
    if (!condition) {
        (void)fprintf(stderr, "fuzz_model: %s\n", what);
        abort();
    }
}

/* ---- what is drawn --------------------------------------------------------------------------------------------- */

/* Steps are of 2^-14 or so: the eye is 4 units away, or inside the model, where faces are cut. */
static tuile_camera_t camera(unsigned kind) {
    tuile_camera_t c = {.focal_x = 50 << 16,
                        .focal_y = 50 << 16,
                        .centre_x = (q16_16_t)WIDTH << 15,
                        .centre_y = (q16_16_t)HEIGHT << 15,
                        .near = 1 << 15,
                        .far = 100 << 16};
    const q16_16_t up[3] = {0, 1 << 16, 0}, at[3] = {0, 0, 0};
    const q16_16_t outside[3] = {1 << 16, 2 << 16, 4 << 16}, inside[3] = {6000, 9000, 30000};
    (void)tuile_camera_look_at(&c, kind % 2 ? inside : outside, at, up);
    if (kind % 2) { c.near = 900; }
    if (kind >= 2) {
        c.projection = TUILE_ORTHOGRAPHIC;
        c.near = -(1 << 15);
        c.focal_x = c.focal_y = 16 << 16;
    }
    return c;
}

typedef struct set {
    const tuile_model_t *model;
    tuile_instance_t instances[2];
    tuile_light_t light;
    tuile_scene_t scene; /* points into this struct */
    tuile_config_t config;
    size_t more; /* bytes beyond the least */
} set_t;

/* One instance, or two that are in each other's way. */
static void set_make(set_t *set, const tuile_model_t *model) {
    static const tuile_config_t configs[] = {
        {.tile_width = 16, .tile_height = 8},
        {.tile_width = 64, .tile_height = 4, .shade = TUILE_GOURAUD},
        {.tile_width = 64, .tile_height = 48, .format = TUILE_FACE_IDS},
        {.tile_width = 24, .tile_height = 16, .format = TUILE_FACE_IDS, .tie = TUILE_TIE_LAST},
        {.tile_width = 64, .tile_height = 16, .shade = TUILE_GOURAUD, .format = TUILE_RGB565_LE},
    };
    static const size_t more[] = {0, 64, 700, 40000}; /* from face by face to all at once */
    const tuile_instance_t instance = {.model = model, .pose = {.scale = TUILE_SCALE_ONE}, .two_sided = turn / 3 % 2 != 0};
    *set = (set_t){.model = model, .instances = {instance, instance}, .light = {{0, -11585, -11585}, 200}};
    tuile_rotation(set->instances[0].pose.rotation, 1, (bam16_t)(turn * 7919u));
    tuile_rotation(set->instances[1].pose.rotation, 0, (bam16_t)(turn * 4999u));
    set->instances[1].pose.translation[0] = 1 << 15;
    if (model->morph_positions) {
        set->instances[0].morph = (uint16_t)(turn * 4001u % (TUILE_MORPH_ONE + 1));
        set->instances[1].morph = TUILE_MORPH_ONE;
    }
    set->scene = (tuile_scene_t){.instances = set->instances,
                                 .instance_count = turn % 7 == 0 ? 2 : 1,
                                 .lights = &set->light,
                                 .light_count = 1,
                                 .ambient = 40,
                                 .camera = camera(turn / 2 % 4)};
    set->config = configs[turn % CHECK_COUNT(configs)];
    set->config.width = WIDTH;
    set->config.height = HEIGHT;
    set->config.buffers = (uint8_t)(1 + turn % 2);
    if (turn / 3 % 4 != 0 && set->config.format != TUILE_FACE_IDS) { set->config.effects = TUILE_SURFACES; }
    set->config.texturing = (uint8_t)(turn / 12 % 8);
    set->config.warnock = (uint8_t)(turn / 4 % 32);
    set->config.cluster_vertices = model->cluster_vertices_max;
    set->config.corners = model->corners_max;
    set->config.tree_depth = (uint16_t)(model->tree_depth < 1000 ? model->tree_depth : 1000);
    if (turn % 9 == 0) { set->config.tree_depth = (uint16_t)(set->config.tree_depth + 3); }
    if (turn % 10 == 0 && set->config.tree_depth > 1) { set->config.tree_depth--; }
    set->more = more[turn / 5 % CHECK_COUNT(more)];
}

/* ---- drawing --------------------------------------------------------------------------------------------------- */

/* What is told to those who watch stays in its tile. */
typedef struct watch {
    unsigned left, top, right, bottom;
} watch_t;

static void watch_tile(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom) {
    require(left < right && right <= WIDTH && top < bottom && bottom <= HEIGHT, "a tile out of the window");
    *(watch_t *)context = (watch_t){left, top, right, bottom};
}

static void watch_span(void *context, unsigned row, unsigned first, unsigned end) {
    const watch_t *tile = context;
    require(row >= tile->top && row < tile->bottom && first >= tile->left && first < end && end <= tile->right,
            "a span out of its tile");
}

static void watch_window(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom, unsigned why) {
    (void)context;
    require(left < right && right <= WIDTH && top < bottom && bottom <= HEIGHT && why <= TUILE_WHY_PIXEL,
            "a part out of the window");
}

static void check_ids(const set_t *set, const tuile_tile_t *tile) {
    const uint32_t faces = set->model->face_count;
    for (uint32_t i = 0; i < tile->size_bytes; i += 4) {
        uint32_t id;
        memcpy(&id, tile->bytes + i, 4);
        require(id <= faces * set->scene.instance_count, "a face that the scene has not");
        if (id) { (void)tuile_model_source_face(set->model, (id - 1) % faces); }
    }
}

/* All tiles; the frame's error, or TUILE_OK. */
static int draw_frame(const set_t *set, tuile_t *renderer) {
    const tuile_config_t *config = tuile_config(renderer);
    const unsigned expected = (WIDTH + config->tile_width - 1u) / config->tile_width * (HEIGHT / config->tile_height);
    tuile_tile_t tile;
    tuile_stats_t stats;
    unsigned tiles = 0;
    int result = tuile_begin(renderer, &set->scene);
    if (result != TUILE_OK) { return result; }
    while ((result = tuile_next(renderer, &tile)) == 1) {
        require(++tiles <= expected, "more tiles than there are");
        if (config->format == TUILE_FACE_IDS) { check_ids(set, &tile); }
    }
    require(result != TUILE_OK || tiles == expected, "fewer tiles than there are");
    require(tuile_end(renderer, &stats) == TUILE_OK, "a frame that does not end");
    require(stats.peak_bytes <= stats.size_bytes, "more memory used than there is");
    return result;
}

/* In a block of the least size and a little more; where that is not enough, in one of the size that is told. */
static int draw_growing(const set_t *set, const tuile_config_t *config) {
    size_t size = 0;
    tuile_t *renderer;
    (void)tuile_init(&renderer, config, NULL, 0, &size);
    size += set->more;
    for (unsigned grown = 0;; grown++) {
        void *block = malloc(size);
        require(block != NULL, "out of memory");
        require(tuile_init(&renderer, config, block, size, NULL) == TUILE_OK, "the least block is refused");
        const int result = draw_frame(set, renderer);
        const size_t wanted = result == TUILE_ERROR_MEMORY ? tuile_wanted(renderer) : 0;
        free(block);
        counts.grown[config->method] += grown == 1;
        if (result != TUILE_ERROR_MEMORY) { return result; }
        require(wanted > size, "a block is too small, and no larger one wanted");
        require(grown < GROWN_MOST && wanted <= BLOCK_MOST, "no block is large enough");
        size = wanted;
    }
}

/* The errors that tuile.h allows for a model that was opened, each with its reason. */
static bool is_allowed(const set_t *set, const tuile_config_t *config, int result) {
    const bool tree = config->method == TUILE_TREE;
    switch (result) {
    case TUILE_OK: counts.drawn[config->method]++; return !tree || set->model->tree_depth <= config->tree_depth;
    case TUILE_ERROR_RANGE: counts.out_of_range[config->method]++; return true;
    case TUILE_ERROR_LIMITS: counts.too_deep++; return tree && set->model->tree_depth > config->tree_depth;
    case TUILE_ERROR_MODEL: counts.deeper_than_told++; return tree;
    default: return false;
    }
}

static void draw_by(const set_t *set, unsigned method) {
    watch_t watch = {0};
    const tuile_trace_t trace = {.context = &watch, .tile = watch_tile, .span = watch_span, .window = watch_window};
    tuile_config_t config = set->config;
    config.method = (uint8_t)method;
    if (turn % 11 == 0) { config.trace = &trace; }
    const int result = draw_growing(set, &config);
    if (!is_allowed(set, &config, result)) {
        (void)fprintf(stderr, "%s, %ux%u, format %u, %zu bytes more, turn %u: %s\n", names[method], config.tile_width,
                      config.tile_height, config.format, set->more, turn, tuile_error_text(result));
        require(false, "an error that this model has not earned");
    }
}

static void pick(const set_t *set) {
    tuile_hit_t hit;
    const size_t size =
        TUILE_PICK_BYTES((size_t)HEIGHT, (size_t)set->config.cluster_vertices) + TUILE_CORNERS_BYTES(set->config.corners) +
        (set->model->morph_positions ? TUILE_MORPH_BYTES((size_t)set->config.cluster_vertices, (size_t)set->model->face_count) : 0);
    void *block = malloc(size);
    require(block != NULL, "out of memory");
    const int result = tuile_pick(&set->scene, &set->config, WIDTH / 2, HEIGHT / 2, block, size, &hit);
    require(result == 0 || result == TUILE_ERROR_RANGE ||
                (result == 1 && hit.face < set->model->face_count && hit.instance < set->scene.instance_count),
            "a wrong pick");
    free(block);
}

static void draw(const tuile_model_t *model) {
    set_t set;
    set_make(&set, model);
    for (unsigned method = 0; method < METHODS - (model->tree == NULL); method++) {
        draw_by(&set, method);
    }
    if (turn % 16 == 0) { pick(&set); }
    turn++;
}

/* True when the bytes, which must be on the heap and no longer than they are, make a model. */
static bool try_bytes(const uint8_t *bytes, size_t size) {
    tuile_model_t model;
    counts.inputs++;
    const int result = tuile_model_open(&model, bytes, size);
    require(result == TUILE_OK || result == TUILE_ERROR_MODEL, "neither a model nor none");
    if (result != TUILE_OK) { return false; }
    counts.loaded++;
    draw(&model);
    return true;
}

static void put_right(uint8_t *bytes, size_t size) {
    if (size < MODEL_HEADER_BYTES) { return; }
    for (unsigned i = 0; i < 4; i++) {
        bytes[MODEL_AT_SIZE + i] = (uint8_t)(size >> 8 * i);
    }
    const uint32_t crc = model_crc32(0, bytes + MODEL_AT_VERSION, size - MODEL_AT_VERSION);
    for (unsigned i = 0; i < 4; i++) {
        bytes[MODEL_AT_CRC32 + i] = (uint8_t)(crc >> 8 * i);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    uint8_t *copy = malloc(size ? size : 1);
    if (!copy) { return 0; }
    memcpy(copy, bytes, size);
    (void)try_bytes(copy, size);
    put_right(copy, size);
    (void)try_bytes(copy, size);
    free(copy);
    return 0;
}

/* ---- damage --------------------------------------------------------------------------------------------------- */

#ifdef FUZZ_DRIVER
#define THINNED (CHECK_SANITIZED ? 12u : 7u)

typedef struct bytes {
    uint8_t *at;
    size_t size;
} bytes_t;

static bytes_t compile(mesh_t *mesh, const mesh_options_t *options) {
    bytes_t bytes;
    sim_error_t error = {""};
    require(mesh_compile(mesh, options, &bytes.at, &bytes.size, NULL, &error) == 0, error.text);
    mesh_free(mesh);
    require(try_bytes(bytes.at, bytes.size), "the model itself does not load");
    return bytes;
}

/* One byte at a time, to every other value, or to a few; of those drawn, one in `thinned`. A check sum of 32 bits finds all. */
static void each_byte(const bytes_t *model, bool all_values, unsigned thinned) {
    static const unsigned some[] = {0, 1, 2, 3, 127, 128, 254, 255};
    uint8_t *copy = malloc(model->size);
    unsigned number = 0;
    require(copy != NULL, "out of memory");
    memcpy(copy, model->at, model->size);
    for (size_t at = 0; at < model->size; at++) {
        const uint8_t was = copy[at];
        for (unsigned k = 0; k < (all_values ? 256u : 16u); k++) {
            const uint8_t value = (uint8_t)(all_values ? k : k < 8 ? was ^ 1u << k : some[k - 8]);
            if (value == was || number++ % thinned != 0) { continue; }
            copy[at] = value;
            require(!try_bytes(copy, model->size), "a damaged byte is not noticed");
            put_right(copy, model->size);
            (void)try_bytes(copy, model->size);
            memcpy(copy, model->at, MODEL_AT_VERSION);
            copy[at] = was;
        }
    }
    free(copy);
}

static void each_length(const bytes_t *model) {
    for (size_t size = 0; size < model->size; size++) {
        uint8_t *copy = malloc(size ? size : 1);
        require(copy != NULL, "out of memory");
        memcpy(copy, model->at, size);
        require(!try_bytes(copy, size), "a model cut short is not noticed");
        put_right(copy, size);
        (void)try_bytes(copy, size);
        free(copy);
    }
}

static void many_bytes(const bytes_t *model, unsigned rounds, random_source_t *random) {
    uint8_t *copy = malloc(model->size);
    require(copy != NULL, "out of memory");
    for (unsigned round = 0; round < rounds; round++) {
        memcpy(copy, model->at, model->size);
        for (int32_t n = random_between(random, 2, 12); n > 0; n--) {
            copy[random_between(random, MODEL_AT_VERSION + 2, (int32_t)model->size - 1)] = (uint8_t)random_between(random, 0, 255);
        }
        put_right(copy, model->size);
        (void)try_bytes(copy, model->size);
    }
    free(copy);
}

/* A polygon of many corners, so that cutting it takes room. */
static void star(mesh_t *mesh, unsigned corners) {
    uint32_t corner[255];
    model_start(mesh);
    random_source_t random = random_seed(3);
    for (unsigned i = 0; i < corners; i++) {
        const double away = i % 2 ? 0.5 : 1.5, x = 2.0 * i / corners - 1;
        corner[i] = model_position(mesh, away * (i < corners / 2 ? x + 0.5 : 0.5 - x) + 0.01 * random_real(&random, 0, 1),
                                   i < corners / 2 ? -away : away, 0);
    }
    model_face(mesh, corner, corners, model_material(mesh, 200, 100, 50));
}

/* Two squares through one another, and a bow tie through both: with a tree they are cut, at corners between the steps. */
static void crossing(mesh_t *mesh) {
    static const double at[12][3] = {{-1, -0.9, -0.7}, {1, -0.9, 0.3}, {1, 0.8, 0.3}, {-1, 0.8, -0.7}, {-0.3, -1, 1}, {0.2, -1, -1},
                                     {0.2, 1, -1},     {-0.3, 1, 1},   {-1, -0.8, 0}, {1, 0.7, 0},     {1, -0.8, 0},  {-1, 0.7, 0}};
    model_start(mesh);
    for (uint32_t i = 0; i < 12; i++) {
        (void)model_position(mesh, at[i][0], at[i][1], at[i][2]);
    }
    for (uint32_t i = 0; i < 12; i += 4) {
        const uint32_t corners[4] = {i, i + 1, i + 2, i + 3};
        model_face(mesh, corners, 4, model_material(mesh, 20 * i, 255 - 20 * i, 90));
    }
}

static void *copy_of(const void *from, size_t size) {
    void *to = malloc(size);
    require(to != NULL, "out of memory");
    memcpy(to, from, size);
    return to;
}

/* Two textures, one with a palette and a key and one with alpha; materials of all kinds. */
static void paint(mesh_t *mesh, random_source_t *random) {
    static const uint8_t indices[] = {0x10, 0x32, 0x04, 0x65, 0x87, 0x09, 0xba, 0xdc, 0x0e, 0x10, 0x02}; /* 5 x 3, 2 x 1, 1 x 1 */
    uint8_t palette[32], texels[32];
    for (unsigned i = 0; i < 32; i++) {
        palette[i] = (uint8_t)random_between(random, 0, 255);
        texels[i] = (uint8_t)random_between(random, 0, 255);
    }
    mesh->textures = calloc(2, sizeof *mesh->textures);
    mesh->surfaces = calloc(mesh->material_count, sizeof *mesh->surfaces);
    require(mesh->textures && mesh->surfaces, "out of memory");
    mesh->texture_count = 2;
    mesh->textures[0] = (mesh_texture_t){.texels = copy_of(indices, 11),
                                         .size_bytes = 11,
                                         .palette = copy_of(palette, 32),
                                         .palette_bytes = 32,
                                         .width = 5,
                                         .height = 3,
                                         .format = TUILE_TEXEL_PALETTE4,
                                         .levels = 2,
                                         .flags = TUILE_TEXTURE_KEY | TUILE_TEXTURE_CLAMP_S,
                                         .key = 2};
    mesh->textures[1] = (mesh_texture_t){
        .texels = copy_of(texels, 32), .size_bytes = 32, .width = 4, .height = 4, .format = TUILE_TEXEL_ARGB4444, .levels = 1};
    for (size_t m = 0; m < mesh->material_count; m++) {
        mesh->surfaces[m] = (tuile_material_t){.alpha = (uint8_t)(m % 3 ? 255 : 120),
                                               .emission = {(uint8_t)(40 * m), 0, 9},
                                               .specular = (uint8_t)(m % 2 * 200),
                                               .shininess = (uint8_t)(m % 8),
                                               .texture = (uint8_t)(m % 3 == 2 ? TUILE_NO_TEXTURE : m % 3),
                                               .blend = (uint8_t)(m % 3),
                                               .flags = (uint8_t)(m % 16),
                                               .uv_bits = (uint8_t)(8 - m % 9)};
    }
}

/* All that a vertex can have; with a second key frame, unless there is to be a tree. */
static void dress(mesh_t *mesh, bool morphs, random_source_t *random) {
    sim_error_t error = {""};
    paint(mesh, random);
    mesh->texcoords = calloc(mesh->corner_count, sizeof *mesh->texcoords);
    mesh->colours = calloc(mesh->corner_count, sizeof *mesh->colours);
    require(mesh->texcoords && mesh->colours, "out of memory");
    for (size_t c = 0; c < mesh->corner_count; c++) {
        const double far = c % 5 == 0 ? 40000 : c % 3 == 0 ? 100 : 4;
        for (int k = 0; k < 2; k++) {
            mesh->texcoords[c][k] = random_real(random, -far, far);
        }
        for (int k = 0; k < 4; k++) {
            mesh->colours[c][k] = (uint8_t)random_between(random, 0, 255);
        }
    }
    require(mesh_make_normals(mesh, false, &error) == 0, error.text);
    if (!morphs) { return; }
    mesh->morph.positions = copy_of(mesh->positions, mesh->position_count * sizeof *mesh->positions);
    mesh->morph.normals = copy_of(mesh->normals, mesh->normal_count * sizeof *mesh->normals);
    mesh->morph.normal_count = mesh->normal_count;
    mesh->morph.corner_normals = copy_of(mesh->corner_normals, mesh->corner_count * sizeof *mesh->corner_normals);
    for (size_t p = 0; p < mesh->position_count; p++) {
        mesh->morph.positions[p][p % 3] += random_real(random, -1, 1);
    }
}

/* Whether some face of a model of polygons crosses itself. */
static bool has_crossing(const tuile_model_t *model) {
    for (uint32_t k = 0; k < model->cluster_count; k++) {
        const uint8_t *cluster = model->clusters + (size_t)k * MODEL_CLUSTER_BYTES;
        const uint8_t *face = model->faces + model_u32(cluster + CLUSTER_AT_FACE_BYTES);
        for (unsigned i = 0; cluster[CLUSTER_AT_KIND] == MODEL_CLUSTER_POLYGONS && i < model_u16(cluster + CLUSTER_AT_FACE_COUNT);
             i++) {
            if (face[1] & MODEL_FACE_CROSSING) { return true; }
            face += MODEL_POLYGON_BYTES(face[0]);
        }
    }
    return false;
}

static void report(size_t size) {
    (void)printf("model of %zu bytes: %lu inputs so far, %lu loaded;", size, counts.inputs, counts.loaded);
    for (unsigned m = 0; m < METHODS; m++) {
        (void)printf(" %s %lu drawn, %lu in more memory, %lu out of range;", names[m], counts.drawn[m], counts.grown[m],
                     counts.out_of_range[m]);
    }
    (void)printf(" trees too deep: %lu, deeper than told: %lu\n", counts.too_deep, counts.deeper_than_told);
    (void)fflush(stdout);
}

static void shape_make(mesh_t *mesh, unsigned shape) {
    switch (shape) {
    case 0: model_octahedron(mesh); break;
    case 1: model_cube(mesh); break;
    case 2: model_room(mesh); break;
    case 3: model_torus(mesh, 8, 5, true); break;
    case 4: star(mesh, 24); break;
    default: crossing(mesh); break;
    }
}

int main(int argc, char **argv) {
    random_source_t random = random_seed(17);
    bool fractions = false, crossings = false;
    if (argc > 1) { return fuzz_drive(argc, argv, NULL); } /* files */
    for (unsigned k = 0; k < 16; k++) { /* the last four are small shapes again, with all that a model can have */
        const bool dressed = k >= 12;
        const mesh_options_t options = {.tree = k % 2 != 0, .keep_planar = k / 2 == 5 || k / 2 == 7};
        mesh_t mesh;
        tuile_model_t opened;
        shape_make(&mesh, k / 2 == 6 ? 1 : k / 2);
        if (dressed) { dress(&mesh, !options.tree, &random); }
        bytes_t model = compile(&mesh, &options);
        require(tuile_model_open(&opened, model.at, model.size) == TUILE_OK && (opened.tree != NULL) == options.tree, "no tree");
        fractions |= options.tree && opened.fractions != NULL;
        crossings |= options.tree && has_crossing(&opened);
        require(!dressed || (opened.texcoords && opened.colours && opened.texture_count == 2 &&
                             (opened.morph_positions != NULL) == !options.tree),
                "a model without what it was dressed with");
        each_byte(&model, k == 0 && !CHECK_SANITIZED, dressed ? 2 * THINNED : THINNED);
        each_length(&model);
        many_bytes(&model, CHECK_SANITIZED ? 200 : 1000, &random);
        report(model.size);
        free(model.at);
    }
    require(fractions && crossings, "a tree without corners between steps or faces that cross themselves");
    return 0;
}
#endif
