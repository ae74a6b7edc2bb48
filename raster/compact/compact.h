/* Frames in one or two kilobytes: a second, smaller renderer for machines that have no room for the first.
 *
 * It draws what tuile_next draws, bit for bit, of a part of what that can: one instance of one model, in perspective, opaque faces
 * in flat white light, by z-buffer or by display tree, to MONO_PAGES. What it saves is code: nothing here is carried from tile to
 * tile, faces are filled by one way for all shapes, row by row with a division for each side, and are clipped again for each tile.
 * So a frame costs several times the instructions.
 *
 * What camera, pose and lights come to (a view) is made by the full renderer's arithmetic, tuile_compact_view: on the same machine,
 * or ahead, by a program on a host that writes views as constants, for scenes that come round. Then none of that arithmetic is on
 * the small machine.
 *
 * Clusters are not culled. Where the full renderer drops a cluster because it faces away, its faces are back faces here, but for
 * one that is seen from its edge and that snapping has turned to the front.
 */
#ifndef TUILE_COMPACT_COMPACT_H
#define TUILE_COMPACT_COMPACT_H

#include "../flash.h"
#include "../tuile.h"

#define TUILE_COMPACT_LIGHTS 2u
#define TUILE_COMPACT_CORNERS 12u /* of a face; clipped, 14 */

/* As transform_row_t (geometry/transform.h). */
typedef struct tuile_compact_row {
    int64_t t;
    int32_t m[3];
    int16_t low[3];
} tuile_compact_row_t;

/* An instance in front of a camera: what transform_make computes, as far as it is wanted here, under the same names. */
typedef struct tuile_compact_view {
    tuile_compact_row_t x, y, w;
    int64_t w_low, w_high;
    int32_t w_fast;
    uint32_t w_range; /* coarse w from w_fast on that are before the far plane */
    int32_t observer[3];
    int16_t observer_bits;
    int16_t lights[TUILE_COMPACT_LIGHTS][3];
    int16_t guard_x, guard_y;
    uint16_t background; /* luminance, 65535 = white */
    int8_t k;
    uint8_t depth_shift;
    uint8_t light_count, ambient;
    bool mirrored;
} tuile_compact_view_t;

/* The view of the scene's only instance in a window of width x height pixels. Fog, layers and overlays are not part of it.
 * TUILE_ERROR_EFFECTS: the scene asks for what is not drawn here; or what tuile_begin would say of it. */
int tuile_compact_view(tuile_compact_view_t *view, const tuile_scene_t *scene, uint16_t width, uint16_t height);

typedef struct tuile_compact_config {
    uint16_t width, height;           /* window, 8 ... TUILE_WINDOW_MAX_PX */
    uint16_t tile_width, tile_height; /* tile_height: a multiple of 8; 0 = the window's */
    uint8_t method;                   /* TUILE_ZBUFFER or TUILE_TREE */
} tuile_compact_config_t;

typedef struct tuile_compact_point {
    int16_t x, y; /* 1/16 pixel; x = INT16_MIN: outside */
} tuile_compact_point_t;

/* The renderer. It holds no pointer to itself; all fields are its own. */
typedef struct tuile_compact {
    tuile_compact_config_t config;
    tuile_compact_view_t view;
    const TUILE_FLASH uint8_t *positions, *fractions, *clusters, *faces, *face_normals, *materials, *tree; /* of the model */
    uint16_t vertex_count, face_count, tree_depth;
    tuile_compact_point_t *points; /* the block: vertices in the window, */
    uint32_t *depths;              /* their depths in 1/256 step, NULL: none are kept; */
    uint16_t *depth, *stack;       /* depth of the tile, or the walk through the tree; */
    uint8_t *bits;                 /* the tile */
    uint16_t left, top, right, bottom;
    uint16_t next_left, next_top;
} tuile_compact_t;

/* Bytes of the block, a constant expression: for a model of so many vertices and so deep a tree. */
#define TUILE_COMPACT_BYTES(method, vertices, tree_depth, tile_width, tile_height) \
    ((size_t)4 * (vertices) + (size_t)(tile_width) * (tile_height) / 8u +          \
     ((method) == TUILE_ZBUFFER ? (size_t)4 * (vertices) + (size_t)2 * (tile_width) * (tile_height) : (size_t)2 * (tree_depth)))

/* model: bytes that `tuile mesh` wrote, 4-byte aligned, which tuile_model_open accepts: they are not checked again. block: 4-byte
 * aligned; both outlive the renderer. TUILE_ERROR_ARGUMENT, TUILE_ERROR_MODEL (no model, or of another version), TUILE_ERROR_MEMORY
 * (the block), TUILE_ERROR_TREE, TUILE_ERROR_LIMITS (a face of more than TUILE_COMPACT_CORNERS corners;
 * more than 65535 vertices or faces) or TUILE_ERROR_EFFECTS (a material with two sides). */
int tuile_compact_open(tuile_compact_t *compact, const tuile_compact_config_t *config, const TUILE_FLASH uint8_t *model,
                       void *block, size_t block_bytes);

/* Begins a frame. The view is read here and not again. */
void tuile_compact_begin(tuile_compact_t *compact, const TUILE_FLASH tuile_compact_view_t *view);

/* Draws the next tile, in row-major order: 1 and the tile, whose bytes hold until the next call; 0: there is none left; or
 * TUILE_ERROR_LIMITS, when clipping has turned a face into one of more than 14 corners. */
int tuile_compact_next(tuile_compact_t *compact, tuile_tile_t *tile);

#endif
