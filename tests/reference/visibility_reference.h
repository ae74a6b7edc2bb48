/* Which face of a text scene is seen at which pixel, by exact arithmetic, and where a renderer with 1/16 pixel and 16 bits of depth
 * is free to differ.
 *
 * The answer. A face is at a pixel when the pixel's sample is inside its projection, even-odd, left and top edges in, right and
 * bottom edges out; the part of a face with Z < NEAR is cut off first (perspective). Of the faces there, the nearest on the ray
 * through the sample is seen; of faces equally near, the first or the last in the file, as the scene says. All of it is decided on
 * whole numbers of at most 127 bits; a scene whose coordinates would need more is refused. No code is shared with the renderer.
 *
 * The doubt. Let every edge be anywhere within a small displacement (each vertex is snapped), and let depths be known to about one
 * step. A face is then surely there, possibly there, or surely not there, and possibly seen when it may be there and nothing that
 * is surely there is clearly in front of it. A pixel with only one face possibly seen is without doubt: there a renderer must give
 * exactly the answer. Doubt is decided in floating point, on the safe side; the answer never is. */
#ifndef TESTS_REFERENCE_VISIBILITY_REFERENCE_H
#define TESTS_REFERENCE_VISIBILITY_REFERENCE_H

#include <stdbool.h>
#include <stdint.h>

#include "../../sim/error.h"
#include "../../sim/scene_text.h"

/* Zero = default. */
typedef struct visibility_options {
    double displacement_px; /* how far an edge may be off along x and along y; 0 = 1/16 */
    double depth_steps;     /* depths closer than this many steps are not told apart; 0 = 1.0625 */
    double depth_step;      /* orthographic: one step in scene units; 0 = the scene's range of z, widened as scene_text_camera
                               does, over 65472. Perspective depth is 65528 * NEAR / Z. */
} visibility_options_t;

typedef enum visibility_doubt {
    VISIBILITY_EDGE = 1,     /* another answer is possible because an edge passes close by */
    VISIBILITY_DEPTH = 2,    /* because two faces are about equally near */
    VISIBILITY_COPLANAR = 4, /* because two faces in one plane overlap here: the order decides */
} visibility_doubt_t;

typedef struct visibility_pixel {
    int32_t face;   /* index in scene_text_t.polys, -1 = background */
    unsigned doubt; /* of visibility_doubt_t, or-ed; 0 = none */
} visibility_pixel_t;

typedef struct visibility_reference visibility_reference_t;

/* Prepares a scene; options may be NULL. The scene need not outlive the call. Returns 0 and a reference to be released with
 * visibility_reference_free, or -1 and error: numbers too large to be exact, out of memory. */
int visibility_reference_make(visibility_reference_t **reference, const scene_text_t *scene, const visibility_options_t *options,
                              sim_error_t *error);

/* x, y: any pixel, also outside the window by up to its size. Uses scratch memory in the reference: one thread at a time. */
visibility_pixel_t visibility_reference_at(visibility_reference_t *reference, int x, int y);

/* Is face (-1 = background) possibly seen there? True for the answer itself, false for all others where there is no doubt. */
bool visibility_reference_allows(visibility_reference_t *reference, int x, int y, int32_t face);

void visibility_reference_free(visibility_reference_t *reference);

#endif
