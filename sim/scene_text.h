/* Text scenes: polygons typed by hand, for study, bug reports and cross-checks.
 *
 *   screen W H                     1 ... 1024 each; required
 *   camera ortho                   x, y are window coordinates, y down; one camera line is required
 *   camera persp F [NEAR]          eye at the origin, looking along +z; window = (CX + F X / Z, CY + YSIGN F Y / Z);
 *                                  near plane at Z = NEAR, 1 when not given; F > 0, NEAR > 0
 *   origin CX CY                   W / 2, H / 2 when not given; only a perspective camera uses it
 *   ysign 1|-1                     1 when not given; only a perspective camera uses it
 *   sample SX SY                   pixel (i, j) is sampled at (i + SX, j + SY); 0 0 when not given
 *   near min|max                   which z is in front; min when not given; only an orthographic camera uses it
 *   tie first|last                 which of two faces equally deep is seen; first when not given
 *   poly ID x,y,z x,y,z x,y,z ...  one face: planar, any shape, even-odd, 3 ... 255 corners; ID >= 1, need not be unique
 *
 * Lines come in any order, each kind but `poly` at most once. F, CX, CY, SX and SY are within +-16383. Numbers are decimals (-1.25)
 * or fractions (7/3) and are kept as they were written, without rounding. `#` starts a comment; a line may end in CR LF.
 */
#ifndef SIM_SCENE_TEXT_H
#define SIM_SCENE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../raster/tuile.h"
#include "error.h"
#include "mesh/mesh.h"

#define SCENE_TEXT_CORNERS_MAX 255 /* of a face: a model's cluster numbers its vertices in a byte */

/* A rational number in lowest terms; denominator > 0, numerator > INT64_MIN. */
typedef struct scene_number {
    int64_t numerator, denominator;
} scene_number_t;

typedef struct scene_poly {
    uint32_t id;        /* >= 1 */
    size_t first;       /* in scene_text_t.vertices */
    size_t count;       /* 3 ... SCENE_TEXT_CORNERS_MAX */
    unsigned long line; /* 1-based */
} scene_poly_t;

typedef struct scene_text {
    uint16_t width, height; /* pixels */
    tuile_projection_t projection;
    scene_number_t focal;     /* F, pixels; perspective only */
    scene_number_t near;      /* NEAR, scene units; perspective only */
    scene_number_t origin[2]; /* CX, CY, pixels; 0 0 for an orthographic camera, whatever the file says */
    int y_sign;               /* 1 or -1; 1 for an orthographic camera */
    scene_number_t sample[2]; /* SX, SY, pixels */
    bool near_max;            /* orthographic: the larger z is in front */
    bool tie_last;
    scene_poly_t *polys;           /* in the order of the file */
    size_t poly_count;             /* may be 0: background only */
    scene_number_t (*vertices)[3]; /* of all polys, one after the other */
    size_t vertex_count;
} scene_text_t;

/* Reads a scene from a file, or from stdin when path is "-". Returns 0, or -1 and one line in error that names the file, the line
 * and what is wrong with it; the scene is then empty. Release with scene_text_free. */
int scene_text_read(scene_text_t *scene, const char *path, sim_error_t *error);

/* The same from size bytes of memory, which may go away afterwards; name stands for the file in errors. */
int scene_text_parse(scene_text_t *scene, const char *text, size_t size, const char *name, sim_error_t *error);

void scene_text_free(scene_text_t *scene);

/* How scene coordinates became int16 steps. The step is a power of two, never finer than 2^-32 scene units. */
typedef struct scene_quantisation {
    int exponent;     /* one step is 2^exponent scene units */
    bool exact;       /* every coordinate is a whole number of steps */
    double error_max; /* largest change of a coordinate, scene units; 0 when exact */
} scene_quantisation_t;

/* Makes the mesh of a scene: face k is polys[k], in order, with source = k; positions in whole steps within +-32767. Compile it
 * with scene_text_mesh_options(), so that model units are steps. The step is the one nearest to 1 that holds every coordinate
 * exactly, and where there is none the finest that holds the largest coordinate, rounding half up. The mesh of an empty scene has
 * no faces. Release with mesh_free. Returns 0, or -1 and error (coordinates too large, out of memory; the mesh is then empty). */
int scene_text_mesh(const scene_text_t *scene, mesh_t *mesh, scene_quantisation_t *quantisation, sim_error_t *error);

/* Order kept (ties are decided by it), step 1, and no splitting: polygons are planar as typed, whatever rounding does to them. */
mesh_options_t scene_text_mesh_options(void);

/* How the model is to be drawn. Scenes are two-sided: set tuile_instance_t.two_sided. */
typedef struct scene_view {
    tuile_camera_t camera;
    tuile_pose_t pose; /* of the one instance; turns the scene's axes into Tuile's, by a reflection where need be */
    tuile_tie_t tie;   /* for tuile_config_t.tie */
    bool exact;        /* focal length, centre and near plane needed no rounding */
    double depth_step; /* orthographic: no less than one step of the 16-bit depth, scene units; 0 for a perspective camera */
} scene_view_t;

/* Camera and pose for the model that scene_text_mesh's mesh was compiled to.
 *
 * Exact always: model to view, which is a change of signs and a power of two. Exact when view->exact: the projection, as far as the
 * renderer's arithmetic keeps it. Otherwise F, CX + 1/2 - SX, CY + 1/2 - SY and NEAR in steps are rounded to 1/65536.
 * Perspective: world units are steps. No far plane exists in the text; far is the largest number a camera holds, beyond any vertex.
 * A NEAR beyond every vertex is moved to just before far, where it still cuts everything away.
 * Orthographic: world units are steps, or 2^n of them where distances would not fit; near and far stand off the scene's own range
 * of z by one step or 1/4096 of that range, whichever is more, so that no vertex lies on them and depth is as fine as can be.
 *
 * Returns 0, or -1 and error: orthographic coordinates so large that one step is 2^15 pixels or more. */
int scene_text_camera(const scene_text_t *scene, const scene_quantisation_t *quantisation, scene_view_t *view, sim_error_t *error);

#endif
