/* Events from a renderer's own figures, which it keeps while it draws, and from its trace, which is made apart from the pixels. */
#include "../raster/frame/textured.h"
#include "predict.h"

static void on_tile(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom) {
    predict_meter_t *meter = context;
    meter->seen.count[PREDICT_TILE_SAMPLE] += (uint64_t)(right - left) * (bottom - top);
}

static bool is_short(const tuile_t *t, const record_t *record) {
    const vertex_t *a = &t->vertices[record->v0], *b = a + record->d1, *c = a + record->d2;
    const int32_t x[3] = {a->x, b->x, c->x}, bottom = b->y > c->y ? b->y : c->y;
    int32_t least = x[0], most = x[0];
    for (unsigned i = 1; i < 3; i++) {
        least = x[i] < least ? x[i] : least;
        most = x[i] > most ? x[i] : most;
    }
    return most - least < SHORT_SIDE && bottom - a->y < SHORT_SIDE;
}

/* Deferred shading: is a short triangle drawn with its texture at once? As small_prepare of raster/visibility/rows.h has it. */
static bool is_drawn_at_once(const tuile_t *t, const record_t *record) {
    const record_surface_t *extra = (const record_surface_t *)(const void *)record;
    const vertex_t *v0 = &t->vertices[record->v0], *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    const bool smooth = t->config.shade == TUILE_GOURAUD;
    tuile_t copy = *t; /* what is remembered of the last source changes */
    textured_map_t map;
    if (!t->textured || t->pixel_kind != PIXEL_RGB565_BE || !textured_fits(&copy, record)) { return false; }
    if (!smooth && (extra->green != record->light || extra->blue != record->light)) { return false; }
    const textured_face_t face =
        textured_face(&copy, record, v0, v1, v2, v1->x - v0->x, v1->y - v0->y, v2->x - v0->x, v2->y - v0->y);
    return textured_map_make(&map, &copy.textured_last, &face, 8, 8);
}

enum { SMALL, LARGE, POLYGON };

static void on_face(void *context, uint32_t number, uint32_t id) {
    predict_meter_t *meter = context;
    const tuile_t *t = meter->renderer;
    (void)id;
    meter->face_is_new = true;
    if (!t) { return; }
    const record_t *record = frame_record(t, number);
    if (!frame_record_is_triangle(record)) {
        meter->kind = POLYGON;
    } else {
        meter->kind = is_short(t, record) && (!frame_deferred(t) || is_drawn_at_once(t, record)) ? SMALL : LARGE;
    }
}

static void on_span(void *context, unsigned row, unsigned first, unsigned end) {
    predict_meter_t *meter = context;
    uint64_t *count = meter->seen.count + meter->kind;
    (void)row;
    count[PREDICT_SMALL_IN_TILE] += meter->face_is_new;
    count[PREDICT_SMALL_ROW]++;
    count[PREDICT_SMALL_FRAGMENT] += end - first;
    meter->face_is_new = false;
}

void predict_meter_open(predict_meter_t *meter) {
    *meter = (predict_meter_t){.trace = {.context = meter, .tile = on_tile, .face = on_face, .span = on_span}};
}

void predict_meter_begin(predict_meter_t *meter) {
    meter->seen = (predict_events_t){{0}};
    meter->in_frame = false;
}

static void count_polygons(predict_meter_t *meter) {
    const tuile_scene_t *scene = meter->renderer->scene;
    meter->faces = meter->polygons = 0;
    for (unsigned i = 0; i < scene->instance_count; i++) {
        const tuile_model_t *model = scene->instances[i].model;
        meter->faces += model->face_count;
        for (uint32_t k = 0; k < model->cluster_count; k++) {
            const uint8_t *cluster = model->clusters + (size_t)MODEL_CLUSTER_BYTES * k;
            meter->polygons += cluster[CLUSTER_AT_KIND] == MODEL_CLUSTER_TRIANGLES ? 0 : model_u16(cluster + CLUSTER_AT_FACE_COUNT);
        }
    }
}

predict_events_t predict_meter_take(predict_meter_t *meter) {
    predict_events_t events = meter->seen;
    if (!meter->renderer || !meter->renderer->in_frame) {
        predict_meter_begin(meter);
        return (predict_events_t){{0}};
    }
    const tuile_stats_t *now = &meter->renderer->stats, *before = &meter->before;
    if (!meter->in_frame) {
        meter->in_frame = true;
        meter->before = (tuile_stats_t){0};
        events.count[PREDICT_FRAME] = 1;
        count_polygons(meter);
    }
    events.count[PREDICT_CLUSTER] = now->clusters - before->clusters;
    events.count[PREDICT_VERTEX] = now->vertices - before->vertices;
    const uint64_t tested = now->faces_tested - before->faces_tested;
    events.count[PREDICT_POLYGON_TESTED] = meter->faces ? tested * meter->polygons / meter->faces : 0;
    events.count[PREDICT_FACE_TESTED] = tested - events.count[PREDICT_POLYGON_TESTED];
    events.count[PREDICT_FACE_CLIPPED] = now->faces_clipped - before->faces_clipped;
    events.count[PREDICT_FACE_BINNED] = now->faces_binned - before->faces_binned;
    events.count[PREDICT_FACE_SET_UP] = now->faces_setup - before->faces_setup;
    events.count[PREDICT_TILE] = now->tiles - before->tiles;
    events.count[PREDICT_FACE_OF_TILE] = meter->faces * events.count[PREDICT_TILE];
    events.count[PREDICT_CLIPPED_OF_TILE] = now->faces_clipped * events.count[PREDICT_TILE];
    meter->before = *now;
    meter->seen = (predict_events_t){{0}};
    return events;
}
