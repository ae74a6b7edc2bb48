/* The inside of a renderer: how the caller's block is laid out, and the lists that lead from faces to tiles.
 *
 *   block: | tuile_t | tile memory of the method | colours 0 | colours 1 | buckets | arena ...                        |
 *   arena: | shading ramps | tree memory | vertices ->   <- carried states moved up          <- records (from the end) |
 *
 * A record is one face of the pass. Records are numbered in the order of the faces, so their numbers decide ties; or, where faces
 * are painted over one another without depth, in the order of painting. Each hangs in the bucket of the tile row where it starts;
 * from there on its state is carried in a stream between vertices and records, in the same order, or, where there is no room for
 * that, the record moves on to the next bucket and is set up again there.
 */
#ifndef TUILE_FRAME_FRAME_H
#define TUILE_FRAME_FRAME_H

#include "../features.h"
#include "../fill/polygon.h"
#include "../fill/textured.h"
#include "../fill/triangle.h"
#include "../geometry/clip.h"
#include "../geometry/cull.h"
#include "../geometry/lamp.h"
#include "../geometry/model.h"
#include "../geometry/transform.h"
#include "../geometry/vertex.h"
#include "../features.h"
#include "../pixel.h"
#include "../surface/fog.h"
#include "../surface/textured.h"
#include "../tuile.h"

#define RAMP_COLOURS 64
#define RAMP_BYTES (RAMP_COLOURS * 2)
#define RAMP_FLAT_COLOURS 256 /* flat shading: one for each light */
#define RAMP_FLAT_BYTES (RAMP_FLAT_COLOURS * 2)
#define RECORD_NONE 0 /* `next` holds a record's number + 1 */

/* v0 is the slot of a topmost vertex, d1 and d2 lead from it to the others, in counter-clockwise order. d1 = 0: v0 is the slot of a
 * polygon_slot_t, or, with d2 = 1, of a piece_slot_t. */
typedef struct record {
    uint16_t next;
    uint16_t v0;
    int8_t d1, d2;
    uint8_t material; /* frame_counts_materials: counted through the models of the scene */
    uint8_t light;    /* flat shading */
} record_t;

/* TUILE_FACE_IDS wants the id too. */
typedef struct record_id {
    record_t record;
    uint32_t id;
} record_id_t;

/* Deferred shading wants to know where the corners' attributes are. */
typedef struct record_surface {
    record_t record;     /* flat, coloured light: `light` is red */
    uint16_t source;     /* slot of a source_slot_t */
    uint8_t green, blue; /* flat, coloured light */
} record_surface_t;
_Static_assert(sizeof(record_surface_t) == sizeof(record_id_t), "records are copied as the larger of both");

/* Stands right before the vertices of a cluster, or of a clipped face, where shading is deferred: what their attributes are. */
typedef struct source_slot {
    uint32_t first_vertex; /* of the model: that of the first slot behind this one */
    uint16_t instance;
    uint16_t colours;     /* slot of the light at the vertices: 4 bytes each, red, green, blue, highlight, 255 = 1.0; 0: light is
                             the vertex's own number */
    uint16_t attributes;  /* clipped: slot of the vertices' clip_attributes_t; 0: they are the model's */
    uint16_t is_coloured; /* clipped: attributes have light */
    uint32_t unused;
} source_slot_t;
#define SOURCE_SLOTS 2u

/* Heads a polygon among the vertices: `count` corners; listed, as bytes relative to slot `base`, in the slots behind this one, or,
 * for a clipped polygon, the `count` vertices from slot `base` on. */
typedef struct polygon_slot {
    uint16_t count, base;
    uint16_t listed, unused;
} polygon_slot_t;
_Static_assert(sizeof(vertex_t) == 8 && sizeof(polygon_slot_t) == 8 && sizeof(record_t) == 8, "one slot");
_Static_assert(sizeof(source_slot_t) == 16 && sizeof(clip_attributes_t) == 16, "two slots");

/* Where a face may be seen: pixels left ... right - 1, top ... bottom - 1; depths from far to near in 1/256 step, near the larger.
 */
typedef struct face_bounds {
    int16_t left, top, right, bottom;
    uint32_t far, near;
} face_bounds_t;

/* Heads a piece of a face that was cut (visibility/piece.h): those pixels of the face within `bounds` that all cuts keep. */
typedef struct piece_slot {
    face_bounds_t bounds; /* `far` is that of the whole face */
    uint16_t v0;          /* v0, d1 and d2 of the face's record */
    int8_t d1, d2;
    uint16_t number; /* of the face's record before records were put in order: decides ties */
    uint16_t cuts;   /* slot of the last cut, 0: none */
    uint16_t count;  /* corners of the ring, whose hull holds the piece: the vertices behind this slot */
    uint16_t unused[3];
} piece_slot_t;

/* Those pixels where the face that is cut is seen before this other face, or else those where it is not. */
typedef struct cut_slot {
    uint16_t v0; /* of the other face's record */
    int8_t d1, d2;
    uint16_t next;           /* the cut before, 0: none */
    uint8_t front, wins_tie; /* the side; whether the face that is cut is seen where both are equally deep */
} cut_slot_t;
_Static_assert(sizeof(piece_slot_t) == 32 && sizeof(cut_slot_t) == 8, "whole slots");

enum { FRAME_OK = 0, FRAME_FULL = 1 }; /* FULL: the arena is; negative: tuile_error_t */

/* A hidden-surface method: what a frame asks of it. t->tile is the tile that is being drawn. */
typedef struct visibility_method {
    /* Bytes beside the colours of a tile that must be there for as long as the renderer is; NULL: none. They lie at t->tile_memory,
     * 64-byte aligned; nobody but the method writes there. */
    size_t (*tile_bytes)(const tuile_config_t *config);
    /* Memory of the method for the frame, taken from the start of the arena: *arena moves on, by multiples of 8. NULL: none. */
    int (*begin)(tuile_t *t, uint8_t **arena);
    /* Faces of the pass into records. */
    int (*gather)(tuile_t *t);
    /* Before each tile, beside its background; NULL: nothing. */
    void (*clear)(tuile_t *t);
    /* Immediate pass: the face of a record into the tile; the record goes away after the call. NULL: the method needs all faces of
     * a tile at once. */
    void (*draw_now)(tuile_t *t, uint32_t number);
    /* All faces of tile row `row` into the tile, one of that row's columns; rows do not go back within a pass. FULL: the free room
     * between vertices and records was too small; it is called again, with a clear tile, in a smaller pass. */
    int (*draw_tile)(tuile_t *t, uint16_t row);
    /* The free room that suffices to draw a tile of so many records; NULL: none is needed. */
    size_t (*room_bytes)(const tuile_config_t *config, uint32_t records);
    /* What a face of so many corners may want besides; NULL: nothing. */
    size_t (*face_bytes)(uint32_t corners);
    /* For those who watch: the pixels of a piece in a row (visibility/piece.h); NULL: the method cuts no faces. */
    void (*piece_mask)(const tuile_t *t, const record_t *record, int32_t y, int32_t from, int32_t to, uint32_t *mask);
} visibility_method_t;

extern const visibility_method_t visibility_zbuffer; /* visibility/zbuffer.c, and so on */
extern const visibility_method_t visibility_scanline;
extern const visibility_method_t visibility_warnock;
extern const visibility_method_t visibility_painter;
extern const visibility_method_t visibility_tree;

typedef struct tuile {
    const visibility_method_t *method;
    tuile_config_t config; /* in samples: window and tiles are as many times as large as there are samples along them */
    tuile_config_t given;  /* the same in pixels */
    const tuile_scene_t *scene;
    tuile_stats_t stats;
    void *tile_memory;
    uint8_t *colours[2]; /* wire bytes */
    void *working;       /* samples of a tile; NULL: they are the wire bytes */
    uint16_t *numbers;   /* deferred shading: which face is seen at each sample, its record's number + 1; else NULL */
    uint8_t samples;     /* log2 of those along a pixel */
    uint8_t pixel_kind;  /* pixel_kind_t */
    uint16_t *buckets;   /* one per tile row of the window */
    uint8_t *arena, *arena_end;
    uint16_t tile_columns, tile_rows;
    uint8_t record_bytes;
    uint8_t next_buffer;
    /* Ramps, at the start of the arena: ramp m % ramp_count holds material ramp_tags[m % ramp_count]. Flat shading may have none.
     */
    uint16_t *ramps;
    int16_t *ramp_tags;
    uint16_t ramp_count;
    bool ramps_few;        /* fewer than there are materials */
    uint32_t background;   /* a sample */
    tuile_camera_t camera; /* the scene's, in samples */
    /* Layers (layer/layer.h). */
    uint16_t *layer_depth; /* of the opaque faces of the tile */
    void *layer_samples;   /* layer_sample_t: layer_rows of the tile; NULL: no layers */
    struct layer_band *layer_band;
    uint32_t layer_number;  /* faces that come one by one */
    uint32_t passing_bytes; /* the pass: the most that vertices and records took, with those that were given up again */
    uint32_t *translucent;  /* materials of the instance, as 256 bits */
    uint16_t layer_rows;
    uint8_t layer_part; /* LAYER_PART_...: which faces are binned */
    uint8_t sift;       /* SIFT_...: the same for this instance */
    /* Display trees. */
    uint32_t *tree_stack;     /* config.tree_depth */
    uint16_t *instance_order; /* visibility/arrange.h */
    uint16_t *cluster_slots;  /* of the instance that is being walked: where each cluster's vertices stand */
    /* Key frames: frame/morph.c. */
    uint8_t *morph_scratch;
    uint16_t morph_vertices; /* that it has room for */
    /* Coloured light, and fog. */
    lamps_t *lamps;      /* of the current instance; NULL: no instance of the frame wants them */
    bool coloured_scene; /* all instances want them */
    bool backs;          /* some instance is mixed: */
    bool mixed;          /* some of the current instance's materials are seen from behind, others may not be */
    bool coloured;       /* the current instance wants lamps */
    bool careful;        /* frame_lights_face is to be called for each face */
    fog_t fog;
    const struct frame_lit_face *lit; /* the face that is being binned, where careful */
    bool keep;                        /* no immediate passes in this frame */
    bool immediate_only;              /* no others */
    /* The pass. */
    vertex_t *vertices;
    uint8_t *states; /* where the stream of states may begin: after the vertices */
    uint32_t vertex_count, vertex_limit;
    uint32_t record_count;
    uint16_t pass_first, pass_end; /* tile rows */
    uint16_t pass_column;          /* narrow pass: its only column */
    uint16_t rows_hint;            /* tile rows that fitted last time; 0: only a narrow pass did */
    bool narrow;                   /* the pass covers one tile */
    bool shrunk;                   /* a pass of this frame proved too large when it was drawn */
    bool immediate;                /* narrow, and faces are drawn as they come, by draw_now */
    void (*draw_now)(tuile_t *t, uint32_t number);
    size_t wanted_bytes;  /* of the last call that failed for lack of memory */
    uint32_t counted;     /* faces, while that is found out */
    uint32_t cluster_end; /* vertices from here on were made by clipping */
    bool in_frame, pass_valid;
    transform_region_t region;
    transform_t transform;
    const tuile_instance_t *instance;
    uint8_t sides;          /* SIDE_...: which sides of faces are wanted */
    bool numbered;          /* some face of the tile is drawn as a number: they were cleared */
    bool columned;          /* small triangles are in lists by column (visibility/columns.h) */
    bool small;             /* all triangles of the pass have short sides (fill/edge.h) and touch no column outside of its region */
    uint32_t face_base;     /* id of the first face of the instance */
    uint16_t material_base; /* of the instance's model, where materials are counted, else 0 */
    uint16_t instance_number;
    uint16_t source; /* of the faces that are being binned */
    /* Textured faces may be drawn at once: the method has depth, samples are RGB565, and there is no fog. */
    bool textured;
    bool textured_any;                           /* some face of the frame was */
    uint16_t textured_instance, textured_number; /* the material that was asked for last */
    uint32_t textured_source; /* a source of vertices, and a material << 16, whose faces may be, or a bit tells that they may not;
                                 UINT16_MAX: none */
    textured_material_t textured_last;
    const uint8_t *textured_texcoords; /* of slot 0 */
    raster_tile_t tile;
    span_kind_t span_kind;
    /* The row of tiles that is being drawn. */
    uint16_t row;                 /* whose buckets and states are current */
    uint16_t uncarried;           /* list of records that must be set up in each row */
    bool row_ready;               /* several columns: all faces of the row are in the stream or in `uncarried` */
    uint32_t next_tile;           /* in row-major order */
    uint8_t *stream, *stream_end; /* states */
} tuile_state_t;
_Static_assert(sizeof(tuile_state_t) <= TUILE_STATE_BYTES, "TUILE_STATE_BYTES");

/* 64 bytes at a time; size_bytes is rounded up to that, which tile memory and colours have room for (TUILE_ALIGN64). */
void frame_fill_words(void *bytes, uint32_t word, size_t size_bytes);

/* Of vertices and records, were there so many slots of the former. */
TUILE_INLINE size_t frame_bytes_with(const tuile_t *t, uint32_t slots) {
    return slots * sizeof(vertex_t) + ((size_t)t->record_count * t->record_bytes + 7) / 8 * 8;
}

/* The room between vertices and records, 8-byte aligned at both ends: what a method may use while it draws. */
TUILE_INLINE uint8_t *frame_room(const tuile_t *t, size_t *size_bytes) {
    uint8_t *first = (uint8_t *)(t->vertices + t->vertex_count);
    const uint8_t *end = t->arena_end - ((size_t)t->record_count * t->record_bytes + 7) / 8 * 8;
    *size_bytes = end > first ? (size_t)(end - first) : 0;
    return first;
}

TUILE_INLINE record_t *frame_record(const tuile_t *t, uint32_t number) {
    return (record_t *)(void *)(t->arena_end - (size_t)(number + 1) * t->record_bytes);
}

TUILE_INLINE record_surface_t *frame_record_surface(record_t *record) { return (record_surface_t *)(void *)record; }

TUILE_INLINE uint32_t frame_record_id(const record_t *record) { return ((const record_id_t *)(const void *)record)->id; }

/* ---- bin.c: clusters ---- */

/* A cluster whose vertices are in the arena. */
typedef struct frame_cluster {
    const uint8_t *bytes; /* in the model's table */
    const uint8_t *faces;
    const int16_t *positions;
    const int8_t *fractions;     /* NULL: none */
    const int8_t *normals;       /* of its vertices; flat shading between key frames leaves those of the first */
    const int8_t *face_normals;  /* flat shading, else NULL */
    const int8_t *plane_normals; /* of its faces, whatever the shading; between key frames those of triangles, which want none, are
                                    the first ones */
    vertex_t *vertices;
    bool any_outside;    /* some vertex may need clipping */
    bool any_beyond;     /* some face may cover pixels outside of the pass's region */
    uint32_t first_face; /* id - 1 of its first face */
    uint16_t source;     /* slot of its source_slot_t where shading is deferred, else 0 */
    bool coloured;       /* its vertices have light in colours */
    bool tinted;         /* they have colours of their own */
} frame_cluster_t;

enum { BIN_CULLED = 2 };
enum { SIDE_FRONT = 1, SIDE_BACK = 2 };

enum { LAYER_PART_OPAQUE = 0, LAYER_PART_FACES = 1, LAYER_PART_EDGES = 2 };

/* NONE: no face is looked at for that; ALL: the same, but sides are told by t->sides alone. */
enum { SIFT_NONE = 0, SIFT_OPAQUE = 1, SIFT_TRANSLUCENT = 2, SIFT_ALL = 3 };

TUILE_INLINE bool frame_layers(const tuile_t *t) { return TUILE_HAS(LAYERS) && t->layer_samples != NULL; }

/* Runs all clusters over the region of the pass. In an immediate pass each face is handed to t->draw_now at once, which never
 * overflows unless a single cluster does. */
int bin_pass(tuile_t *t);

/* The same in parts, for methods with an order of their own: nothing binned yet; an instance's faces in their order; an instance
 * made the current one (BIN_CULLED: nothing of it can be seen); one of its clusters (BIN_CULLED: none of its faces can be seen), or
 * a cluster whose vertices stand from slot `slot` on. */
void bin_begin(tuile_t *t);
int bin_instance(tuile_t *t, unsigned number);
int bin_instance_open(tuile_t *t, unsigned number);
int bin_cluster_open(tuile_t *t, const uint8_t *bytes, frame_cluster_t *cluster);
void bin_cluster_at(const tuile_t *t, const uint8_t *bytes, uint32_t slot, frame_cluster_t *cluster);

/* Hangs all records that reach tile row `row` or below into the buckets again. */
void bin_again(tuile_t *t, uint16_t row);

/* Vertices that still fit below the records. */
uint32_t frame_slots_left(const tuile_t *t);

/* ---- morph.c: instances between two key frames ---- */

/* Memory for the frame, if any instance wants it: *arena moves on, by multiples of 8. TUILE_ERROR_MEMORY. */
int frame_morph_begin(tuile_t *t, uint8_t **arena);

/* Puts the current instance's mixture in the place of the positions and normals of the cluster, until the next call. */
void frame_morph_cluster(tuile_t *t, frame_cluster_t *cluster);

/* ---- lights.c: light that the vertices' 8 bits cannot tell ---- */

/* Memory for the frame, if any instance wants it: *arena moves on, by multiples of 8. coloured: all do. TUILE_ERROR_MEMORY. */
int frame_lights_begin(tuile_t *t, bool coloured, uint8_t **arena);

/* After the current instance's transform has been made; t->lamps or t->backs. */
void frame_lights_instance(tuile_t *t);

/* t->coloured: the light of a cluster's vertices, 4 bytes each, from slot `slot` on. */
void frame_lights_cluster(const tuile_t *t, const frame_cluster_t *cluster, uint32_t slot);

/* A face as its model has it. */
typedef struct frame_lit_face {
    const frame_cluster_t *cluster;
    const uint8_t *corners; /* `count` of them, among the cluster's vertices */
    const int8_t *normal;   /* flat shading, else NULL */
    uint8_t count, material;
} frame_lit_face_t;

/* t->careful: before a face is binned; it stays until that is done. sides: those that are wanted; t->sides becomes those that the
 * material shows. */
void frame_lights_face(tuile_t *t, const frame_lit_face_t *face, unsigned sides);

/* t->coloured: the light of t->lit in one colour. */
void frame_lights_flat(const tuile_t *t, record_surface_t *surface);

/* ---- face.c ---- */

/* Records for the faces of a cluster: all, or faces first ... end - 1 of it (first < end), in their order or backwards. */
int face_bin_all(tuile_t *t, const frame_cluster_t *cluster);
int face_bin_run(tuile_t *t, const frame_cluster_t *cluster, unsigned first, unsigned end, bool backwards);

/* ---- pass.c ---- */

/* Draws the tile that t->tile describes, in a pass that is there or a new one. FRAME_OK or a negative error. */
int pass_draw(tuile_t *t, uint32_t row, uint32_t column);

/* Begins the pass that draws the tile, unless it has begun. */
int pass_prepare(tuile_t *t, uint32_t row, uint32_t column);

/* Keeps the record of how much of the block the pass took, room_bytes of the room between vertices and records among it. */
void pass_measure(tuile_t *t, size_t room_bytes);

/* Before some of `slots` vertices are given up again: they count all the same. */
void pass_give_up(tuile_t *t, uint32_t slots);

/* Gives back the vertices from that one on. */
TUILE_INLINE void pass_give_back(tuile_t *t, uint32_t vertices_left) {
    pass_give_up(t, t->vertex_count);
    t->vertex_count = vertices_left;
}

/* Keeps the same record: what has been asked for ends there. */
void pass_reaches(tuile_t *t, const uint8_t *end);

/* ---- trace.c: t->config.trace is not NULL ---- */

void trace_tile(tuile_t *t);
void trace_face(tuile_t *t, uint32_t number);

/* ---- record.c ---- */

TUILE_INLINE bool frame_record_is_triangle(const record_t *record) { return record->d1 != 0; }

TUILE_INLINE bool frame_record_is_piece(const record_t *record) { return record->d1 == 0 && record->d2 != 0; }

TUILE_INLINE const piece_slot_t *frame_record_piece(const tuile_t *t, const record_t *record) {
    return (const piece_slot_t *)(const void *)&t->vertices[record->v0];
}

/* The record of the whole face, where record is that of a piece; else the same. */
TUILE_INLINE record_t frame_record_face(const tuile_t *t, const record_t *record) {
    record_t face = *record;
    if (frame_record_is_piece(record)) {
        const piece_slot_t *piece = frame_record_piece(t, record);
        face.v0 = piece->v0;
        face.d1 = piece->d1;
        face.d2 = piece->d2;
    }
    return face;
}

/* The corners of a face of more than three. */
polygon_ring_t frame_record_ring(const tuile_t *t, const record_t *record);

/* The rows of pixel centres that a record's face covers. */
void frame_record_rows(const tuile_t *t, const record_t *record, int32_t *first, int32_t *end);

/* ---- textured.c: the fast way of a texture (fill/textured.h) ---- */

/* A record's triangle set up to be drawn at once. False: it is to be drawn as a number. */
bool textured_start(tuile_t *t, textured_t *textured, const record_t *record, int32_t row);

/* ---- shade.c: deferred shading, t->numbers is not NULL ---- */

/* Builds without it have none of its code. */
TUILE_INLINE bool frame_deferred(const tuile_t *t) { return TUILE_HAS(SURFACES) && t->numbers != NULL; }

/* A tile of background, and no face seen in it yet. Its numbers, where faces are drawn with their texture at once, are left to the
 * first face that is not: shade_open. */
void shade_clear(tuile_t *t);
void shade_open(tuile_t *t);

/* The faces that are seen in the tile into its samples. */
void shade_tile(tuile_t *t);

/* Takes the place of draw_now: the face by the method, and at once into the samples. */
void shade_now(tuile_t *t, uint32_t number);

/* ---- resolve/resolve.c: samples to wire bytes ---- */

/* The tile, whose samples are in t->working, to t->colours[t->next_buffer]. */
void resolve_tile(const tuile_t *t);

/* ---- overlay/tile.c: t->given.overlay is not NULL ---- */

/* Lets it draw over the tile's samples. */
void overlay_tile(tuile_t *t);

/* ---- ramp.c ---- */

/* Where colours are drawn at once a record names its material by a number that is counted through the scene: 256 at most. In
 * deferred shading and for TUILE_FACE_IDS it is the number in the instance's model. */
TUILE_INLINE bool frame_counts_materials(const tuile_t *t) { return t->record_bytes == sizeof(record_t); }

/* Are the materials that an instance brings itself within their ranges? Those of models were checked when they were opened. */
bool frame_materials_fit(const tuile_instance_t *instance);

/* A material of an instance, by its number in the model. */
tuile_material_t frame_instance_material(const tuile_instance_t *instance, uint32_t material);

/* Materials are counted through the models of the scene, each model once for each set of materials that stands in the place of its
 * own: is this the first instance of it? */
bool frame_first_use(const tuile_scene_t *scene, unsigned instance);

/* The number of the first material of an instance's model. */
uint32_t frame_material_base(const tuile_scene_t *scene, unsigned instance);

/* The sample of a face in one colour: its material in the light of its record. */
uint32_t frame_flat(const tuile_t *t, const record_t *record);

/* The colours of a material by light, kept as they come; 0: none yet, or black, which is made again. NULL: there is no memory for
 * them, or it is not what is drawn. */
uint16_t *frame_flat_ramp(const tuile_t *t, uint32_t material);

/* What is drawn of a face in one value: the id, the number for deferred shading, or the colour. */
TUILE_INLINE uint32_t frame_value(const tuile_t *t, const record_t *record, uint32_t number) {
    if (t->span_kind == SPAN_IDS) { return frame_record_id(record); }
    return t->numbers != NULL ? number + 1 : frame_flat(t, record);
}

/* Bytes of what methods draw into. */
TUILE_INLINE size_t frame_sample_bytes(const tuile_t *t) { return t->span_kind == SPAN_IDS ? 4 : 2; }

/* 64 colours from black to full light: made when they are first wanted, again when another material took their place. */
void frame_ramp_make(tuile_t *t, uint32_t material, uint32_t slot);

TUILE_INLINE const uint16_t *frame_ramp(tuile_t *t, uint32_t material) {
    const uint32_t slot = TUILE_LIKELY(material < t->ramp_count) ? material : material % t->ramp_count;
    if (TUILE_UNLIKELY(t->ramp_tags[slot] != (int16_t)material)) { frame_ramp_make(t, material, slot); }
    return t->ramps + slot * RAMP_COLOURS;
}

#endif
