/* Tuile beside Mesa's llvmpipe, which works in floating point, snaps vertices to 1/256 pixel and keeps 24 bits of depth. The same
 * compiled model, camera, window and textures go through both. Where the pictures differ, exact arithmetic tells why: the pixel
 * lies on the border of one of the faces that were drawn, or these are as near as one another, or its texel address lies on the
 * border of a texel. */
#include "mesa/gl.h"
#include "reference/exact_face.h"
#include "support/check.h"
#include "support/frame.h"
#include "support/models.h"

#include "../raster/pixel.h"
#include "../raster/surface/texture.h"
#include "../sim/picture.h"
#include "../sim/view.h"

#include <math.h>

#define WIDTH 320
#define HEIGHT 240
#define BORDER_PX (1 / 16.0L) /* snapped to 1/16 pixel a vertex moves by 0.045 at most; to 1/256, by 0.003 */

typedef struct compared {
    uint8_t *bytes;
    tuile_model_t model;
    view_t view;
    exact_face_t *faces;
    gl_triangle_t *triangles;
    gl_texture_t *textures;
    tuile_material_t *materials;
    gl_scene_t gl;
    bool snapped; /* Mesa gets the corners as they are snapped to 1/16 pixel */
} compared_t;

/* ---- the same scene for both ---- */

static void triangles_make(compared_t *c) {
    c->triangles = calloc(c->model.face_count, sizeof *c->triangles);
    assert_non_null(c->triangles);
    for (uint32_t f = 0; f < c->model.face_count; f++) {
        assert_true(c->faces[f].in_front);
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                c->triangles[f].position[i][k] = c->faces[f].corner[i].position[k];
            }
        }
        c->triangles[f].texture = -1;
        c->triangles[f].rgb = f + 1;
    }
}

static void compared_frame(compared_t *c, unsigned frame) {
    view_frame(&c->view, frame);
    free(c->faces);
    free(c->triangles);
    c->faces = exact_faces(&c->view.scene);
    triangles_make(c);
    exact_clip_matrix(&c->view.scene, WIDTH, HEIGHT, c->gl.clip);
    c->gl.triangles = c->triangles;
    c->gl.triangle_count = c->model.face_count;
}

/* Corners in view space, moved to where they are snapped to. */
static void triangles_snap(compared_t *c) {
    const tuile_camera_t *camera = &c->view.scene.camera;
    const double near = camera->near / 65536.0, far = camera->far / 65536.0;
    const double clip[4][4] = {
        {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, (far + near) / (far - near), -2 * far * near / (far - near)}, {0, 0, 1, 0}};
    memcpy(c->gl.clip, clip, sizeof clip);
    for (uint32_t f = 0; f < c->model.face_count; f++) {
        for (int i = 0; i < 3; i++) {
            const exact_corner_t *corner = &c->faces[f].corner[i];
            double *position = c->triangles[f].position[i];
            position[0] = (double)((2 * corner->snapped_x / WIDTH - 1) * corner->w);
            position[1] = (double)((1 - 2 * corner->snapped_y / HEIGHT) * corner->w);
            position[2] = (double)corner->w;
        }
    }
    c->snapped = true;
}

static void compared_open(compared_t *c, uint8_t *bytes, size_t size_bytes, const view_options_t *options, unsigned frames) {
    sim_error_t error = {""};
    memset(c, 0, sizeof *c);
    c->bytes = bytes;
    assert_int_equal(tuile_model_open(&c->model, bytes, size_bytes), 0);
    if (view_make(&c->view, options, &c->model, WIDTH, HEIGHT, frames, &error) != 0) { fail_msg("%s", error.text); }
    compared_frame(c, 0);
}

static void compared_close(compared_t *c) {
    for (size_t i = 0; c->textures && i < c->model.texture_count; i++) {
        free(c->textures[i].argb);
    }
    free(c->textures);
    free(c->materials);
    free(c->triangles);
    free(c->faces);
    free(c->bytes);
}

static uint8_t *spider_bytes(size_t *size_bytes) {
    const char *path = getenv("SPIDER");
    const mesh_options_t triangles = {.triangles = true};
    sim_error_t error = {""};
    uint8_t *bytes = NULL;
    assert_non_null(path);
    if (mesh_load(path, 0, &triangles, &bytes, size_bytes, NULL, &error) != 0) { fail_msg("%s", error.text); }
    return bytes;
}

static uint8_t *torus_bytes(size_t *size_bytes) {
    mesh_t mesh;
    uint8_t *bytes = NULL;
    sim_error_t error = {""};
    model_torus(&mesh, 48, 24, true);
    assert_int_equal(mesh_compile(&mesh, NULL, &bytes, size_bytes, NULL, &error), 0);
    mesh_free(&mesh);
    return bytes;
}

/* ---- faces ---- */

typedef struct tally {
    unsigned covered, differ, border, tie, texel;
    unsigned by_snap;     /* of `texel`: the corners' snap alone leads to another texel */
    long double farthest; /* from a border, of those that differ there, pixels */
} tally_t;

/* Both faces cover the pixel, and which of them is nearer changes with the snap of their corners or is told by rounding: either
 * depth is within 3/4 step of its plane, fill/triangle.h. */
static bool is_tie(const exact_face_t *a, const exact_face_t *b, uint32_t x, uint32_t y) {
    const long double before = exact_at(a, x, y, false).depth - exact_at(b, x, y, false).depth,
                      after = exact_at(a, x, y, true).depth - exact_at(b, x, y, true).depth;
    return fabsl(before) <= 1.5L || fabsl(after) <= 1.5L || (before < 0) != (after < 0);
}

/* ids: face + 1, 0 = background. */
static void explain_face(const compared_t *c, uint32_t ours, uint32_t theirs, uint32_t x, uint32_t y, tally_t *tally) {
    long double border = HUGE_VALL;
    if (ours) { border = exact_at(&c->faces[ours - 1], x, y, false).border; }
    if (theirs) { border = fminl(border, exact_at(&c->faces[theirs - 1], x, y, false).border); }
    if (border <= BORDER_PX) {
        tally->border++;
        tally->farthest = fmaxl(tally->farthest, border);
    } else if (ours && theirs && is_tie(&c->faces[ours - 1], &c->faces[theirs - 1], x, y)) {
        tally->tie++;
    } else {
        fail_msg("pixel %u,%u: face %u where Mesa has %u, %.4Lf pixel from their borders", x, y, ours, theirs, border);
    }
}

static void compare_faces(const compared_t *c, tally_t *tally) {
    uint32_t *ours = frame_draw_ids(&c->view.scene, WIDTH, HEIGHT), *theirs = gl_draw(&c->gl, WIDTH, HEIGHT);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        tally->covered += ours[i] || theirs[i];
        if (ours[i] == theirs[i]) { continue; }
        tally->differ++;
        explain_face(c, ours[i], theirs[i], i % WIDTH, i / WIDTH, tally);
    }
    free(ours);
    free(theirs);
}

static void tell(const char *name, const tally_t *tally) {
    print_message(
        "%s: %u pixels, %u differ (%.2f %%): %u at borders (%.4Lf pixel), %u ties, %u at texels, %u of them by the snap\n", name,
        tally->covered, tally->differ, 100.0 * tally->differ / tally->covered, tally->border, tally->farthest, tally->tie,
        tally->texel, tally->by_snap);
}

static void compare_views(const char *name, uint8_t *(*load)(size_t *), unsigned views) {
    const view_options_t options = VIEW_OPTIONS_DEFAULT;
    tally_t tally = {0};
    compared_t c;
    size_t size_bytes = 0;
    uint8_t *bytes = load(&size_bytes);
    compared_open(&c, bytes, size_bytes, &options, views);
    for (unsigned v = 0; v < views; v++) {
        compared_frame(&c, v);
        compare_faces(&c, &tally);
    }
    tell(name, &tally);
    assert_true(tally.covered > 10000);
    assert_true(100 * tally.differ <= 2 * tally.covered);
    compared_close(&c);
}

static void mesa_shows_the_same_faces_of_a_torus(void **state) {
    (void)state;
    compare_views("torus", torus_bytes, 8);
}

static void mesa_shows_the_same_faces_of_the_spider(void **state) {
    (void)state;
    compare_views("spider", spider_bytes, 8);
}

/* ---- texels ---- */

static void textures_make(compared_t *c) {
    c->textures = calloc(c->model.texture_count, sizeof *c->textures);
    assert_non_null(c->textures);
    for (uint32_t i = 0; i < c->model.texture_count; i++) {
        const tuile_texture_t from = tuile_model_texture(&c->model, i);
        gl_texture_t *to = &c->textures[i];
        *to = (gl_texture_t){from.width, from.height, calloc((size_t)from.width * from.height, sizeof *to->argb),
                             from.flags & TUILE_TEXTURE_CLAMP_S, from.flags & TUILE_TEXTURE_CLAMP_T};
        assert_non_null(to->argb);
        for (int32_t y = 0; y < from.height; y++) {
            for (int32_t x = 0; x < from.width; x++) {
                to->argb[y * from.width + x] = texture_texel(&from, x, y);
            }
        }
    }
    c->gl.textures = c->textures;
    c->gl.texture_count = c->model.texture_count;
}

/* Opaque, without light, and white where there is a texture. */
static void materials_make(compared_t *c) {
    c->materials = calloc(c->model.material_count, sizeof *c->materials);
    assert_non_null(c->materials);
    for (uint32_t m = 0; m < c->model.material_count; m++) {
        tuile_material_t *to = &c->materials[m];
        *to = tuile_model_material(&c->model, m);
        to->alpha = 255;
        to->blend = TUILE_BLEND_OVER;
        to->flags = TUILE_MATERIAL_UNLIT;
        to->specular = 0;
        memset(to->emission, 0, sizeof to->emission);
        if (to->texture != TUILE_NO_TEXTURE) { memset(to->colour, 255, sizeof to->colour); }
    }
    c->view.instance.materials = c->materials;
}

static void triangles_texture(compared_t *c) {
    for (uint32_t f = 0; f < c->model.face_count; f++) {
        const tuile_material_t *material = &c->materials[c->faces[f].material];
        gl_triangle_t *to = &c->triangles[f];
        to->rgb = PIXEL_RGB(material->colour[0], material->colour[1], material->colour[2]);
        if (material->texture == TUILE_NO_TEXTURE) { continue; }
        to->texture = material->texture;
        for (int i = 0; i < 3; i++) {
            to->st[i][0] = (double)(c->faces[f].corner[i].s / c->textures[to->texture].width);
            to->st[i][1] = (double)(c->faces[f].corner[i].t / c->textures[to->texture].height);
        }
    }
}

static bool is_within_a_step(uint32_t a, uint32_t b) {
    for (int shift = 0; shift <= 16; shift += 8) {
        const int most = shift == 8 ? 63 : 31;
        const int x = ((int)(a >> shift & 255) * most + 127) / 255, y = ((int)(b >> shift & 255) * most + 127) / 255;
        if (abs(x - y) > 1) { return false; }
    }
    return true;
}

/* By how much the address that is drawn may be off, beside the snap: texture.h. Affine, at most a quarter texel, and less where the
 * face is small or upright; and what is rounded. */
static long double bend(const exact_face_t *face) {
    long double least[3], most[3];
    for (int i = 0; i < 3; i++) {
        const exact_corner_t *c = &face->corner[i];
        const long double value[3] = {c->s, c->t, c->depth};
        for (int k = 0; k < 3; k++) {
            least[k] = i == 0 ? value[k] : fminl(least[k], value[k]);
            most[k] = i == 0 ? value[k] : fmaxl(most[k], value[k]);
        }
    }
    const long double across = fmaxl(most[0] - least[0], most[1] - least[1]);
    return fminl(0.25L, across * (most[2] - least[2]) / (4 * least[2])) + 1 / 16.0L;
}

/* Is there a texel of this colour, within a step, no farther from the address than that? */
static bool is_texel_near(const tuile_texture_t *texture, long double s, long double t, const long double by[2], uint32_t rgb) {
    for (int32_t y = (int32_t)floorl(t - by[1]); y <= (int32_t)floorl(t + by[1]); y++) {
        for (int32_t x = (int32_t)floorl(s - by[0]); x <= (int32_t)floorl(s + by[0]); x++) {
            if (is_within_a_step(texture_texel(texture, x, y), rgb)) { return true; }
        }
    }
    return false;
}

/* Ours must be a texel at the address through the corners as they were snapped, but for its stated error; Mesa's at the address
 * through those that it was given, but for its own snap, 1/512 pixel each way. So where they differ a border of texels lies
 * between.
 */
static void explain_texel(const compared_t *c, uint32_t id, uint32_t x, uint32_t y, uint32_t ours, uint32_t theirs,
                          tally_t *tally) {
    const exact_face_t *face = &c->faces[id - 1];
    const unsigned number = c->materials[face->material].texture;
    const bool differ = !is_within_a_step(ours, theirs);
    if (number == TUILE_NO_TEXTURE) {
        assert_true(!differ);
        return;
    }
    const tuile_texture_t texture = tuile_model_texture(&c->model, number);
    const exact_point_t exact = exact_at(face, x, y, c->snapped), snapped = exact_at(face, x, y, true),
                        right = exact_at(face, x + 1, y, c->snapped), below = exact_at(face, x, y + 1, c->snapped);
    const long double by = bend(face);
    const long double mesa[2] = {(fabsl(right.s - exact.s) + fabsl(below.s - exact.s)) / 128 + 1 / 64.0L,
                                 (fabsl(right.t - exact.t) + fabsl(below.t - exact.t)) / 128 + 1 / 64.0L};
    if (!is_texel_near(&texture, snapped.s, snapped.t, (const long double[2]){by, by}, ours)) {
        fail_msg("pixel %u,%u of face %u shows %06x, no texel near %.3Lf,%.3Lf", x, y, id, ours, snapped.s, snapped.t);
    }
    if (exact.inside && !is_texel_near(&texture, exact.s, exact.t, mesa, theirs)) {
        fail_msg("pixel %u,%u of face %u: Mesa shows %06x, no texel near %.3Lf,%.3Lf", x, y, id, theirs, exact.s, exact.t);
    }
    if (!differ) { return; }
    tally->texel++;
    tally->by_snap += floorl(exact.s) != floorl(snapped.s) || floorl(exact.t) != floorl(snapped.t);
}

static uint32_t *draw_textured(const compared_t *c) {
    const tuile_config_t config = {.width = WIDTH,
                                   .height = HEIGHT,
                                   .format = TUILE_RGB565_LE,
                                   .effects = TUILE_SURFACES,
                                   .texturing = TUILE_TEXTURE_NEAREST | TUILE_TEXTURE_NO_MIPS};
    uint8_t *bytes = frame_draw(&c->view.scene, &config, (size_t)4 << 20, NULL);
    uint32_t *picture = calloc((size_t)WIDTH * HEIGHT, sizeof *picture);
    assert_non_null(picture);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        picture[i] = pixel_unpack(PIXEL_RGB565_LE, (uint32_t)bytes[2 * i] | (uint32_t)bytes[2 * i + 1] << 8);
    }
    free(bytes);
    return picture;
}

/* Which face Mesa shows: the same triangles in colours that are their numbers. */
static uint32_t *gl_draw_ids(const gl_scene_t *scene) {
    gl_scene_t numbered = *scene;
    gl_triangle_t *triangles = calloc(scene->triangle_count, sizeof *triangles);
    assert_non_null(triangles);
    for (size_t f = 0; f < scene->triangle_count; f++) {
        triangles[f] = scene->triangles[f];
        triangles[f].texture = -1;
        triangles[f].rgb = (uint32_t)f + 1;
    }
    numbered.triangles = triangles;
    uint32_t *ids = gl_draw(&numbered, WIDTH, HEIGHT);
    free(triangles);
    return ids;
}

static void compare_texels(const compared_t *c, const uint32_t *ours, const uint32_t *theirs, tally_t *tally) {
    uint32_t *ids = frame_draw_ids(&c->view.scene, WIDTH, HEIGHT), *their_ids = gl_draw_ids(&c->gl);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const bool differ = !is_within_a_step(ours[i], theirs[i]);
        tally->covered += ids[i] || their_ids[i];
        tally->differ += differ;
        if (ids[i] != their_ids[i]) {
            if (differ) { explain_face(c, ids[i], their_ids[i], i % WIDTH, i / WIDTH, tally); }
        } else if (ids[i]) {
            explain_texel(c, ids[i], i % WIDTH, i / WIDTH, ours[i], theirs[i], tally);
        } else {
            assert_true(!differ);
        }
    }
    free(their_ids);
    free(ids);
}

/* Both pictures, for people. */
static void leave(const char *name, const char *by, const uint32_t *rgb) {
    const char *build = getenv("BUILD");
    char path[512];
    sim_picture_t picture;
    sim_error_t error = {""};
    (void)snprintf(path, sizeof path, "%s/%s-%s.png", build && *build ? build : "build", name, by);
    assert_int_equal(sim_picture_create(&picture, WIDTH, HEIGHT, &error), 0);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        for (int k = 0; k < 3; k++) {
            picture.rgb[3 * i + (size_t)k] = (uint8_t)(rgb[i] >> (16 - 8 * k));
        }
    }
    if (sim_picture_write(&picture, path, &error) != 0) { print_message("%s\n", error.text); }
    sim_picture_free(&picture);
}

static void textured_open(compared_t *c, const view_options_t *options, bool snapped) {
    size_t size_bytes = 0;
    uint8_t *bytes = spider_bytes(&size_bytes);
    compared_open(c, bytes, size_bytes, options, 1);
    assert_true(c->model.texture_count > 0);
    textures_make(c);
    materials_make(c);
    triangles_texture(c);
    if (snapped) { triangles_snap(c); }
}

/* The camera of `tuile render`, and two that come nearer. */
static const struct {
    const char *name;
    bool close;
    double eye[3], at[3];
} cameras[] = {
    {"spider", false, {0, 0, 0}, {0, 0, 0}},
    {"spider from above", true, {60, 80, 60}, {30, 20, -30}},
    {"spider, near", true, {30, 30, 60}, {0, 0, 0}},
    {"its abdomen", true, {60, 50, 40}, {40, 20, -20}},
};

static void compare_textured(unsigned camera, bool snapped, tally_t *tally) {
    view_options_t options = VIEW_OPTIONS_DEFAULT;
    char name[64];
    compared_t c;
    if (cameras[camera].close) {
        options.has_eye = options.has_at = options.has_near = true;
        memcpy(options.eye, cameras[camera].eye, sizeof options.eye);
        memcpy(options.at, cameras[camera].at, sizeof options.at);
        options.near = 1;
    }
    *tally = (tally_t){0};
    textured_open(&c, &options, snapped);
    uint32_t *ours = draw_textured(&c), *theirs = gl_draw(&c.gl, WIDTH, HEIGHT);
    (void)snprintf(name, sizeof name, "mesa-%u-%s", camera, snapped ? "snapped" : "own");
    leave(name, "tuile", ours);
    leave(name, "mesa", theirs);
    compare_texels(&c, ours, theirs, tally);
    (void)snprintf(name, sizeof name, "%s, %s", cameras[camera].name, snapped ? "corners of 1/16 pixel" : "corners of 1/256 pixel");
    tell(name, tally);
    free(ours);
    free(theirs);
    compared_close(&c);
}

/* Mesa gets the corners as Tuile snaps them: what is left is how both interpolate. */
static void mesa_shows_the_same_texels_through_the_same_corners(void **state) {
    tally_t tally;
    (void)state;
    compare_textured(0, true, &tally);
    assert_true(tally.covered > 5000);
    assert_true(100 * tally.differ <= 2 * tally.covered);
    for (unsigned i = 1; i < CHECK_COUNT(cameras); i++) {
        compare_textured(i, true, &tally);
        assert_true(tally.covered > 20000);
        assert_true(100 * tally.differ <= 3 * tally.covered); /* a texel is a pixel and more: a quarter texel is seen more often */
    }
}

/* Mesa keeps 1/256 pixel: where three texels come to a pixel a corner's snap to 1/16 pixel leads to another texel at every fifth
 * pixel. All others are as few as above. */
static void where_mesa_shows_other_texels_the_snap_of_corners_is_why(void **state) {
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(cameras); i++) {
        tally_t tally;
        compare_textured(i, false, &tally);
        assert_true(100 * (tally.texel - tally.by_snap) <= 3 * tally.covered);
        assert_true(100 * (tally.border + tally.tie) <= 2 * tally.covered);
    }
}

/* ---- what compiling does to a model ---- */

/* The faces as Assimp delivers them, in the model's steps, before they are rounded; polygons as fans. */
static gl_triangle_t *imported_triangles(const compared_t *c, const mesh_t *mesh, size_t *count) {
    const tuile_model_t *model = &c->model;
    const double step = ldexp((double)model->step.mantissa, model->step.exponent);
    gl_triangle_t *triangles = calloc(mesh->corner_count, sizeof *triangles), *to = triangles;
    assert_non_null(triangles);
    for (size_t f = 0; f < mesh->face_count; f++) {
        const mesh_face_t *face = &mesh->faces[f];
        const unsigned number = mesh->surfaces[face->material].texture;
        for (uint32_t p = 1; p + 1 < face->count; p++, to++) {
            const uint32_t corner[3] = {face->first, face->first + p, face->first + p + 1};
            const uint8_t *colour = mesh->materials[face->material];
            to->texture = number == TUILE_NO_TEXTURE ? -1 : (int)number;
            to->rgb = PIXEL_RGB(colour[0], colour[1], colour[2]);
            for (int i = 0; i < 3; i++) {
                for (int k = 0; k < 3; k++) {
                    to->position[i][k] = mesh->positions[mesh->corners[corner[i]]][k] / step - model->offset[k];
                }
                for (int k = 0; k < 2 && to->texture >= 0; k++) {
                    const gl_texture_t *texture = &c->textures[number];
                    to->st[i][k] = mesh->texcoords[corner[i]][k] / (k ? texture->height : texture->width);
                }
            }
        }
    }
    *count = (size_t)(to - triangles);
    return triangles;
}

/* Both by Mesa: positions rounded to 16 bits and coordinates to the bits of their material. */
static void compiling_a_model_moves_few_texels(void **state) {
    const view_options_t options = VIEW_OPTIONS_DEFAULT;
    compared_t c;
    mesh_t mesh;
    sim_error_t error = {""};
    unsigned covered = 0, differ = 0;
    (void)state;
    textured_open(&c, &options, false);
    if (mesh_import_with(&mesh, getenv("SPIDER"), NULL, &error) != 0) { fail_msg("%s", error.text); }
    gl_scene_t imported = c.gl;
    gl_triangle_t *triangles = imported_triangles(&c, &mesh, &imported.triangle_count);
    imported.triangles = triangles;
    uint32_t *compiled = gl_draw(&c.gl, WIDTH, HEIGHT), *whole = gl_draw(&imported, WIDTH, HEIGHT), *ids = gl_draw_ids(&c.gl);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        covered += ids[i] != 0;
        differ += !is_within_a_step(compiled[i], whole[i]);
    }
    leave("mesa-0", "imported", whole);
    print_message("spider, compiled and as it was imported: %u pixels, %u differ (%.2f %%)\n", covered, differ,
                  100.0 * differ / covered);
    assert_true(covered > 5000);
    assert_true(100 * differ <= 2 * covered);
    free(ids);
    free(compiled);
    free(whole);
    free(triangles);
    mesh_free(&mesh);
    compared_close(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mesa_shows_the_same_faces_of_a_torus),
        cmocka_unit_test(mesa_shows_the_same_faces_of_the_spider),
        cmocka_unit_test(mesa_shows_the_same_texels_through_the_same_corners),
        cmocka_unit_test(where_mesa_shows_other_texels_the_snap_of_corners_is_why),
        cmocka_unit_test(compiling_a_model_moves_few_texels),
    };
    return cmocka_run_group_tests_name("mesa", tests, NULL, NULL);
}
