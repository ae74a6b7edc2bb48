/* Light that the vertices' 8 bits cannot tell: colours, points and highlights, and faces seen from behind because of their material
 * alone. The lights in the current instance's space stand at the start of the arena, if any instance wants them.
 */
#include "frame.h"

#include "../memory.h"

/* What an instance's materials ask for. */
enum { WANTS_HIGHLIGHTS = 1, WANTS_BACKS = 2 };

static unsigned materials_want(const tuile_instance_t *instance) {
    unsigned wants = 0;
    for (uint32_t m = 0; m < instance->model->material_count; m++) {
        const tuile_material_t material = frame_instance_material(instance, m);
        if (material.specular != 0) { wants |= WANTS_HIGHLIGHTS; }
        if (material.flags & TUILE_MATERIAL_TWO_SIDED && !instance->two_sided) { wants |= WANTS_BACKS; }
    }
    return wants;
}

int frame_lights_begin(tuile_t *t, bool coloured, uint8_t **arena) {
    const tuile_scene_t *scene = t->scene;
    unsigned wants = 0;
    for (unsigned i = 0; i < scene->instance_count; i++) {
        wants |= materials_want(&scene->instances[i]);
    }
    t->backs = (wants & WANTS_BACKS) != 0;
    if (!frame_deferred(t) || (!coloured && wants == 0)) { return TUILE_OK; }
    t->coloured_scene = coloured;
    const size_t bytes = TUILE_LIGHTS_BYTES((size_t)scene->light_count), room = (size_t)(t->arena_end - *arena);
    const size_t least = TUILE_CLIP_BYTES + 8 * (size_t)t->config.cluster_vertices + TUILE_CORNERS_BYTES(t->config.corners) +
                         TUILE_SURFACE_BYTES((size_t)t->config.cluster_vertices);
    _Static_assert(TUILE_LIGHTS_BYTES(1u) >= LAMPS_BYTES(1u) && TUILE_LIGHTS_BYTES(255u) >= LAMPS_BYTES(255u),
                   "TUILE_LIGHTS_BYTES");
    if (bytes + least > room) {
        t->wanted_bytes = (size_t)t->stats.size_bytes + (bytes + least - room);
        return TUILE_ERROR_MEMORY;
    }
    t->lamps = (lamps_t *)(void *)*arena;
    *arena += bytes;
    pass_reaches(t, *arena + least);
    return TUILE_OK;
}

void frame_lights_instance(tuile_t *t) {
    const unsigned wants = materials_want(t->instance);
    t->mixed = (wants & WANTS_BACKS) != 0;
    if (t->mixed) {
        t->sides = SIDE_FRONT | SIDE_BACK;
        t->transform.cones = false;
    }
    t->coloured = t->lamps != NULL && (t->coloured_scene || wants != 0);
    t->careful = t->mixed || (t->coloured && t->config.shade == TUILE_FLAT);
    if (t->coloured) { lamps_make(t->lamps, t->scene, t->instance, &t->transform); }
}

/* ---- vertices ---- */

static void point_open(const tuile_t *t, lamp_point_t *point, unsigned number) {
    const tuile_material_t material = frame_instance_material(t->instance, number);
    point->both_sides = t->instance->two_sided || material.flags & TUILE_MATERIAL_TWO_SIDED;
    point->shininess = (int8_t)(material.specular ? (material.shininess > 7 ? 7 : material.shininess) : -1);
}

/* The number of a face's material into the fourth byte of its vertices: shininess and sides are theirs. A vertex that faces of
 * several materials share has those of the last one. */
static void mark_materials(const frame_cluster_t *cluster, uint8_t *lights) {
    const unsigned count = model_u16(cluster->bytes + CLUSTER_AT_FACE_COUNT);
    const bool triangles = cluster->bytes[CLUSTER_AT_KIND] == MODEL_CLUSTER_TRIANGLES;
    const uint8_t *face = cluster->faces;
    for (unsigned f = 0; f < count; f++) {
        const unsigned corners = triangles ? 3 : face[0];
        const uint8_t *corner = triangles ? face : face + 3, material = triangles ? face[3] : face[2];
        for (unsigned i = 0; i < corners; i++) {
            lights[4 * (size_t)corner[i] + 3] = material;
        }
        face += triangles ? 4 : MODEL_POLYGON_BYTES(corners);
    }
}

static void add_position(const frame_cluster_t *cluster, unsigned vertex, int32_t sum[3]) {
    for (unsigned i = 0; i < 3; i++) {
        const size_t at = 3 * (size_t)vertex + i;
        sum[i] += 256 * cluster->positions[at] + (cluster->fractions ? cluster->fractions[at] : 0);
    }
}

void frame_lights_cluster(const tuile_t *t, const frame_cluster_t *cluster, uint32_t slot) {
    uint8_t *light = (uint8_t *)(t->vertices + slot);
    const unsigned count = cluster->bytes[CLUSTER_AT_VERTEX_COUNT];
    unsigned material = 256;
    lamp_point_t point;
    memset(light, 0, 4 * (size_t)count);
    mark_materials(cluster, light);
    for (unsigned v = 0; v < count; v++, light += 4) {
        if (light[3] != material) { point_open(t, &point, material = light[3]); }
        for (unsigned i = 0; i < 3; i++) {
            point.at[i] = 0;
            point.normal[i] = cluster->normals[3 * (size_t)v + i];
        }
        add_position(cluster, v, point.at);
        lamps_light(t->lamps, &point, light);
    }
}

/* ---- faces ---- */

void frame_lights_face(tuile_t *t, const frame_lit_face_t *face, unsigned sides) {
    t->sides = (uint8_t)sides;
    t->lit = face;
    if (t->mixed && !(frame_instance_material(t->instance, face->material).flags & TUILE_MATERIAL_TWO_SIDED)) {
        t->sides &= SIDE_FRONT;
    }
}

void frame_lights_flat(const tuile_t *t, record_surface_t *surface) {
    const frame_lit_face_t *face = t->lit;
    lamp_point_t point;
    int32_t sum[3] = {0, 0, 0};
    uint8_t light[4];
    point_open(t, &point, face->material);
    unsigned corner = 0;
    do { /* a face has corners */
        add_position(face->cluster, face->corners[corner], sum);
    } while (++corner < face->count);
    for (unsigned i = 0; i < 3; i++) {
        point.at[i] = fixed_floor_div(sum[i], (int32_t)face->count);
        point.normal[i] = face->normal[i];
    }
    lamps_light(t->lamps, &point, light);
    const uint32_t specular = frame_instance_material(t->instance, face->material).specular;
    const uint32_t highlight = pixel_div255(light[3] * specular + 127u);
    for (unsigned c = 0; c < 3; c++) {
        light[c] = (uint8_t)(light[c] + highlight > 255 ? 255 : light[c] + highlight);
    }
    surface->record.light = light[0];
    surface->green = light[1];
    surface->blue = light[2];
}
