/* Damaged compiled models: whatever tuile_model_open lets pass is drawn completely, in memory of every size, and picked. Reads out
 * of bounds and overflows are left to the sanitizers.
 *
 * Without arguments the program damages small models of its own: every byte to every other value, every length, as it is and with
 * the check sum put right again, and then many bytes at once. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../raster/geometry/model.h"
#include "../raster/tuile.h"
#include "../sim/mesh/mesh.h"
#include "reference/fuzz_driver.h"
#include "support/check.h"
#include "support/models.h"
#include "support/random.h"

#define WIDTH 64u
#define HEIGHT 48u

static struct { unsigned long inputs, loaded, drawn, refused_to_draw; } counts;
static unsigned turn; /* of configurations and cameras, so that all meet all */

static void require(bool condition, const char *what) {
    if (!condition) {
        (void)fprintf(stderr, "fuzz_model: %s\n", what);
        abort();
    }
}

/* ---- drawing ------------------------------------------------------------------------------------------------- */

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

static void draw(const tuile_model_t *model) {
    static const tuile_config_t configs[] = {
        {.tile_width = 16, .tile_height = 8},
        {.tile_width = 64, .tile_height = 4, .shade = TUILE_GOURAUD},
        {.tile_width = 64, .tile_height = 48, .format = TUILE_FACE_IDS},
        {.tile_width = 24, .tile_height = 16, .format = TUILE_FACE_IDS, .tie = TUILE_TIE_LAST},
        {.tile_width = 64, .tile_height = 16, .shade = TUILE_GOURAUD, .format = TUILE_RGB565_LE},
    };
    static const size_t more[] = {0, 64, 700, 40000}; /* beyond the least: from face by face to all at once */
    static const tuile_light_t light = {{0, -11585, -11585}, 200};
    tuile_config_t config = configs[turn % CHECK_COUNT(configs)];
    tuile_instance_t instance = {.model = model, .pose = {.scale = TUILE_SCALE_ONE}, .two_sided = turn / 3 % 2 != 0};
    tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .lights = &light, .light_count = 1, .ambient = 40};
    size_t size = 0;
    tuile_t *renderer;
    tuile_tile_t tile;
    unsigned tiles = 0, expected;
    tuile_rotation(instance.pose.rotation, 1, (bam16_t)(turn * 7919u));
    scene.camera = camera(turn / 2 % 4);
    config.width = WIDTH;
    config.height = HEIGHT;
    expected = (WIDTH + config.tile_width - 1u) / config.tile_width * (HEIGHT / config.tile_height);
    config.cluster_vertices = model->cluster_vertices_max;
    config.corners = model->corners_max;
    (void)tuile_init(&renderer, &config, NULL, 0, &size);
    size += more[turn / 5 % CHECK_COUNT(more)];
    turn++;
    void *block = malloc(size);
    require(block != NULL, "out of memory");
    require(tuile_init(&renderer, &config, block, size, NULL) == TUILE_OK, "the least block is refused");
    int result = tuile_begin(renderer, &scene);
    while (result == TUILE_OK && (result = tuile_next(renderer, &tile)) == 1) {
        tiles++;
        result = TUILE_OK;
        for (uint32_t i = 0; config.format == TUILE_FACE_IDS && i < tile.size_bytes; i += 4) {
            uint32_t id;
            memcpy(&id, tile.bytes + i, 4);
            require(id <= model->face_count, "a face that the model has not");
            if (id) { (void)tuile_model_source_face(model, id - 1); }
        }
        if (tiles == expected) { break; }
    }
    if (result != TUILE_OK && result != TUILE_ERROR_RANGE) {
        (void)fprintf(stderr, "tile %u of %u, %ux%u, format %u, %zu bytes, turn %u: %s\n", tiles, expected, config.tile_width,
                      config.tile_height, config.format, size, turn - 1, tuile_error_text(result));
        require(false, "an error that is not about the range of numbers");
    }
    if (result == TUILE_OK) {
        require(tuile_next(renderer, &tile) == 0, "more tiles than there are");
        counts.drawn++;
    } else {
        counts.refused_to_draw++;
    }
    (void)tuile_end(renderer, NULL);
    free(block);

    if (turn % 16 == 0) {
        tuile_hit_t hit;
        size = TUILE_PICK_BYTES((size_t)HEIGHT, (size_t)config.cluster_vertices) + TUILE_CORNERS_BYTES(config.corners);
        block = malloc(size);
        require(block != NULL, "out of memory");
        result = tuile_pick(&scene, &config, WIDTH / 2, HEIGHT / 2, block, size, &hit);
        require(result == 0 || result == TUILE_ERROR_RANGE || (result == 1 && hit.face < model->face_count), "a wrong pick");
        free(block);
    }
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
typedef struct bytes {
    uint8_t *at;
    size_t size;
} bytes_t;

static bytes_t compile(mesh_t *mesh) {
    bytes_t bytes;
    sim_error_t error = {""};
    require(mesh_compile(mesh, NULL, &bytes.at, &bytes.size, NULL, &error) == 0, error.text);
    mesh_free(mesh);
    require(try_bytes(bytes.at, bytes.size), "the model itself does not load");
    return bytes;
}

/* One byte at a time. A check sum of 32 bits finds all of these. */
static void each_byte(const bytes_t *model, bool all_values) {
    static const unsigned some[] = {0, 1, 2, 3, 127, 128, 254, 255};
    uint8_t *copy = malloc(model->size);
    require(copy != NULL, "out of memory");
    memcpy(copy, model->at, model->size);
    for (size_t at = 0; at < model->size; at++) {
        const uint8_t was = copy[at];
        for (unsigned k = 0; k < (all_values ? 256u : 16u); k++) {
            const uint8_t value = (uint8_t)(all_values ? k : k < 8 ? was ^ 1u << k : some[k - 8]);
            if (value == was) { continue; }
            copy[at] = value;
            if (k < 16) { require(!try_bytes(copy, model->size), "a damaged byte is not noticed"); }
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

int main(int argc, char **argv) {
    random_source_t random = random_seed(17);
    if (argc > 1) { return fuzz_drive(argc, argv, NULL); } /* files */
    for (unsigned k = 0; k < 5; k++) {
        mesh_t mesh;
        switch (k) {
        case 0: model_octahedron(&mesh); break;
        case 1: model_cube(&mesh); break;
        case 2: model_room(&mesh); break;
        case 3: model_torus(&mesh, 8, 5, true); break;
        default: star(&mesh, 24); break;
        }
        bytes_t model = compile(&mesh);
        each_byte(&model, k == 0 && !CHECK_SANITIZED);
        each_length(&model);
        many_bytes(&model, CHECK_SANITIZED ? 1000 : 5000, &random);
        (void)printf("model of %zu bytes: %lu inputs so far, %lu loaded, %lu drawn, %lu out of the range of numbers\n", model.size,
                     counts.inputs, counts.loaded, counts.drawn, counts.refused_to_draw);
        (void)fflush(stdout);
        free(model.at);
    }
    return 0;
}
#endif
