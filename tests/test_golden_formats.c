/* Golden pictures of formats, dithering and anti-aliasing, as a panel would show them; tests/golden/formats.txt holds their hashes.
 */
#include "support/check.h"
#include "support/golden.h"
#include "support/models.h"
#include "support/stage.h"

#include "../sim/wire.h"

static void torus(mesh_t *mesh) { model_torus(mesh, 32, 14, false); }
static void sphere(mesh_t *mesh) { model_sphere(mesh, 18, 32); }

static const struct {
    const char *name;
    void (*make)(mesh_t *);
    uint16_t width, height;
    uint8_t format, aa;
    bool dither;
} pictures[] = {
    {"sphere-mono-pages", sphere, 128, 64, TUILE_MONO_PAGES, TUILE_AA_NONE, true},
    {"sphere-mono-rows-aa-2x2", sphere, 128, 64, TUILE_MONO_ROWS, TUILE_AA_2X2, true},
    {"sphere-grey4", sphere, 120, 90, TUILE_GREY4, TUILE_AA_NONE, false},
    {"sphere-grey4-dithered", sphere, 120, 90, TUILE_GREY4, TUILE_AA_NONE, true},
    {"room-rgb332-dithered", model_room, 120, 90, TUILE_RGB332, TUILE_AA_NONE, true},
    {"room-rgb444-aa-2x2", model_room, 121, 91, TUILE_RGB444, TUILE_AA_2X2, false},
    {"sphere-mono-pages-turned", sphere, 61, 90, TUILE_MONO_PAGES_TURNED, TUILE_AA_NONE, true},
    {"sphere-grey4-turned-dithered", sphere, 61, 91, TUILE_GREY4_TURNED, TUILE_AA_NONE, true},
    {"room-rgb111-dithered", model_room, 121, 91, TUILE_RGB111, TUILE_AA_2X2, true},
    {"torus-bgr888", torus, 80, 60, TUILE_BGR888, TUILE_AA_2X2, false},
    {"torus-aa-4x4", torus, 120, 90, TUILE_RGB565_BE, TUILE_AA_4X4, false},
};

static void view(stage_t *stage, unsigned i) {
    view_options_t options = VIEW_OPTIONS_DEFAULT; /* before black, which mono shows best */
    if (pictures[i].make == model_room) {
        options.has_eye = options.has_at = options.has_near = true;
        memcpy(options.eye, (const double[3]){-1, 0.5, 3.8}, sizeof options.eye);
        memcpy(options.at, (const double[3]){0.2, -0.3, -4}, sizeof options.at);
        options.fov = 75;
        options.near = 0.1;
    }
    options.ambient = 0.1;
    options.diffuse = 0.9;
    stage_aim(stage, &options, pictures[i].width, pictures[i].height);
}

/* All bytes of the tiles, one behind the other, and what is seen. */
static size_t draw(unsigned i, uint8_t *bytes, sim_picture_t *seen) {
    static uint64_t block[16384];
    stage_t stage;
    mesh_t mesh;
    tuile_t *renderer;
    tuile_tile_t tile;
    size_t size = 0;
    int result;
    pictures[i].make(&mesh);
    stage_open(&stage, &mesh, pictures[i].width, pictures[i].height);
    view(&stage, i);
    const tuile_config_t config = {.width = pictures[i].width,
                                   .height = pictures[i].height,
                                   .tile_width = 32,
                                   .tile_height = 16,
                                   .format = pictures[i].format,
                                   .aa = pictures[i].aa,
                                   .dither = pictures[i].dither,
                                   .shade = TUILE_GOURAUD,
                                   .corners = stage.compiled.model.corners_max};
    assert_int_equal(sim_picture_create(seen, config.width, config.height, NULL), 0);
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
    assert_int_equal(tuile_begin(renderer, &stage.view.scene), 0);
    while ((result = tuile_next(renderer, &tile)) == 1) {
        memcpy(bytes + size, tile.bytes, tile.size_bytes);
        size += tile.size_bytes;
        assert_int_equal(wire_paste(seen, config.format, &tile, NULL), 0);
    }
    assert_int_equal(result, 0);
    assert_int_equal(tuile_end(renderer, NULL), 0);
    stage_close(&stage);
    return size;
}

static void formats_look_as_they_did(void **state) {
    golden_t golden;
    (void)state;
    golden_open(&golden, "tests/golden/formats.txt");
    for (unsigned i = 0; i < CHECK_COUNT(pictures); i++) {
        static uint8_t bytes[128 * 128 * 3];
        sim_picture_t seen;
        const size_t size = draw(i, bytes, &seen);
        golden_picture(&golden, pictures[i].name, bytes, size, &seen);
        sim_picture_free(&seen);
    }
    golden_close(&golden);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_look_as_they_did),
    };
    return cmocka_run_group_tests_name("golden_formats", tests, NULL, NULL);
}
