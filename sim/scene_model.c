/* From the numbers of a text scene to the renderer's: steps of int16, camera, pose. */
#include "scene_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef __int128 int128_t;

enum {
    STEPS_MAX = 32767,
    EXPONENT_MIN = -32,
    EXPONENT_MAX = 62,
    DEPTH_STEPS = 65472
}; /* a few steps at the ends are the renderer's */

static int128_t floor_divide(int128_t a, int128_t b) { /* b > 0 */
    int128_t quotient = a / b;
    return quotient - (a % b < 0);
}

static int128_t absolute(int128_t a) { return a < 0 ? -a : a; }

/* Multiplies a fraction by 2^shift, -63 <= shift <= 63: both parts stay below 2^126. */
static void scale_fraction(scene_number_t number, int shift, int128_t *numerator, int128_t *denominator) {
    *numerator = (int128_t)number.numerator * (shift > 0 ? (int128_t)1 << shift : 1);
    *denominator = (int128_t)number.denominator * (shift < 0 ? (int128_t)1 << -shift : 1);
}

/* Is number a whole multiple of 2^exponent? */
static bool is_multiple(scene_number_t number, int exponent) {
    int128_t numerator, denominator;
    scale_fraction(number, -exponent, &numerator, &denominator);
    return numerator % denominator == 0;
}

static bool is_in_range(scene_number_t number, int exponent) {
    int128_t numerator, denominator;
    scale_fraction(number, -exponent, &numerator, &denominator);
    int128_t whole = absolute(numerator) / denominator; /* STEPS_MAX * denominator may not fit */
    return whole < STEPS_MAX || (whole == STEPS_MAX && absolute(numerator) % denominator == 0);
}

/* number / 2^exponent to the nearest whole number, halves up. */
static int32_t to_steps(scene_number_t number, int exponent) {
    int128_t numerator, denominator;
    scale_fraction(number, -exponent, &numerator, &denominator);
    int128_t steps = floor_divide(numerator, denominator), rest = numerator - steps * denominator;
    return (int32_t)(steps + (rest >= denominator - rest));
}

/* Every coordinate of the scene obeys test at this exponent. */
static bool all_coordinates(const scene_text_t *scene, int exponent, bool (*test)(scene_number_t, int)) {
    for (size_t i = 0; i < scene->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            if (!test(scene->vertices[i][k], exponent)) { return false; }
        }
    }
    return true;
}

static scene_quantisation_t quantise(const scene_text_t *scene) {
    scene_quantisation_t quantisation = {.exact = true};
    /* Nearest to 1: coarser only if the range asks for it, finer only if the fractions do. */
    while (quantisation.exponent < EXPONENT_MAX && !all_coordinates(scene, quantisation.exponent, is_in_range)) {
        quantisation.exponent++;
    }
    if (all_coordinates(scene, quantisation.exponent, is_multiple)) { return quantisation; }
    while (quantisation.exponent > EXPONENT_MIN && all_coordinates(scene, quantisation.exponent - 1, is_in_range)) {
        quantisation.exponent--;
        if (all_coordinates(scene, quantisation.exponent, is_multiple)) { return quantisation; }
    }
    quantisation.exact = false;
    for (size_t i = 0; i < scene->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            int128_t numerator, denominator;
            scale_fraction(scene->vertices[i][k], -quantisation.exponent, &numerator, &denominator);
            int128_t rest = numerator - floor_divide(numerator, denominator) * denominator;
            double part = (double)rest / (double)denominator, error = ldexp(part < 0.5 ? part : 1 - part, quantisation.exponent);
            quantisation.error_max = error > quantisation.error_max ? error : quantisation.error_max;
        }
    }
    return quantisation;
}

int scene_text_mesh(const scene_text_t *scene, mesh_t *mesh, scene_quantisation_t *quantisation, sim_error_t *error) {
    *mesh = (mesh_t){0};
    *quantisation = quantise(scene);
    if (scene->vertex_count > UINT32_MAX || scene->poly_count > UINT32_MAX) {
        return sim_fail(error, "the scene has more vertices than a model can count");
    }
    size_t vertices = scene->vertex_count ? scene->vertex_count : 1, polys = scene->poly_count ? scene->poly_count : 1;
    mesh->positions = calloc(vertices, sizeof *mesh->positions);
    mesh->corners = calloc(vertices, sizeof *mesh->corners);
    mesh->faces = calloc(polys, sizeof *mesh->faces);
    mesh->materials = calloc(1, sizeof *mesh->materials);
    if (!mesh->positions || !mesh->corners || !mesh->faces || !mesh->materials) {
        free(mesh->positions);
        free(mesh->corners);
        free(mesh->faces);
        free(mesh->materials);
        *mesh = (mesh_t){0};
        return sim_fail(error, "out of memory");
    }
    mesh->position_count = mesh->corner_count = scene->vertex_count;
    mesh->face_count = mesh->source_face_count = scene->poly_count;
    mesh->material_count = 1;
    memset(mesh->materials[0], 255, sizeof mesh->materials[0]);
    for (size_t i = 0; i < scene->vertex_count; i++) {
        mesh->corners[i] = (uint32_t)i;
        for (int k = 0; k < 3; k++) {
            mesh->positions[i][k] = to_steps(scene->vertices[i][k], quantisation->exponent);
        }
    }
    for (size_t i = 0; i < scene->poly_count; i++) {
        mesh->faces[i] = (mesh_face_t){
            .first = (uint32_t)scene->polys[i].first, .count = (uint32_t)scene->polys[i].count, .source = (uint32_t)i};
    }
    return 0;
}

mesh_options_t scene_text_mesh_options(void) {
    return (mesh_options_t){.keep_order = true, .keep_planar = true, .step = 1, .two_sided = true};
}

/* number * 2^60, rounded down; |number| <= 2^14. *exact is cleared when there was anything to round. */
static int128_t to_fixed60(scene_number_t number, bool *exact) {
    int128_t scaled = (int128_t)number.numerator * ((int128_t)1 << 60);
    if (scaled % number.denominator != 0) { *exact = false; }
    return floor_divide(scaled, number.denominator);
}

/* The nearest q16.16, halves up, of a fixed-point number with 60 fractional bits and |value| <= 2^15 - 1. */
static q16_16_t fixed60_to_q16(int128_t value, bool *exact) {
    const int128_t unit = (int128_t)1 << 44;
    if (value % unit != 0) { *exact = false; }
    return (q16_16_t)floor_divide(value + unit / 2, unit);
}

static void axes(tuile_pose_t *pose, int y, int z) {
    pose->rotation[0][0] = TUILE_ONE_Q30;
    pose->rotation[1][1] = y * TUILE_ONE_Q30;
    pose->rotation[2][2] = z * TUILE_ONE_Q30;
}

static void perspective(const scene_text_t *scene, int exponent, scene_view_t *view) {
    tuile_camera_t *camera = &view->camera;
    axes(&view->pose, -scene->y_sign, -1);
    view->pose.scale = TUILE_SCALE_ONE;
    camera->focal_x = camera->focal_y = fixed60_to_q16(to_fixed60(scene->focal, &view->exact), &view->exact);
    if (camera->focal_x < 1) { camera->focal_x = camera->focal_y = 1; }

    int128_t numerator, denominator;
    scale_fraction(scene->near, 16 - exponent, &numerator, &denominator);
    int128_t near = floor_divide(numerator, denominator), rest = numerator - near * denominator;
    if (near > INT32_MAX - 1) { /* beyond every vertex, as it was */
        near = INT32_MAX - 1;
    } else if (rest) {
        near += rest >= denominator - rest;
        view->exact = false;
    }
    camera->near = near < 1 ? 1 : (q16_16_t)near;
    camera->far = INT32_MAX;
}

static int orthographic(const scene_text_t *scene, int exponent, scene_view_t *view, sim_error_t *error) {
    tuile_camera_t *camera = &view->camera;
    int sign = scene->near_max ? 1 : -1; /* view z of the scene's z: larger is nearer */
    axes(&view->pose, -1, sign);
    int64_t front = 0, back = 0; /* largest and least view z, steps */
    for (size_t i = 0; i < scene->vertex_count; i++) {
        int64_t z = sign * (int64_t)to_steps(scene->vertices[i][2], exponent);
        front = i == 0 || z > front ? z : front;
        back = i == 0 || z < back ? z : back;
    }
    /* One world unit is 2^shrink steps: enough of them for distances to fit (below 2^15 units), and for one unit to be at least
     * 2^-16 pixels. A shrink of up to 16 leaves whole steps exact in q16.16, and 2^-32 <= step makes 16 enough. */
    for (int shrink = exponent < -16 ? -16 - exponent : 0; shrink <= 16 && exponent + shrink <= 14; shrink++) {
        int64_t unit = 65536 >> shrink; /* one step, q16.16 */
        int64_t range = (front - back) * unit, margin = range / 4096 > unit ? range / 4096 : unit;
        int64_t far = unit + 2 * margin + range, eye = front * unit + unit + margin;
        if (far > INT32_MAX || eye > INT32_MAX || eye < -INT32_MAX) { continue; }
        view->pose.scale = (tuile_scale_t){1, -shrink};
        camera->focal_x = camera->focal_y = (q16_16_t)1 << (16 + exponent + shrink);
        camera->eye[2] = (q16_16_t)eye;
        camera->near = (q16_16_t)unit;
        camera->far = (q16_16_t)far;
        view->depth_step = ldexp((double)(2 * margin + range), exponent + shrink - 16) / DEPTH_STEPS;
        return 0;
    }
    return sim_fail(error, "the scene's coordinates are too large for an orthographic camera: one int16 step is 2^%d pixels",
                    exponent);
}

int scene_text_camera(const scene_text_t *scene, const scene_quantisation_t *quantisation, scene_view_t *view, sim_error_t *error) {
    *view = (scene_view_t){.exact = true, .tie = scene->tie_last ? TUILE_TIE_LAST : TUILE_TIE_FIRST};
    tuile_camera_t *camera = &view->camera;
    camera->projection = scene->projection;
    for (int i = 0; i < 3; i++) {
        camera->rotation[i][i] = TUILE_ONE_Q30;
    }
    /* The text samples pixel i at i + SX, Tuile at i + 1/2: the picture moves by the difference. */
    const int128_t half = (int128_t)1 << 59;
    q16_16_t centre[2];
    for (int i = 0; i < 2; i++) {
        centre[i] = fixed60_to_q16(to_fixed60(scene->origin[i], &view->exact) + half - to_fixed60(scene->sample[i], &view->exact),
                                   &view->exact);
    }
    camera->centre_x = centre[0];
    camera->centre_y = centre[1];
    if (scene->projection == TUILE_ORTHOGRAPHIC) { return orthographic(scene, quantisation->exponent, view, error); }
    perspective(scene, quantisation->exponent, view);
    return 0;
}
