/* The scene of the bench: camera at the origin looking along -z, vertical field of view 45 degrees, near 1, far 10; the model
 * turned about y by i * 360 / 8 degrees and moved to (0, 0, -3); one directional light along (-0.4, -0.6, -1), ambient 0.15,
 * diffuse 0.75. A model whose bounding sphere is not about 1 in radius is centred and scaled to 1, and the output says so.
 */
#ifndef BENCH_TURNTABLE_H
#define BENCH_TURNTABLE_H

#include "../../sim/view.h"

#define TURNTABLE_FRAMES 8

/* The scene for a window, but for the instance's place; it refers to itself: the view must stay where it is. */
void turntable_open(view_t *view, uint16_t width, uint16_t height);

/* The instance in frame `number`. Prints the scale where there is one, for frame 0. */
void turntable_place(tuile_instance_t *instance, const tuile_model_t *model, unsigned number);

#endif
