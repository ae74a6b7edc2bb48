/* Writes a scene as a source for the Uno: its compiled model, and the views of its frames, for the compact renderer.
 *
 * Usage: uno_views SCENE MODEL.tuile > model_SCENE.c */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../firmware/scenes.h"
#include "../../firmware/uno/tell.h"
#include "../../raster/compact/compact.h"
#include "../../sim/mesh/mesh.h"

#define WIDTH 128
#define HEIGHT 64

static void put_row(const char *name, const tuile_compact_row_t *row) {
    (void)printf("     .%s = {INT64_C(%" PRId64 "), {%" PRId32 ", %" PRId32 ", %" PRId32 "}, {%d, %d, %d}},\n", name, row->t,
                 row->m[0], row->m[1], row->m[2], row->low[0], row->low[1], row->low[2]);
}

static void put_view(const tuile_compact_view_t *view) {
    (void)printf("    {\n");
    put_row("x", &view->x);
    put_row("y", &view->y);
    put_row("w", &view->w);
    (void)printf("     .w_low = INT64_C(%" PRId64 "), .w_high = INT64_C(%" PRId64 "),\n", view->w_low, view->w_high);
    (void)printf("     .w_fast = %" PRId32 ", .w_range = UINT32_C(%" PRIu32 "),\n", view->w_fast, view->w_range);
    (void)printf("     .observer = {%" PRId32 ", %" PRId32 ", %" PRId32 "}, .observer_bits = %d,\n", view->observer[0],
                 view->observer[1], view->observer[2], view->observer_bits);
    (void)printf("     .lights = {");
    for (unsigned i = 0; i < TUILE_COMPACT_LIGHTS; i++) {
        (void)printf("{%d, %d, %d},", view->lights[i][0], view->lights[i][1], view->lights[i][2]);
    }
    (void)printf("}, .light_count = %u, .ambient = %u,\n", view->light_count, view->ambient);
    (void)printf("     .guard_x = %d, .guard_y = %d, .background = %u,\n", view->guard_x, view->guard_y, view->background);
    (void)printf("     .k = %d, .depth_shift = %u, .mirrored = %d},\n", view->k, view->depth_shift, view->mirrored);
}

static int put_views(const scene_script_t *script, const uint8_t *bytes, size_t size_bytes) {
    scene_stage_t stage;
    int error = scene_open(&stage, script, bytes, size_bytes, WIDTH, HEIGHT);

    (void)printf("const TUILE_FLASH tuile_compact_view_t views_%s[] = {\n", script->name);
    for (uint32_t i = 0; i < UNO_FRAMES && !error; i++) {
        tuile_compact_view_t view;

        if ((error = scene_frame(&stage, i * UNO_STEP)) || (error = tuile_compact_view(&view, &stage.scene, WIDTH, HEIGHT))) {
            break;
        }
        put_view(&view);
    }
    (void)printf("};\n");
    return error;
}

static void put_model(const char *name, const uint8_t *bytes, size_t size_bytes) {
    (void)printf("const TUILE_FLASH uint8_t model_%s[] = {", name);
    for (size_t i = 0; i < size_bytes; i++) {
        (void)printf("%s%u,", i % 24 ? "" : "\n    ", bytes[i]);
    }
    (void)printf("\n};\n");
}

int main(int count, char **arguments) {
    const scene_script_t *script = count == 3 ? scene_find(arguments[1]) : NULL;
    const mesh_options_t options = {.tree = true};
    sim_error_t error = {""};
    mesh_report_t report;
    uint8_t *bytes;
    size_t size_bytes;
    int result;

    if (!script) {
        (void)fputs("Usage: uno_views SCENE MODEL.tuile\n", stderr);
        return 2;
    }
    if (mesh_load(arguments[2], 0, &options, &bytes, &size_bytes, &report, &error)) {
        (void)fprintf(stderr, "uno_views: %s\n", error.text);
        return 1;
    }
    (void)printf("/* Made by uno_views: the scene \"%s\" for %u x %u pixels. */\n", script->name, WIDTH, HEIGHT);
    (void)printf("#include \"raster/compact/compact.h\"\n\n");
    put_model(script->name, bytes, size_bytes);
    result = put_views(script, bytes, size_bytes);
    free(bytes);
    if (result) { (void)fprintf(stderr, "uno_views: %s: %s\n", script->name, tuile_error_text(result)); }
    return result ? 1 : 0;
}
