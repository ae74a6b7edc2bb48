#include "scenes.h"

#include "../raster/scene/camera.h"
#include "../raster/scene/sphere.h"

#define ALL_BUT_TREE (1u << TUILE_ZBUFFER | 1u << TUILE_SCANLINE | 1u << TUILE_WARNOCK | 1u << TUILE_PAINTER)
#define ALL (ALL_BUT_TREE | 1u << TUILE_TREE)

#define PERIOD 32u     /* a power of two: 65536 is a multiple of it */
#define RADIUS_BITS 10 /* of a turning model's bounding sphere, in world units: far from the ends of Q16.16 */

/* ---- a model that turns before the camera ------------------------------------------------------------------------- */

static int bits(uint64_t n) {
    int count = 0;

    for (; n; n >>= 1) {
        count++;
    }
    return count;
}

/* The power of two that brings the model's radius, step * radius, to [2^(RADIUS_BITS - 1), 2^RADIUS_BITS) world units. */
static tuile_scale_t scale_for(const tuile_model_t *model) {
    return (tuile_scale_t){1, RADIUS_BITS - bits((uint64_t)model->step.mantissa * model->radius) - model->step.exponent};
}

/* About the vertical through the centre of its bounding sphere, which stays at the origin and fits the window. */
static int turn(scene_stage_t *stage, bam16_t phase) {
    static const q16_16_t origin[3] = {0};
    static const bam16_t yaw = 3968, pitch = 2844, view = 8192; /* 21.8, 15.6 and 45 degrees */
    tuile_pose_t *pose = &stage->instance.pose;
    tuile_camera_t *camera = &stage->scene.camera;
    tuile_sphere_t sphere;
    int error;

    pose->scale = scale_for(&stage->model);
    tuile_rotation(pose->rotation, 1, phase);
    for (int i = 0; i < 3; i++) {
        pose->translation[i] = 0;
    }
    if ((error = tuile_sphere(&sphere, &stage->model, pose))) { return error; }
    for (int i = 0; i < 3; i++) {
        pose->translation[i] = -sphere.centre[i];
        sphere.centre[i] = 0;
    }
    camera->focal_x = camera->focal_y = tuile_focal_px(view, stage->width < stage->height ? stage->width : stage->height);
    if ((error = tuile_camera_orbit(camera, origin, TUILE_Q16(1), yaw, pitch, 0))) { return error; }
    return tuile_camera_fit(camera, &sphere, stage->width, stage->height);
}

/* ---- a room that the camera looks round in ------------------------------------------------------------------------- */

#if SCENES & SCENE_ROOM
/* World units are 1/256 m; the room is 4 x 2.5 x 6 m, the floor at y = 0. */
#define METRES(m) TUILE_Q16((m)*256)

static int look_round(scene_stage_t *stage, bam16_t phase) {
    static const q16_16_t middle[3] = {0, METRES(1), METRES(-0.5)};
    static const bam16_t sway = 7282, pitch = 910, view = 12743; /* 40 either way, 5 and 70 degrees */
    tuile_pose_t *pose = &stage->instance.pose;
    tuile_camera_t *camera = &stage->scene.camera;
    const int64_t swing = (int64_t)tuile_sin(phase) * sway;

    pose->scale = (tuile_scale_t){1, 8};
    tuile_rotation(pose->rotation, 1, 0);
    camera->focal_x = camera->focal_y = tuile_focal_px(view, stage->height);
    camera->near = METRES(0.125);
    camera->far = METRES(8);
    return tuile_camera_orbit(camera, middle, METRES(2.25), (bam16_t)(swing >> 30), pitch, 0);
}
#endif

/* ---- the list ---------------------------------------------------------------------------------------------------- */

#if SCENES & SCENE_CUBE
static const scene_script_t cube = {
    .name = "cube",
    .about = "a cube with a colour on each side, lit, turning",
    .model = "cube",
    .methods = ALL,
    .shade = TUILE_FLAT,
    .ram_kb = 2,
    .period = PERIOD,
    .set = turn,
};
#endif

#if SCENES & SCENE_ROOM
static const scene_script_t room = {
    .name = "room",
    .about = "a small room seen from inside, from one side to the other",
    .model = "room",
    .methods = ALL,
    .shade = TUILE_FLAT,
    .ram_kb = 2,
    .period = PERIOD,
    .set = look_round,
};
#endif

#if SCENES & SCENE_SPIDER
static const scene_script_t spider = {
    .name = "spider",
    .about = "a spider of 1 312 faces, lit, turning",
    .model = "spider",
    .methods = ALL_BUT_TREE,
    .shade = TUILE_GOURAUD,
    .ram_kb = 16,
    .period = PERIOD,
    .set = turn,
};
#endif

#if SCENES & SCENE_BUNNY
static const scene_script_t bunny = {
    .name = "bunny",
    .about = "a rabbit of 4 000 faces, lit, turning",
    .model = "bunny",
    .methods = ALL_BUT_TREE,
    .shade = TUILE_GOURAUD,
    .ram_kb = 256,
    .period = PERIOD,
    .set = turn,
};
#endif

#if SCENES & SCENE_MODEL
static const scene_script_t model = {
    .name = "model",
    .about = "a model of your own (--model FILE), lit, turning",
    .model = "model",
    .methods = ALL,
    .shade = TUILE_GOURAUD,
    .ram_kb = 16,
    .period = PERIOD,
    .set = turn,
};
#endif

const scene_script_t *const scenes[] = {
#if SCENES & SCENE_CUBE
    &cube,
#endif
#if SCENES & SCENE_ROOM
    &room,
#endif
#if SCENES & SCENE_SPIDER
    &spider,
#endif
#if SCENES & SCENE_BUNNY
    &bunny,
#endif
#if SCENES & SCENE_MODEL
    &model,
#endif
};

const uint8_t scene_count = sizeof scenes / sizeof scenes[0];

static bool same_text(const char *a, const char *b) {
    while (*a && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

const scene_script_t *scene_find(const char *name) {
    for (unsigned i = 0; i < scene_count; i++) {
        if (same_text(scenes[i]->name, name)) { return scenes[i]; }
    }
    return NULL;
}

/* ---- the stage --------------------------------------------------------------------------------------------------- */

int scene_open(scene_stage_t *stage, const scene_script_t *script, const void *bytes, size_t size_bytes, uint16_t width,
               uint16_t height) {
    int error;

    *stage = (scene_stage_t){.script = script, .width = width, .height = height};
    if ((error = tuile_model_open(&stage->model, bytes, size_bytes))) { return error; }
    stage->instance.model = &stage->model;
    /* Over the left shoulder, from above: (-2, -3, -6) / 7. */
    stage->light = (tuile_light_t){.direction = {-4681, -7022, -14043}, .intensity = 191};
    stage->scene.instances = &stage->instance;
    stage->scene.instance_count = 1;
    stage->scene.lights = &stage->light;
    stage->scene.light_count = 1;
    stage->scene.ambient = 48;
    stage->scene.camera.centre_x = (q16_16_t)width * 32768;
    stage->scene.camera.centre_y = (q16_16_t)height * 32768;
    return scene_frame(stage, 0);
}

void scene_configure(const scene_stage_t *stage, tuile_config_t *config) {
    config->shade = stage->script->shade;
    config->effects = stage->script->effects;
    config->cluster_vertices = stage->model.cluster_vertices_max;
    config->corners = stage->model.corners_max;
    config->tree_depth = stage->model.tree_depth;
}

int scene_phase(scene_stage_t *stage, bam16_t phase) { return stage->script->set(stage, phase); }

int scene_frame(scene_stage_t *stage, uint32_t frame) {
    const uint32_t period = stage->script->period;

    return scene_phase(stage, (bam16_t)(frame % period * (65536u / period)));
}
