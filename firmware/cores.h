/* One frame drawn by two cores: each draws a band of rows with a renderer in a block of its own, over the same scene, and sends its
 * tiles itself. Which of two ways shares the work better was measured: every other tile for each makes both transform all vertices;
 * bands let each drop the clusters of the other. The border between the bands moves from frame to frame, to where both would have
 * been busy for the same time.
 *
 * HAND-OVER. The display belongs to the core that holds the lock, from a tile's window until its write has returned; the bytes then
 * stay the display's until the next write of either core (hal/display.h), so each core needs two tile buffers and no more. A
 * frame goes over by two counters, each written by one core: frames asked for, frames done.
 *
 * The picture is that of one core, bit for bit, wherever the border is.
 */
#ifndef TUILE_FIRMWARE_CORES_H
#define TUILE_FIRMWARE_CORES_H

#include "stream.h"

/* What two cores, or two threads, have to agree by. */
typedef struct cores_port {
    void *context;
    void (*lock)(void *context); /* waits until it has the display */
    void (*unlock)(void *context);
    uint32_t (*now)(void *context); /* a clock that both see, of any unit; a frame takes less than 2^31. NULL: the border stays */
    /* Called again and again by a core that has nothing to do; returns when the other has called notify since, or at any
     * time. NULL: it asks all the time. */
    void (*pause)(void *context);
    void (*notify)(void *context); /* the other core has something to look at; NULL: nothing to be done for that */
} cores_port_t;

/* A core's part of it. */
typedef struct cores_half {
    tuile_t *renderer;
    void *block; /* 8-byte aligned */
    size_t block_bytes;
    tuile_stats_t stats; /* of the last frame: of this core's band */
    uint32_t busy;       /* how long it took, as now() counts */
    int result;
} cores_half_t;

/* All of it is the cores' own but what is said to be readable. It must not be moved. */
typedef struct cores {
    cores_half_t halves[2]; /* readable between frames, stats and busy */
    uint16_t border;        /* readable between frames: the first tile row of the second core */
    tuile_config_t config;
    tuile_display_t *display;
    const cores_port_t *port;
    const tuile_scene_t *scene;
    uint32_t asked, done; /* frames; from here on both cores look at them */
    uint32_t broken;      /* one of them has met an error */
    uint32_t closed;
} cores_t;

typedef struct cores_config {
    const tuile_config_t *renderer; /* as for tuile_stream_frame; buffers, row_first and row_end are set here */
    tuile_display_t *display;       /* initialised; outlives the cores */
    const cores_port_t *port;       /* outlives them too */
    void *blocks[2];                /* the renderers' memory, 8-byte aligned, and outlives them */
    size_t block_bytes[2];
} cores_config_t;

/* Before either core begins. 0 or an error of either kind (tuile_stream_error_text). */
int cores_open(cores_t *cores, const cores_config_t *config);

/* The second core: draws its band of each frame that is asked for, until cores_close. */
void cores_serve(cores_t *cores);

/* The first core: draws a frame with the second, and shows it. 0, or the first core's error, or else the second's. Whatever
 * happens, both renderers are ended and no buffer is on the wire when the call returns. */
int cores_frame(cores_t *cores, const tuile_scene_t *scene);

/* The first core, between frames: lets cores_serve return. */
void cores_close(cores_t *cores);

/* The next border of `rows` tile rows, given how long each side of this one took. border and the result: 1 ... rows - 1, or 1 of 1.
 * For tests.
 */
uint32_t cores_border(uint32_t border, uint32_t rows, uint32_t busy_first, uint32_t busy_second);

#endif
