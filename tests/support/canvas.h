/* One face drawn through the frame's path, tile after tile, into a part of a window. */
#ifndef TESTS_SUPPORT_CANVAS_H
#define TESTS_SUPPORT_CANVAS_H

#include <stdbool.h>
#include <stdint.h>

#include "../../raster/fill/polygon.h"
#include "../../raster/fill/triangle.h"
#include "random.h"

/* A whole coordinate of the sources is the centre of a pixel here. */
#define CENTRE(c) (16 * (c) + 8)

#define CANVAS_PX 48
#define CANVAS_CORNERS_MAX 64

typedef struct canvas_face {
    vertex_t vertices[CANVAS_CORNERS_MAX];
    uint8_t corners[CANVAS_CORNERS_MAX]; /* corner i is vertices[corners[i]] */
    uint32_t count;
    bool as_triangle; /* three corners, counter-clockwise as seen, a topmost one first */
} canvas_face_t;

/* Part of a window: pixels left ... left + width - 1, top ... */
typedef struct canvas {
    int32_t left, top, width, height;
    uint16_t depth[CANVAS_PX * CANVAS_PX];
    uint32_t ids[CANVAS_PX * CANVAS_PX]; /* 0: not drawn */
} canvas_t;

typedef enum canvas_policy {
    CANVAS_CARRY,   /* the state goes from tile row to tile row */
    CANVAS_RESTART, /* set up again in every tile row */
    CANVAS_SKIP,    /* set up at the top of the face and skipped to the tile row */
    CANVAS_COUNT
} canvas_policy_t;

polygon_ring_t face_ring(const canvas_face_t *face);
const vertex_t *face_corner(const canvas_face_t *face, uint32_t i);

/* Twice the area: above 0 when a, b, c go counter-clockwise as seen. */
int32_t face_area(const vertex_t *a, const vertex_t *b, const vertex_t *c);

/* Corners in sixteenths of a pixel, all at one depth. */
canvas_face_t face_of_points(const int32_t (*points)[2], uint32_t count);

/* Turns a face of three corners into what triangle_start asks for. False when it has no area. */
bool face_to_triangle(canvas_face_t *face);

/* Clears the canvas and draws the face with value 1. Tiles start at the canvas's corner. Fails the test when pixels beside a tile
 * change. */
void canvas_draw_kind(const canvas_face_t *face, canvas_t *canvas, int32_t tile_width, int32_t tile_height, canvas_policy_t policy,
                      span_kind_t kind);

/* The same with SPAN_IDS. */
void canvas_draw(const canvas_face_t *face, canvas_t *canvas, int32_t tile_width, int32_t tile_height, canvas_policy_t policy);

/* Points of some kind in and round a window of `size` pixels, within +-limit. */
void canvas_random_points(random_source_t *random, int32_t (*points)[2], uint32_t count, int32_t size, int32_t limit);

#endif
