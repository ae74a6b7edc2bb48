/* Golden pictures: small models drawn as they were when someone last looked at them, and hashes of frames of the demo.
 *
 * tests/golden holds a picture for each model and way of shading, hashes.txt the hashes of what the renderer put out for them, and
 * demo.txt those of the demo's frames 0, 9, 18 and 27. Where a picture differs, build/golden gets what was drawn and where it
 * differs. UPDATE_GOLDEN=1 in the environment writes all of them anew; then look at them. */
#include "support/check.h"
#include "support/cli.h"
#include "support/command.h"
#include "support/golden.h"
#include "support/models.h"

#include "../sim/view.h"

#define WIDTH 120
#define HEIGHT 90

static void staircase(mesh_t *mesh) { model_staircase(mesh, 5); }
static void torus(mesh_t *mesh) { model_torus(mesh, 32, 14, false); }
static void sphere(mesh_t *mesh) { model_sphere(mesh, 9, 16); }

static const struct {
    const char *name;
    void (*make)(mesh_t *);
    double eye[3], at[3];
    double fov;
    bool inside; /* the camera stands at eye instead of where it sees the whole model */
} models[] = {
    {"cube", model_cube, {0, 0, 0}, {0, 0, 0}, 45, false},
    {"torus", torus, {0, 0, 0}, {0, 0, 0}, 45, false},
    {"sphere", sphere, {0, 0, 0}, {0, 0, 0}, 45, false},
    {"staircase", staircase, {-3, 6, 9}, {2.5, 1, 1.5}, 40, true},
    {"room", model_room, {-1, 0.5, 3.8}, {0.2, -0.3, -4}, 75, true},
    {"octahedron", model_octahedron, {0, 0, 0}, {0, 0, 0}, 45, false},
};
static const char *const shades[] = {"flat", "gouraud"};
/* ---- pictures ----------------------------------------------------------------------------------------------- */

static void draw(unsigned m, unsigned shade, uint16_t *picture) {
    static uint64_t block[8192];
    model_compiled_t compiled;
    mesh_t mesh;
    view_t view;
    sim_error_t error = {""};
    view_options_t options = VIEW_OPTIONS_DEFAULT;
    tuile_t *renderer;
    tuile_tile_t tile;
    models[m].make(&mesh);
    model_compile(&compiled, &mesh);
    options.fov = models[m].fov;
    memcpy(options.background, (const uint8_t[3]){0x18, 0x20, 0x30}, 3);
    if (models[m].inside) {
        options.has_eye = options.has_at = options.has_near = true;
        memcpy(options.eye, models[m].eye, sizeof options.eye);
        memcpy(options.at, models[m].at, sizeof options.at);
        options.near = 0.1;
    }
    if (view_make(&view, &options, &compiled.model, WIDTH, HEIGHT, 1, &error) != 0) { fail_msg("%s", error.text); }
    const tuile_config_t config = {.width = WIDTH,
                                   .height = HEIGHT,
                                   .tile_width = 32,
                                   .tile_height = 16,
                                   .format = TUILE_RGB565_LE,
                                   .shade = (uint8_t)shade,
                                   .corners = compiled.model.corners_max};
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
    assert_int_equal(tuile_begin(renderer, &view.scene), 0);
    int result;
    while ((result = tuile_next(renderer, &tile)) == 1) {
        for (unsigned y = 0; y < tile.height; y++) {
            memcpy(picture + (tile.y + y) * WIDTH + tile.x, tile.bytes + 2u * y * tile.width, 2u * tile.width);
        }
    }
    assert_int_equal(result, 0);
    assert_int_equal(tuile_end(renderer, NULL), 0);
    model_free(&compiled);
}

/* 31 and 63 become 255, by rounding. */
static void widen(const uint16_t *from, sim_picture_t *to) {
    assert_int_equal(sim_picture_create(to, WIDTH, HEIGHT, NULL), 0);
    for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
        to->rgb[3 * i] = (uint8_t)(((from[i] >> 11) * 255 + 15) / 31);
        to->rgb[3 * i + 1] = (uint8_t)(((from[i] >> 5 & 63) * 255 + 31) / 63);
        to->rgb[3 * i + 2] = (uint8_t)(((from[i] & 31) * 255 + 15) / 31);
    }
}

static void small_models_look_as_they_did(void **state) {
    golden_t golden;
    (void)state;
    golden_open(&golden, "tests/golden/hashes.txt");
    for (unsigned m = 0; m < CHECK_COUNT(models); m++) {
        for (unsigned shade = 0; shade < 2; shade++) {
            static uint16_t picture[WIDTH * HEIGHT];
            char name[64];
            sim_picture_t drawn;
            (void)snprintf(name, sizeof name, "%s-%s", models[m].name, shades[shade]);
            draw(m, shade, picture);
            widen(picture, &drawn);
            golden_picture(&golden, name, (const uint8_t *)picture, sizeof picture, &drawn);
            sim_picture_free(&drawn);
        }
    }
    golden_close(&golden);
}

/* ---- the demo ----------------------------------------------------------------------------------------------- */

static void append(char *to, size_t size, const char *word) {
    const size_t used = strlen(to);
    (void)snprintf(to + used, size - used, "%s%s", used ? " " : "", word);
}

/* A line of the Makefile's demo with every 9th frame and hashes instead of its pictures. */
static void demo_command(char *to, size_t size, char *line) {
    static const struct {
        const char *name, *variable;
    } variables[] = {{"$(TUILE)", "TUILE"}, {"$(SPIDER)", "SPIDER"}, {"$(BUNNY_6000)", "BUNNY_6000"}};
    char *rest = line;
    to[0] = '\0';
    for (char *word; (word = strtok_r(rest, " \t", &rest)) != NULL;) {
        const char *value = word;
        if (strcmp(word, "--out") == 0 || strcmp(word, "--sheet") == 0) {
            (void)strtok_r(rest, " \t", &rest);
            continue;
        }
        for (unsigned i = 0; i < CHECK_COUNT(variables); i++) {
            if (strcmp(word, variables[i].name) == 0) {
                value = getenv(variables[i].variable);
                if (!value) { fail_msg("%s is not set", variables[i].variable); }
            }
        }
        if (strcmp(word, "--frames") == 0) {
            assert_string_equal(strtok_r(rest, " \t", &rest), "36");
            value = "--frames 4 --spin 90";
        }
        append(to, size, value);
    }
    append(to, size, "--hash");
}

static void frames_of_the_demo_have_the_hashes_they_had(void **state) {
    static const char *const names[] = {"spider", "bunny"};
    char *makefile = command_read("Makefile", NULL), *rest = makefile;
    golden_t golden;
    unsigned demos = 0;
    bool in_demo = false;
    (void)state;
    assert_non_null(makefile);
    golden_open(&golden, "tests/golden/demo.txt");
    for (char *line; (line = strsep(&rest, "\n")) != NULL;) {
        if (line[0] != '\t') { in_demo = strncmp(line, "demo:", 5) == 0; }
        if (!in_demo || strncmp(line, "\t$(TUILE) render ", 17) != 0) { continue; }
        char command[2048];
        command_result_t result;
        unsigned frames = 0;
        assert_true(demos < CHECK_COUNT(names));
        demo_command(command, sizeof command, line + 1);
        command_shell(&result, command);
        if (result.code != 0) { fail_msg("%s\n%s", command, result.err); }
        char *out = result.out;
        for (char *text; (text = strsep(&out, "\n")) != NULL;) {
            unsigned frame;
            char hash[24], name[64];
            if (sscanf(text, "frame %u %23s", &frame, hash) != 2) { continue; }
            assert_int_equal(frame, frames++);
            (void)snprintf(name, sizeof name, "%s-%02u", names[demos], 9 * frame);
            if (!golden_hash(&golden, name, hash)) {
                print_message("frame %u of %s differs: %s\n", 9 * frame, names[demos], command);
            }
        }
        assert_int_equal(frames, 4);
        command_free(&result);
        demos++;
    }
    assert_int_equal(demos, CHECK_COUNT(names));
    free(makefile);
    golden_close(&golden);
}

/* The spider as it was drawn before there were textures. */
static void plain_colours_are_what_they_were(void **state) {
    static const char *const hashes[] = {"0c312047c5d03c91", "880ca4c657e42745", "73493a353e48f0c7", "b307b04ada684849"};
    static const char *const without[] = {"--plain", "--no-textures"};
    (void)state;
    for (unsigned k = 0; k < CHECK_COUNT(without); k++) {
        char command[2048];
        command_result_t result;
        (void)snprintf(command, sizeof command, "%s render %s --rotate 90 --frames 4 --spin 90 --background 182030 --hash %s",
                       cli_program(), getenv("SPIDER"), without[k]);
        command_shell(&result, command);
        if (result.code != 0) { fail_msg("%s\n%s", command, result.err); }
        for (unsigned frame = 0; frame < 4; frame++) {
            char line[64];
            (void)snprintf(line, sizeof line, "frame %u %s\n", frame, hashes[frame]);
            if (!strstr(result.out, line)) { fail_msg("%s: no %s in\n%s", command, line, result.out); }
        }
        command_free(&result);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_models_look_as_they_did),
        cmocka_unit_test(frames_of_the_demo_have_the_hashes_they_had),
        cmocka_unit_test(plain_colours_are_what_they_were),
    };
    return cmocka_run_group_tests_name("golden", tests, NULL, NULL);
}
