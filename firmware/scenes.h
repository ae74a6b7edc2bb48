/* The scenes that every board and the simulator draw: one list, so that a frame on a board can be held against the simulator's.
 *
 * A script says what a scene needs and sets it up for any moment and any window, in fixed point only; a stage is where it is set
 * up. Boards differ in size, format and memory, never in a scene. A build takes a part of the list with -DSCENES=BITS.
 */
#ifndef TUILE_FIRMWARE_SCENES_H
#define TUILE_FIRMWARE_SCENES_H

#include "../raster/tuile.h"

#define SCENE_CUBE 1
#define SCENE_ROOM 2
#define SCENE_SPIDER 4
#define SCENE_BUNNY 8
#define SCENE_MODEL 16 /* any model */

#ifndef SCENES
#define SCENES 0x1f
#endif

typedef struct scene_script scene_script_t;

/* Where a scene is set up. Its fields point at one another: it must not be moved. */
typedef struct scene_stage {
    tuile_scene_t scene; /* for tuile_begin, once a frame has been set */
    tuile_instance_t instance;
    tuile_model_t model;
    tuile_light_t light;
    const scene_script_t *script;
    uint16_t width, height; /* of the window, pixels */
} scene_stage_t;

struct scene_script {
    const char *name;
    const char *about; /* one line */
    const char *model; /* name of the compiled model: the object model_NAME of a board, NAME.tuile for the simulator */
    uint8_t methods;   /* 1 << tuile_method_t, or-ed: those that can draw it. Without a display tree not TUILE_TREE */
    uint8_t shade;     /* tuile_shade_t */
    uint8_t effects;   /* tuile_effects_t, or-ed */
    uint16_t ram_kb;   /* of the smallest board that it is meant for */
    uint16_t period;   /* frames until it comes round */
    int (*set)(scene_stage_t *stage, bam16_t phase);
};

extern const scene_script_t *const scenes[];
extern const uint8_t scene_count;

/* By name; NULL when the build has none such. */
const scene_script_t *scene_find(const char *name);

/* Opens the model (4-byte aligned; the bytes outlive the stage) and sets frame 0 for a window of width x height pixels,
 * 1 ... TUILE_WINDOW_MAX_PX each. 0 or a tuile_error_t. */
int scene_open(scene_stage_t *stage, const scene_script_t *script, const void *bytes, size_t size_bytes, uint16_t width,
               uint16_t height);

/* What the scene wants of a renderer: shade, effects and the limits of its model. The other fields stay. */
void scene_configure(const scene_stage_t *stage, tuile_config_t *config);

/* Sets any frame, in any order: nothing is carried over from the one before. 0 or a tuile_error_t. */
int scene_frame(scene_stage_t *stage, uint32_t frame);

/* The same for any moment: a scene comes round in 65536 phases, whatever the time that a frame takes. Frame n is the phase
 * n * 65536 / period. */
int scene_phase(scene_stage_t *stage, bam16_t phase);

#endif
