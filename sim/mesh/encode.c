/* The bytes of geometry/model.h. */
#include "stages.h"

#include <string.h>

#define NOT_HERE UINT32_MAX

typedef struct sheet { /* a growing section */
    uint8_t *bytes;
    size_t size, capacity;
} sheet_t;

typedef struct encoder {
    const solid_t *solid;
    const clusters_t *clusters;
    sheet_t positions, fractions, normals, table, faces, face_normals, materials, source, tree;
    sheet_t texcoords, colours, textures, morph_positions, morph_normals, morph_face_normals;
    uint32_t *local;    /* of each vertex of the solid: its place in the cluster at hand */
    uint32_t *vertices; /* of the cluster at hand, at most 255 */
    size_t vertex_count, face_count, cluster_vertices_max, corners_max;
    bool any_fraction, failed;
} encoder_t;

static void put(encoder_t *e, sheet_t *sheet, uint64_t value, size_t size_bytes) {
    if (e->failed || !mesh_reserve(&sheet->bytes, &sheet->capacity, sheet->size + size_bytes, 1)) {
        e->failed = true;
        return;
    }
    for (size_t i = 0; i < size_bytes; i++) {
        sheet->bytes[sheet->size++] = (uint8_t)(value >> 8 * i);
    }
}

static void put_signed(encoder_t *e, sheet_t *sheet, int64_t value, size_t size_bytes) {
    put(e, sheet, (uint64_t)value, size_bytes);
}

static void align(encoder_t *e, sheet_t *sheet) {
    while (!e->failed && sheet->size % 4) {
        put(e, sheet, 0, 1);
    }
}

static int8_t normal_byte(double component) { return (int8_t)(component * 127 + (component < 0 ? -0.5 : 0.5)); }

static void encode_face(encoder_t *e, const solid_face_t *face, bool triangles) {
    const uint32_t *corners = e->solid->corners + face->first;
    if (triangles) {
        for (int i = 0; i < 3; i++) {
            put(e, &e->faces, e->local[corners[i]], 1);
        }
        put(e, &e->faces, face->material, 1);
    } else {
        put(e, &e->faces, face->count, 1);
        put(e, &e->faces, (face->convex ? MODEL_FACE_CONVEX : 0u) | (face->crossing ? MODEL_FACE_CROSSING : 0u), 1);
        put(e, &e->faces, face->material, 1);
        for (uint32_t i = 0; i < face->count; i++) {
            put(e, &e->faces, e->local[corners[i]], 1);
        }
        put(e, &e->faces, face->count, 1);
    }
    for (int k = 0; k < 3; k++) {
        put_signed(e, &e->face_normals, normal_byte(face->unit[k]), 1);
    }
    for (int k = 0; e->solid->morphs && k < 3; k++) {
        put_signed(e, &e->morph_face_normals, normal_byte(face->morph_unit[k]), 1);
    }
    e->corners_max = face->count > e->corners_max ? face->count : e->corners_max;
}

/* Vertices in the order of their first use, so that a face's corners lie close together. */
static size_t number_vertices(encoder_t *e, const uint32_t *faces, size_t count) {
    size_t used = 0;
    for (size_t f = 0; f < count; f++) {
        const solid_face_t *face = &e->solid->faces[faces[f]];
        for (uint32_t i = 0; i < face->count; i++) {
            uint32_t v = e->solid->corners[face->first + i];
            if (e->local[v] == NOT_HERE) {
                e->local[v] = (uint32_t)used;
                e->vertices[used++] = v;
            }
        }
    }
    return used;
}

static void encode_vertex(encoder_t *e, const solid_vertex_t *vertex) {
    for (int i = 0; i < 3; i++) {
        put_signed(e, &e->positions, vertex->position[i], 2);
        put_signed(e, &e->normals, vertex->normal[i], 1);
        put_signed(e, &e->fractions, vertex->fraction[i], 1);
        e->any_fraction = e->any_fraction || vertex->fraction[i];
    }
    for (int i = 0; e->solid->textured && i < 2; i++) {
        put_signed(e, &e->texcoords, vertex->texcoord[i], 2);
    }
    for (int i = 0; e->solid->coloured && i < 4; i++) {
        put(e, &e->colours, vertex->colour[i], 1);
    }
    for (int i = 0; e->solid->morphs && i < 3; i++) {
        put_signed(e, &e->morph_positions, vertex->morph[i], 2);
        put_signed(e, &e->morph_normals, vertex->morph_normal[i], 1);
    }
}

static void encode_cluster(encoder_t *e, size_t k) {
    const uint32_t *faces = e->clusters->faces + e->clusters->first[k];
    size_t count = e->clusters->first[k + 1] - e->clusters->first[k];
    size_t vertices = number_vertices(e, faces, count);
    bool triangles = true;
    for (size_t f = 0; f < count; f++) {
        triangles = triangles && e->solid->faces[faces[f]].count == 3;
    }
    bounds_sphere_t sphere = bounds_of_vertices(e->solid, e->vertices, vertices);
    bounds_cone_t cone;
    e->failed = e->failed || bounds_of_normals(e->solid, faces, count, &cone);
    if (e->failed) { return; }
    align(e, &e->faces);
    for (int i = 0; i < 3; i++) {
        put_signed(e, &e->table, sphere.centre[i], 2);
    }
    put(e, &e->table, sphere.radius, 2);
    for (int i = 0; i < 3; i++) {
        put_signed(e, &e->table, cone.axis[i], 1);
    }
    put(e, &e->table, cone.cutoff, 1);
    put(e, &e->table, e->vertex_count, 4);
    put(e, &e->table, e->face_count, 4);
    put(e, &e->table, e->faces.size, 4);
    put(e, &e->table, count, 2);
    put(e, &e->table, vertices, 1);
    put(e, &e->table, triangles ? MODEL_CLUSTER_TRIANGLES : MODEL_CLUSTER_POLYGONS, 1);
    for (size_t v = 0; v < vertices; v++) {
        encode_vertex(e, &e->solid->vertices[e->vertices[v]]);
    }
    for (size_t f = 0; f < count; f++) {
        encode_face(e, &e->solid->faces[faces[f]], triangles);
    }
    for (size_t v = 0; v < vertices; v++) {
        e->local[e->vertices[v]] = NOT_HERE;
    }
    e->vertex_count += vertices;
    e->face_count += count;
    e->cluster_vertices_max = vertices > e->cluster_vertices_max ? vertices : e->cluster_vertices_max;
}

/* The map is left out where faces lie as they came. */
static bool encode_source(encoder_t *e, size_t source_face_count) {
    bool wide = source_face_count > 65536, identity = e->solid->face_count == source_face_count;
    for (size_t f = 0; identity && f < e->solid->face_count; f++) {
        identity = e->solid->faces[e->clusters->faces[f]].source == f;
    }
    for (size_t f = 0; !identity && f < e->solid->face_count; f++) {
        put(e, &e->source, e->solid->faces[e->clusters->faces[f]].source, wide ? 4 : 2);
    }
    return wide && !identity;
}

static void encode_materials(encoder_t *e, const mesh_t *mesh) {
    static const tuile_material_t plain = {.alpha = 255, .texture = TUILE_NO_TEXTURE};
    for (size_t m = 0; m < mesh->material_count; m++) {
        const tuile_material_t *from = mesh->surfaces ? &mesh->surfaces[m] : &plain;
        const uint8_t *colour = mesh->materials[m];
        const uint8_t entry[MODEL_MATERIAL_BYTES] = {
            colour[0],      colour[1],       colour[2],     from->alpha, from->emission[0], from->emission[1], from->emission[2],
            from->specular, from->shininess, from->texture, from->blend, from->flags,       from->uv_bits};
        for (size_t i = 0; i < sizeof entry; i++) {
            put(e, &e->materials, entry[i], 1);
        }
    }
}

static uint32_t place(sheet_t *out, encoder_t *e, sheet_t *section) {
    size_t at = out->size;
    for (size_t i = 0; i < section->size; i++) {
        put(e, out, section->bytes[i], 1);
    }
    align(e, out);
    return section->size ? (uint32_t)at : 0;
}

static void write_u16(uint8_t *p, uint32_t value) {
    p[0] = (uint8_t)value;
    p[1] = (uint8_t)(value >> 8);
}

static void write_u32(uint8_t *p, uint32_t value) {
    write_u16(p, value);
    write_u16(p + 2, value >> 16);
}

/* The least and greatest coordinates of all positions, of both key frames. */
static void write_box(const encoder_t *e, uint8_t *low, uint8_t *high) {
    int32_t least[3] = {INT16_MAX, INT16_MAX, INT16_MAX}, most[3] = {INT16_MIN, INT16_MIN, INT16_MIN};
    const sheet_t *const frames[2] = {&e->positions, &e->morph_positions};
    for (int frame = 0; frame < 2; frame++) {
        for (size_t at = 0; at < frames[frame]->size; at += 2) {
            const size_t axis = at / 2 % 3;
            const int32_t value = model_i16(frames[frame]->bytes + at);
            least[axis] = value < least[axis] ? value : least[axis];
            most[axis] = value > most[axis] ? value : most[axis];
        }
    }
    for (size_t axis = 0; axis < 3; axis++) {
        write_u16(low + 2 * axis, (uint32_t)least[axis]);
        write_u16(high + 2 * axis, (uint32_t)most[axis]);
    }
}

/* Sections of their own for texels and palettes, and the table that tells where they lie. */
static uint32_t place_textures(encoder_t *e, sheet_t *out, const mesh_t *mesh) {
    for (size_t t = 0; t < mesh->texture_count; t++) {
        const mesh_texture_t *from = &mesh->textures[t];
        sheet_t texels = {from->texels, from->size_bytes, 0}, palette = {from->palette, from->palette_bytes, 0};
        put(e, &e->textures, place(out, e, &texels), 4);
        put(e, &e->textures, place(out, e, &palette), 4);
        put(e, &e->textures, from->width, 2);
        put(e, &e->textures, from->height, 2);
        put(e, &e->textures, from->format, 1);
        put(e, &e->textures, from->levels, 1);
        put(e, &e->textures, from->flags, 2);
        put(e, &e->textures, from->key, 4);
    }
    return place(out, e, &e->textures);
}

static void finish(encoder_t *e, sheet_t *out, const mesh_t *mesh, bool source32, const tree_section_t *tree) {
    const solid_t *solid = e->solid;
    for (size_t i = 0; i < MODEL_HEADER_BYTES; i++) {
        put(e, out, 0, 1);
    }
    if (!e->any_fraction) { e->fractions.size = 0; }
    uint32_t at[9] = {place(out, e, &e->positions), 0};
    at[1] = place(out, e, &e->normals);
    at[2] = place(out, e, &e->table);
    at[3] = place(out, e, &e->faces);
    at[4] = place(out, e, &e->face_normals);
    at[5] = place(out, e, &e->materials);
    at[6] = place(out, e, &e->source);
    at[7] = place(out, e, &e->tree);
    at[8] = place(out, e, &e->fractions);
    const uint32_t extra[6][2] = {{MODEL_AT_TEXCOORDS, place(out, e, &e->texcoords)},
                                  {MODEL_AT_COLOURS, place(out, e, &e->colours)},
                                  {MODEL_AT_MORPH_POSITIONS, place(out, e, &e->morph_positions)},
                                  {MODEL_AT_MORPH_NORMALS, place(out, e, &e->morph_normals)},
                                  {MODEL_AT_MORPH_FACE_NORMALS, place(out, e, &e->morph_face_normals)},
                                  {MODEL_AT_TEXTURES, place_textures(e, out, mesh)}};
    for (size_t v = 0; v < solid->vertex_count && v < UINT32_MAX; v++) {
        e->local[v] = (uint32_t)v;
    }
    bounds_sphere_t sphere = bounds_of_vertices(solid, e->local, solid->vertex_count);
    if (e->failed) { return; }
    uint8_t *header = out->bytes;
    write_u32(header + MODEL_AT_MAGIC, MODEL_MAGIC);
    write_u32(header + MODEL_AT_SIZE, (uint32_t)out->size);
    write_u16(header + MODEL_AT_VERSION, MODEL_VERSION);
    write_u16(header + MODEL_AT_FLAGS, source32 ? MODEL_FLAG_SOURCE32 : 0);
    write_u32(header + MODEL_AT_VERTICES, (uint32_t)e->vertex_count);
    write_u32(header + MODEL_AT_FACES, (uint32_t)e->face_count);
    write_u32(header + MODEL_AT_CLUSTERS, (uint32_t)e->clusters->count);
    write_u32(header + MODEL_AT_SOURCE_FACES, (uint32_t)mesh->source_face_count);
    write_u16(header + MODEL_AT_MATERIALS, (uint32_t)mesh->material_count);
    write_u16(header + MODEL_AT_CLUSTER_MAX, (uint32_t)e->cluster_vertices_max);
    write_u16(header + MODEL_AT_CORNERS_MAX, (uint32_t)e->corners_max);
    write_u16(header + MODEL_AT_RADIUS, sphere.radius);
    write_u16(header + MODEL_AT_STEP_EXPONENT, (uint32_t)solid->step.exponent);
    write_u32(header + MODEL_AT_STEP_MANTISSA, solid->step.mantissa);
    for (size_t k = 0; k < 3; k++) {
        write_u16(header + MODEL_AT_CENTRE + 2 * k, (uint32_t)sphere.centre[k]);
        write_u32(header + MODEL_AT_OFFSET + 4 * k, (uint32_t)solid->offset[k]);
    }
    write_box(e, header + MODEL_AT_LOW, header + MODEL_AT_HIGH);
    write_u32(header + MODEL_AT_FRACTIONS, at[8]);
    write_u32(header + MODEL_AT_POSITIONS, at[0]);
    write_u32(header + MODEL_AT_NORMALS, at[1]);
    write_u32(header + MODEL_AT_CLUSTER_TABLE, at[2]);
    write_u32(header + MODEL_AT_FACE_BYTES, at[3]);
    write_u32(header + MODEL_AT_FACE_BYTES_SIZE, (uint32_t)e->faces.size);
    write_u32(header + MODEL_AT_FACE_NORMALS, at[4]);
    write_u32(header + MODEL_AT_MATERIAL_TABLE, at[5]);
    write_u32(header + MODEL_AT_SOURCE, at[6]);
    write_u32(header + MODEL_AT_TREE, at[7]);
    write_u32(header + MODEL_AT_TREE_WORDS, tree ? (uint32_t)tree->count : 0);
    write_u16(header + MODEL_AT_TREE_DEPTH, tree ? (uint32_t)tree->depth : 0);
    for (size_t i = 0; i < sizeof extra / sizeof extra[0]; i++) {
        write_u32(header + extra[i][0], extra[i][1]);
    }
    write_u16(header + MODEL_AT_TEXTURE_COUNT, (uint32_t)mesh->texture_count);
    write_u32(header + MODEL_AT_CRC32, model_crc32(0, header + MODEL_AT_VERSION, out->size - MODEL_AT_VERSION));
}

int solid_encode(const solid_t *solid, const clusters_t *clusters, const mesh_t *mesh, const tree_section_t *tree, uint8_t **bytes,
                 size_t *size_bytes, size_t *vertex_count, sim_error_t *error) {
    encoder_t e = {.solid = solid, .clusters = clusters};
    sheet_t out = {0};
    e.local = mesh_array(solid->vertex_count, sizeof *e.local);
    e.vertices = mesh_array(solid->vertex_count, sizeof *e.vertices);
    e.failed = !e.local || !e.vertices;
    for (size_t v = 0; !e.failed && v < solid->vertex_count; v++) {
        e.local[v] = NOT_HERE;
    }
    for (size_t k = 0; !e.failed && k < clusters->count; k++) {
        encode_cluster(&e, k);
    }
    encode_materials(&e, mesh);
    bool source32 = encode_source(&e, mesh->source_face_count);
    align(&e, &e.faces);
    for (size_t i = 0; tree && i < tree->count; i++) {
        put(&e, &e.tree, tree->words[i], 4);
    }
    if (!e.failed) { finish(&e, &out, mesh, source32, tree); }
    sheet_t *sections[] = {&e.positions,    &e.fractions, &e.normals,         &e.table,         &e.faces,
                           &e.face_normals, &e.materials, &e.source,          &e.tree,          &e.texcoords,
                           &e.colours,      &e.textures,  &e.morph_positions, &e.morph_normals, &e.morph_face_normals};
    for (size_t s = 0; s < sizeof sections / sizeof sections[0]; s++) {
        free(sections[s]->bytes);
    }
    free(e.local);
    free(e.vertices);
    if (e.failed || out.size > UINT32_MAX) {
        free(out.bytes);
        return sim_fail(error,
                        e.failed ? "out of memory for the bytes of %zu faces"
                                 : "the model of %zu faces takes more than 4 GiB; simplify it",
                        solid->face_count);
    }
    *bytes = out.bytes;
    *size_bytes = out.size;
    *vertex_count = e.vertex_count;
    return 0;
}
