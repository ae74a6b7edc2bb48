/* Closed surfaces have no holes: seen from outside, cut by the near plane, and from the inside. */
#include "support/check.h"
#include "support/frame.h"
#include "support/stage.h"

#include <math.h>

/* Background that cannot be reached from the border of the picture through background. */
static unsigned enclosed_background(const uint32_t *ids, unsigned width, unsigned height) {
    uint8_t *reached = calloc(width, height);
    uint32_t *stack = malloc(sizeof *stack * (4u * width * height + 4u * (width + height)));
    size_t depth = 0;
    unsigned enclosed = 0;
    assert_non_null(reached);
    assert_non_null(stack);
    for (unsigned p = 0; p < width * height; p++) {
        const unsigned x = p % width, y = p / width;
        if (x == 0 || y == 0 || x == width - 1 || y == height - 1) { stack[depth++] = p; }
    }
    while (depth > 0) {
        const uint32_t p = stack[--depth];
        if (reached[p] || ids[p] != 0) { continue; }
        reached[p] = 1;
        if (p % width > 0) { stack[depth++] = p - 1; }
        if (p % width < width - 1) { stack[depth++] = p + 1; }
        if (p / width > 0) { stack[depth++] = p - width; }
        if (p / width < height - 1) { stack[depth++] = p + width; }
    }
    for (unsigned p = 0; p < width * height; p++) {
        enclosed += ids[p] == 0 && !reached[p];
    }
    free(reached);
    free(stack);
    return enclosed;
}

/* Seen from outside and uncut, a closed surface shows a front wherever it shows anything. */
static void check_fronts_cover_all(stage_t *stage, unsigned frame) {
    uint32_t *fronts = frame_draw_ids(&stage->view.scene, 120, 160);
    stage->view.instance.two_sided = true;
    uint32_t *both = frame_draw_ids(&stage->view.scene, 120, 160);
    stage->view.instance.two_sided = false;
    unsigned covered = 0;
    for (unsigned p = 0; p < 120 * 160; p++) {
        if ((fronts[p] != 0) != (both[p] != 0)) { fail_msg("frame %u: a hole at %u,%u", frame, p % 120, p / 120); }
        covered += fronts[p] != 0;
    }
    assert_true(covered > 1000);
    free(fronts);
    free(both);
}

static void closed_surfaces_have_no_holes_in_any_frame_of_a_spin(void **state) {
    (void)state;
    for (unsigned k = 0; k < 5; k++) {
        stage_t stage;
        mesh_t mesh;
        if (k == 0) { model_torus(&mesh, 40, 17, true); }
        if (k == 1) { model_torus(&mesh, 100, 29, true); }
        if (k == 2) { model_torus(&mesh, 24, 12, false); }
        if (k == 3) { model_sphere(&mesh, 9, 16); }
        if (k == 4) { model_sphere(&mesh, 60, 90); }
        stage_open(&stage, &mesh, 120, 160);
        const unsigned frames = CHECK_SANITIZED ? 6 : 36;
        for (unsigned frame = 0; frame < frames; frame++) {
            view_options_t options = VIEW_OPTIONS_DEFAULT;
            options.has_ortho = frame % 5 == 4;
            options.ortho = 3.1;
            options.up[0] = 0.3;
            options.has_spin = true;
            options.spin = 360.0 / frames + 1.0 / 7;
            stage_aim(&stage, &options, 120, 160);
            view_frame(&stage.view, frame);
            check_fronts_cover_all(&stage, frame);
            if (k >= 3) {
                uint32_t *ids = frame_draw_ids(&stage.view.scene, 120, 160);
                assert_int_equal(enclosed_background(ids, 120, 160), 0);
                free(ids);
            }
        }
        stage_close(&stage);
    }
}

static void a_ball_cut_by_the_near_plane_has_no_holes(void **state) {
    const unsigned frames = CHECK_ROUNDS(64);
    stage_t stage;
    mesh_t mesh;
    unsigned cut = 0;
    (void)state;
    model_sphere(&mesh, 24, 40);
    stage_open(&stage, &mesh, 120, 160);
    stage.view.instance.two_sided = true;
    for (unsigned frame = 0; frame < frames; frame++) {
        view_options_t options = VIEW_OPTIONS_DEFAULT;
        const double away = 0.8 + 1.2 * (frame % 8) / 8;
        options.has_eye = options.has_at = options.has_near = true;
        options.eye[0] = away * cos(0.37 * frame);
        options.eye[1] = 0.2 * sin(0.9 * frame);
        options.eye[2] = away * sin(0.37 * frame);
        options.near = 0.35;
        options.fov = 90;
        stage_aim(&stage, &options, 120, 160);
        stage.view.instance.two_sided = true;
        const tuile_config_t config = {.width = 120, .height = 160, .format = TUILE_FACE_IDS};
        tuile_stats_t stats;
        uint32_t *ids = (uint32_t *)(void *)frame_draw(&stage.view.scene, &config, 1 << 20, &stats);
        cut += stats.faces_clipped > 0;
        assert_int_equal(enclosed_background(ids, 120, 160), 0);
        free(ids);
    }
    assert_true(cut > frames / 4);
    stage_close(&stage);
}

static void from_the_inside_of_a_closed_surface_no_background_is_seen(void **state) {
    (void)state;
    for (unsigned k = 0; k < 2; k++) {
        const unsigned frames = CHECK_ROUNDS(48);
        stage_t stage;
        mesh_t mesh;
        unsigned cut = 0;
        if (k == 0) { model_torus(&mesh, 60, 24, true); }
        if (k == 1) { model_sphere(&mesh, 24, 40); }
        stage_open(&stage, &mesh, 120, 160);
        for (unsigned frame = 0; frame < frames; frame++) {
            view_options_t options = VIEW_OPTIONS_DEFAULT;
            const double angle = 0.61 * frame;
            options.has_eye = options.has_at = options.has_near = true;
            options.eye[0] = cos(0.13 * frame) * (k == 0 ? 1.0 : 0.9);
            options.eye[2] = sin(0.13 * frame) * (k == 0 ? 1.0 : 0.9);
            options.at[0] = options.eye[0] + cos(angle);
            options.at[1] = 0.5 * sin(1.7 * frame);
            options.at[2] = options.eye[2] + sin(angle);
            options.near = 0.005;
            options.fov = 110;
            stage_aim(&stage, &options, 120, 160);
            stage.view.instance.two_sided = true;
            const tuile_config_t config = {.width = 120, .height = 160, .format = TUILE_FACE_IDS};
            tuile_stats_t stats;
            uint32_t *ids = (uint32_t *)(void *)frame_draw(&stage.view.scene, &config, 1 << 20, &stats);
            cut += stats.faces_clipped > 0;
            for (unsigned p = 0; p < 120 * 160; p++) {
                if (ids[p] == 0) { fail_msg("surface %u, frame %u: background at %u,%u", k, frame, p % 120, p / 120); }
            }
            free(ids);
        }
        assert_true(cut > 0);
        stage_close(&stage);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_surfaces_have_no_holes_in_any_frame_of_a_spin),
        cmocka_unit_test(a_ball_cut_by_the_near_plane_has_no_holes),
        cmocka_unit_test(from_the_inside_of_a_closed_surface_no_background_is_seen),
    };
    return cmocka_run_group_tests_name("closed", tests, NULL, NULL);
}
