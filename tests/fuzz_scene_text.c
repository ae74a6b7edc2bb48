/* Any bytes as a text scene: read, quantised, given a camera and put to the exact reference. What must hold of every scene that is
 * taken is checked; overflow and bad accesses are left to the sanitizers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../sim/scene_text.h"
#include "reference/fuzz_driver.h"
#include "reference/scene_generator.h"
#include "reference/visibility_reference.h"

static void require(bool condition, const char *what) {
    if (!condition) {
        (void)fprintf(stderr, "fuzz_scene_text: %s\n", what);
        abort();
    }
}

static void look(const scene_text_t *scene) {
    visibility_reference_t *reference;
    sim_error_t error = {""};
    if (visibility_reference_make(&reference, scene, NULL, &error) < 0) {
        require(error.text[0] && !reference, "the reference refuses without a word");
        return;
    }
    for (int i = 0; i < 9; i++) {
        int x = (i % 3) * (scene->width - 1) / 2, y = (i / 3) * (scene->height - 1) / 2;
        visibility_pixel_t pixel = visibility_reference_at(reference, x, y);
        require(pixel.face >= -1 && pixel.face < (int32_t)scene->poly_count, "no such face");
        require(visibility_reference_allows(reference, x, y, pixel.face), "the answer is not allowed");
    }
    visibility_reference_free(reference);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    scene_text_t scene;
    sim_error_t error = {""};
    if (scene_text_parse(&scene, (const char *)bytes, size, "fuzz", &error) < 0) {
        require(error.text[0] != 0, "refused without a word");
        for (const char *c = error.text; *c; c++) {
            require(*c >= ' ' && *c <= '~', "the error is not printable");
        }
        require(!scene.polys && !scene.vertices, "a refused scene is not empty");
        return 0;
    }
    mesh_t mesh;
    scene_quantisation_t quantisation;
    scene_view_t view;
    require(scene_text_mesh(&scene, &mesh, &quantisation, &error) == 0, "no mesh");
    for (size_t i = 0; i < mesh.position_count; i++) {
        for (int c = 0; c < 3; c++) {
            require(mesh.positions[i][c] >= -32767 && mesh.positions[i][c] <= 32767, "a position out of range");
        }
    }
    require(quantisation.exact == (quantisation.error_max <= 0) || !quantisation.exact, "exact with an error");
    if (scene_text_camera(&scene, &quantisation, &view, &error) == 0) {
        require(view.camera.near > 0 && view.camera.near < view.camera.far, "near and far");
        require(view.camera.focal_x > 0 && view.camera.focal_y == view.camera.focal_x, "focal length");
    } else {
        require(scene.projection == TUILE_ORTHOGRAPHIC && error.text[0], "no camera");
    }
    free(mesh.positions);
    free(mesh.corners);
    free(mesh.faces);
    free(mesh.materials);
    look(&scene);
    scene_text_free(&scene);
    return 0;
}

#ifdef FUZZ_DRIVER
static char *seed(uint64_t n) { return scene_generate(n, NULL); }

int main(int argc, char **argv) { return fuzz_drive(argc, argv, seed); }
#endif
