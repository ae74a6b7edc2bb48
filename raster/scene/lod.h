/* Level of detail: of several models of one thing that which suits the distance, and none when it is too far to be seen.
 *
 * The distance is that from the eye to the centre of the finest model's bounding sphere, compared exactly to 2^-55. At a border a
 * level is kept until the distance has left its range by hysteresis / 256 of the border, so that nothing flickers.
 */
#ifndef TUILE_SCENE_LOD_H
#define TUILE_SCENE_LOD_H

#include "../tuile.h"

#define TUILE_LOD_FRESH 255u /* a level that no frame has chosen yet */

typedef struct tuile_lod {
    const tuile_model_t *const *models; /* the finest first */
    const q16_16_t *reach;              /* up to which distance each is drawn, world units; > 0, ascending */
    uint8_t count;                      /* 1 ... 254 */
    uint8_t hysteresis;                 /* 0 = none */
} tuile_lod_t;

/* The level for a pose, 0 ... count - 1, or count where even the last is too far; or TUILE_ERROR_ARGUMENT. level: of the frame
 * before, or TUILE_LOD_FRESH. */
int tuile_lod_level(const tuile_lod_t *lod, const tuile_pose_t *pose, const tuile_camera_t *camera, uint8_t level);

#endif
