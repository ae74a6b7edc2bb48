/* What may look different from the frame before: of a scene in which a few things move before a camera that stands still, only the
 * tiles that they touch need to be drawn.
 *
 * Compared are the fields of the scene and of its instances. What they point to (models, materials of an instance, textures) is
 * taken for unchanged: whoever changes it calls tuile_changes_forget. Lights, lines, sprites and what else is not an instance
 * are remembered as a sum of 32 bits; when it differs everything is drawn. */
#ifndef TUILE_SCENE_CHANGES_H
#define TUILE_SCENE_CHANGES_H

#include "../tuile.h"

/* An instance as it was, the caller's memory. */
typedef struct tuile_change {
    tuile_instance_t before, now;
    bool moved;
} tuile_change_t;

typedef struct tuile_changes {
    tuile_change_t *instances; /* the caller's, as are the next two lines */
    uint16_t capacity;         /* of it; a scene with more instances is drawn whole */

    uint16_t count; /* of the scene */
    bool known;     /* there is a frame before */
    bool all;       /* everything may have changed */
    tuile_camera_t camera;
    uint32_t sum;
} tuile_changes_t;

/* Takes the frame before for unknown: the next one may differ everywhere. */
void tuile_changes_forget(tuile_changes_t *changes);

/* Compares the scene with the one of the last call, which is the frame that is on the glass. Call it once a frame, when tuile_begin
 * has accepted the scene. */
void tuile_changes_next(tuile_changes_t *changes, const tuile_scene_t *scene);

/* May pixels of this rectangle of the window differ from the frame before? Never false for one that does; may be true for one that
 * does not, since an instance is taken for its bounding sphere. */
bool tuile_changes_touch(const tuile_changes_t *changes, uint32_t x, uint32_t y, uint32_t width, uint32_t height);

#endif
