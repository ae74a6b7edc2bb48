/* What a frame would take on a microcontroller: the events that it consists of, times the instructions of each, times the cycles of
 * an instruction. Events are counted on the host, by what a renderer tells anyway: its figures and its trace. Instructions of an
 * event are fitted to counted ones (predict_costs.c); cycles of an instruction are the profile's (mcu.h).
 *
 * The result is added to the clock of a simulated bus as the frame goes on, tile by tile, so that drawing and sending overlap there
 * as they do on the board. */
#ifndef SIM_PREDICT_H
#define SIM_PREDICT_H

#include <stdbool.h>
#include <stdint.h>

#include "../raster/tuile.h"
#include "bus.h"
#include "mcu.h"

/* Faces are of three kinds, which are drawn in ways of their own: triangles with sides below 32 pixels, that have a texture where
 * the renderer draws textures; other triangles; polygons. */
typedef enum predict_event {
    PREDICT_FRAME,
    PREDICT_CLUSTER,        /* looked at */
    PREDICT_VERTEX,         /* transformed */
    PREDICT_FACE_TESTED,    /* triangles of the clusters that were left */
    PREDICT_POLYGON_TESTED, /* the other faces: their share is taken to be that of the models */
    PREDICT_FACE_CLIPPED,   /* by near plane, far plane or guard band */
    PREDICT_FACE_BINNED,    /* handed to tiles */
    PREDICT_FACE_SET_UP,    /* edges and gradients, once more where they found no room */
    PREDICT_TILE,
    PREDICT_TILE_SAMPLE,   /* of tiles, cleared and sent */
    PREDICT_SMALL_IN_TILE, /* faces that have pixels in a tile */
    PREDICT_LARGE_IN_TILE,
    PREDICT_POLYGON_IN_TILE,
    PREDICT_SMALL_ROW, /* runs of samples of a face in a row */
    PREDICT_LARGE_ROW,
    PREDICT_POLYGON_ROW,
    PREDICT_SMALL_FRAGMENT, /* samples of faces, seen or hidden */
    PREDICT_LARGE_FRAGMENT,
    PREDICT_POLYGON_FRAGMENT,
    PREDICT_BYTE_SUMMED,     /* of tiles, for an update that sends changes only (firmware/update.h) */
    PREDICT_FACE_OF_TILE,    /* faces of the scene, once for each tile; and those of them that are clipped: what a renderer */
    PREDICT_CLIPPED_OF_TILE, /* takes that carries nothing from tile to tile (raster/compact/compact.h) */
    PREDICT_EVENT_COUNT
} predict_event_t;

typedef struct predict_events {
    uint64_t count[PREDICT_EVENT_COUNT];
} predict_events_t;

/* Instructions of one event, times 1000, of gcc 12 -O2: the z-buffer, RGB565, no anti-aliasing. Or of "compact", cycles of the
 * compact renderer on an ATmega328P, to black and white. */
typedef struct predict_costs {
    const char *core; /* as `make bench` names its targets */
    uint8_t shade;    /* tuile_shade_t */
    bool textured;    /* TUILE_SURFACES */
    uint32_t milli[PREDICT_EVENT_COUNT];
    uint8_t method; /* tuile_method_t */
} predict_costs_t;

extern const predict_costs_t predict_costs[], predict_costs_uno[]; /* predict_costs.c, predict_costs_uno.c: generated */
extern const unsigned predict_costs_count, predict_costs_uno_count;

/* Those of a profile's core that go with a configuration: by its method, its shading and whether it has effects. NULL: nobody has
 * counted them. */
const predict_costs_t *predict_costs_find(const sim_mcu_t *mcu, const tuile_config_t *config);

/* Instructions, to the nearest one; counts below 2^31 each do not overflow. */
uint64_t predict_instructions(const predict_costs_t *costs, const predict_events_t *events);

/* Nanoseconds that so many instructions take there, rounded up; below 2^33 instructions. */
uint64_t predict_ns(const sim_mcu_t *mcu, uint64_t instructions);

/* What of a configuration the costs do not cover, as "overlay, dithering" in text; false and "" when nothing. */
bool predict_leaves_out(const predict_costs_t *costs, const tuile_config_t *config, char *text, size_t size_bytes);

/* ---- counting ------------------------------------------------------------------------------------------------- */

/* Must not be moved: trace points to it. */
typedef struct predict_meter {
    tuile_trace_t trace; /* for tuile_config_t */
    const tuile_t *renderer;
    tuile_stats_t before;     /* what was taken already */
    uint64_t faces, polygons; /* of all instances */
    predict_events_t seen;
    bool in_frame, face_is_new;
    uint8_t kind; /* of the face: 0 small, 1 large, 2 polygon */
} predict_meter_t;

/* The trace must be in the configuration that the renderer is initialised with; until there is a renderer nothing is counted. */
void predict_meter_open(predict_meter_t *meter);

/* Before a frame: forgets what was counted and not taken. */
void predict_meter_begin(predict_meter_t *meter);

/* Events since the last call, or since the renderer began its frame; none outside of a frame. */
predict_events_t predict_meter_take(predict_meter_t *meter);

/* ---- a frame on the clock of a bus ------------------------------------------------------------------------------ */

typedef enum predict_bound {
    PREDICT_RENDER_BOUND = 0, /* drawing takes as long as the wire, or longer */
    PREDICT_BUS_BOUND = 1,
} predict_bound_t;

/* Zero: no prediction. Must not be moved while a bus works for it. */
typedef struct predict {
    const sim_mcu_t *mcu;
    const predict_costs_t *costs; /* NULL: nobody has counted them */
    predict_meter_t meter;
    const bool *summing;                   /* tiles are summed while it is true; NULL: never */
    uint64_t started_ns;                   /* of the bus's clock */
    predict_events_t events;               /* of the frame */
    uint64_t render_ns, wire_ns, frame_ns; /* of the last frame: drawing; the bus, gaps included; by the clock */
    uint64_t render_sum_ns, wire_sum_ns, frame_sum_ns;
    uint64_t lead_ns; /* of it, drawing before the first pixels of the frame go out */
    unsigned frames;
} predict_t;

/* Sets the meter up; its trace is then for the configuration. */
void predict_open(predict_t *predict, const sim_mcu_t *mcu);

/* From now on the bus's clock also counts what the renderer does, and the sums of an update (NULL: there is none). */
void predict_start(predict_t *predict, const tuile_t *renderer, const bool *summing, sim_bus_t *bus);

/* Around a frame. The bus's counts begin with the frame: target_begin_frame. */
void predict_frame_begin(predict_t *predict, const sim_bus_t *bus);
void predict_frame_end(predict_t *predict, const sim_bus_t *bus);

predict_bound_t predict_bound(uint64_t render_ns, uint64_t wire_ns);

/* How many times as long the longer of both takes; 0 when the shorter takes no time at all. */
double predict_ratio(uint64_t render_ns, uint64_t wire_ns);

/* "rp2040: 41.2 frames a second (24.27 ms), render-bound: drawing takes 1.8 times as long as the wire", of all frames so far. */
void predict_text(const predict_t *predict, char *text, size_t size_bytes);

#endif
