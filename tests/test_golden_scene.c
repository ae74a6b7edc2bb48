/* Golden pictures of scenes: an arm of parts that hang on one another, and a model between its key frames. tests/golden/scene.txt
 * holds their hashes. */
#include "support/check.h"
#include "support/cli.h"
#include "support/golden.h"
#include "support/models.h"

#include <math.h>
#include <unistd.h>

#define ARM                                                                                  \
    "tests/models/base.obj --add tests/models/link.obj,at=0,0.8,0,turn=0,0,25,parent=0"      \
    " --add tests/models/link.obj,at=0,2.2,0,turn=0,0,-80,scale=0.85,parent=1"               \
    " --add tests/models/link.obj,at=0,2.1,0,turn=20,0,-55,scale=0.5,parent=2,colour=40c0ff" \
    " --add tests/models/link.obj,at=0.3,2,0,turn=0,0,-25,scale=0.35,parent=3"               \
    " --add tests/models/link.obj,at=-0.3,2,0,turn=0,0,25,scale=0.35,parent=3 --rotate 90 --orbit 20,15,6.5 --at 0.2,1.8,0"

static const struct {
    const char *name, *arguments;
} pictures[] = {
    {"arm", ARM " --background 182030"},
    {"arm-turned", ARM " --background 182030 --frames 8"}, /* the last one */
    {"torus-at-first", "@/torus.obj --rotate 90 --morph @/wave.obj --morph-at 0 --shade gouraud --background 182030"},
    {"torus-between", "@/torus.obj --rotate 90 --morph @/wave.obj --morph-at 0.6 --shade gouraud --background 182030"},
    {"torus-in-the-end", "@/torus.obj --rotate 90 --morph @/wave.obj --shade gouraud --background 182030"},
};

/* The same torus, bent up and down three times on its way round. */
static void write_wave(void) {
    mesh_t mesh;
    model_torus(&mesh, 32, 14, false);
    model_write_obj(&mesh, cli_path("torus.obj"));
    for (size_t i = 0; i < mesh.position_count; i++) {
        double *p = mesh.positions[i];
        p[1] = 0.6 * p[1] + 0.45 * sin(3 * atan2(p[2], p[0]));
    }
    mesh.normal_count = 0;
    model_write_obj(&mesh, cli_path("wave.obj"));
    mesh_free(&mesh);
}

static void scenes_look_as_they_did(void **state) {
    golden_t golden;
    (void)state;
    write_wave();
    golden_open(&golden, "tests/golden/scene.txt");
    for (unsigned i = 0; i < CHECK_COUNT(pictures); i++) {
        char line[1024];
        sim_picture_t seen = {0};
        (void)snprintf(line, sizeof line, "render %s --out @/seen%%d.ppm", pictures[i].arguments);
        cli_good_silent(line);
        const bool several = strstr(line, "--frames 8") != NULL;
        assert_int_equal(sim_picture_read(&seen, cli_path(several ? "seen7.ppm" : "seen0.ppm"), NULL), 0);
        golden_picture(&golden, pictures[i].name, seen.rgb, (size_t)seen.width * seen.height * 3, &seen);
        sim_picture_free(&seen);
    }
    golden_close(&golden);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_look_as_they_did),
    };
    return cmocka_run_group_tests_name("golden_scene", tests, cli_set_up, cli_tear_down);
}
