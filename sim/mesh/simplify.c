/* Fewer faces, by meshoptimizer's quadric simplifier.
 *
 * A vertex on the border of two materials, or where texture coordinates or colours leap, is given to it once for each, so that the
 * border is a seam to it and colours stay where they were. It only takes vertices away, so that those left keep what they had; how
 * much a texture is stretched by that is not asked (this version of the library cannot). If such seams, or a topology that cannot
 * be kept, stop it short, it is asked again without the seams, and last of all its sloppy sibling, which joins whatever lies close
 * together.
 */
#include "stages.h"

#include <float.h>
#include <math.h>
#include <meshoptimizer.h>
#include <string.h>

/* What makes a vertex; no padding, since they are compared by their bytes. */
typedef struct soup_key {
    double texcoord[2];
    uint32_t position, material;
    uint8_t colour[4], zero[4];
} soup_key_t;

typedef struct soup {    /* of triangles */
    float (*places)[3];  /* within a unit cube */
    uint32_t *positions; /* of each vertex, in the mesh */
    soup_key_t *keys;    /* of each vertex */
    size_t vertex_count;
    uint32_t *indices;
    size_t index_count;
} soup_t;

static void soup_free(soup_t *soup) {
    free(soup->places);
    free(soup->positions);
    free(soup->keys);
    free(soup->indices);
}

/* The triangles of one face, as corners of the mesh and at most face->count - 2; -1 without memory. */
static long face_triangles(const mesh_t *mesh, const mesh_face_t *face, int32_t (*points)[3], uint32_t (*triangles)[3]) {
    const uint32_t *corners = mesh->corners + face->first;
    long count = 1;
    triangles[0][0] = 0;
    triangles[0][1] = 1;
    triangles[0][2] = 2;
    if (face->count > 3) {
        double low[3], high[3], extent = 0;
        for (int k = 0; k < 3; k++) {
            low[k] = high[k] = mesh->positions[corners[0]][k];
            for (uint32_t i = 1; i < face->count; i++) {
                low[k] = fmin(low[k], mesh->positions[corners[i]][k]);
                high[k] = fmax(high[k], mesh->positions[corners[i]][k]);
            }
            extent = fmax(extent, high[k] - low[k]);
        }
        if (!(extent > 0)) { return 0; }
        for (uint32_t i = 0; i < face->count; i++) {
            for (int k = 0; k < 3; k++) {
                points[i][k] = (int32_t)lround((mesh->positions[corners[i]][k] - low[k]) / extent * MESH_TRIANGULATE_RANGE);
            }
        }
        count = mesh_triangulate((const int32_t(*)[3])points, face->count, triangles);
    }
    for (long t = 0; t < count; t++) {
        for (int i = 0; i < 3; i++) {
            triangles[t][i] += face->first;
        }
    }
    return count;
}

static soup_key_t key_of(const mesh_t *mesh, const mesh_face_t *face, uint32_t corner) {
    soup_key_t key = {.position = mesh->corners[corner], .material = face->material};
    if (mesh->texcoords) { memcpy(key.texcoord, mesh->texcoords[corner], sizeof key.texcoord); }
    if (mesh->colours) { memcpy(key.colour, mesh->colours[corner], sizeof key.colour); }
    return key;
}

static bool soup_triangulate(soup_t *soup, const mesh_t *mesh) {
    uint32_t largest = 3;
    size_t triangles_most = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        largest = mesh->faces[f].count > largest ? mesh->faces[f].count : largest;
        triangles_most += mesh->faces[f].count - 2;
    }
    int32_t(*points)[3] = mesh_array(largest, sizeof *points);
    uint32_t(*triangles)[3] = mesh_array(largest, sizeof *triangles);
    soup_key_t *keys = mesh_array(triangles_most * 3, sizeof *keys);
    soup->indices = mesh_array(triangles_most * 3, sizeof *soup->indices);
    soup->positions = mesh_array(triangles_most * 3, sizeof *soup->positions);
    soup->keys = mesh_array(triangles_most * 3, sizeof *soup->keys);
    bool done = points && triangles && keys && soup->indices && soup->positions && soup->keys;
    for (size_t f = 0; done && f < mesh->face_count; f++) {
        long count = face_triangles(mesh, &mesh->faces[f], points, triangles);
        done = count >= 0;
        for (long t = 0; t < count; t++) {
            const uint32_t *corner = triangles[t],
                           at[3] = {mesh->corners[corner[0]], mesh->corners[corner[1]], mesh->corners[corner[2]]};
            for (int i = 0; i < 3 && at[0] != at[1] && at[1] != at[2] && at[2] != at[0]; i++) {
                keys[soup->index_count++] = key_of(mesh, &mesh->faces[f], corner[i]);
            }
        }
    }
    if (done && soup->index_count) {
        soup->vertex_count =
            meshopt_generateVertexRemap(soup->indices, NULL, soup->index_count, keys, soup->index_count, sizeof *keys);
        for (size_t i = 0; i < soup->index_count; i++) {
            soup->positions[soup->indices[i]] = keys[i].position;
            soup->keys[soup->indices[i]] = keys[i];
        }
    }
    free(points);
    free(triangles);
    free(keys);
    return done;
}

/* The simplifier has floats: only relative places matter to it, so they get the whole precision. */
static bool soup_place(soup_t *soup, const mesh_t *mesh) {
    double low[3], high[3], extent = 0;
    soup->places = mesh_array(soup->vertex_count, sizeof *soup->places);
    if (!soup->places) { return false; }
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
        for (size_t v = 0; v < soup->vertex_count; v++) {
            low[k] = fmin(low[k], mesh->positions[soup->positions[v]][k]);
            high[k] = fmax(high[k], mesh->positions[soup->positions[v]][k]);
        }
        extent = fmax(extent, high[k] - low[k]);
    }
    for (size_t v = 0; v < soup->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            soup->places[v][k] = (float)((mesh->positions[soup->positions[v]][k] - low[k]) / extent);
        }
    }
    return true;
}

/* One vertex a position, of the material that uses it first. */
static bool soup_without_seams(soup_t *soup, const mesh_t *mesh) {
    uint32_t *vertex = mesh_array(mesh->position_count, sizeof *vertex);
    if (!vertex) { return false; }
    for (size_t v = soup->vertex_count; v-- > 0;) {
        vertex[soup->positions[v]] = (uint32_t)v;
    }
    for (size_t i = 0; i < soup->index_count; i++) {
        soup->indices[i] = vertex[soup->positions[soup->indices[i]]];
    }
    free(vertex);
    return true;
}

/* Reduces soup->indices into result; returns the number of indices, which may still be too large. */
static size_t reduce(soup_t *soup, mesh_t *mesh, size_t target, uint32_t *result) {
    const float *places = &soup->places[0][0];
    size_t stride = sizeof *soup->places;
    size_t made =
        meshopt_simplify(result, soup->indices, soup->index_count, places, soup->vertex_count, stride, target, FLT_MAX, 0, NULL);
    if (made <= target || !soup_without_seams(soup, mesh)) { return made; }
    if (mesh->texcoords || mesh->colours) {
        mesh_warn(mesh, "simplified across the seams of textures and colours, which are moved; allow more faces to keep them");
    }
    made = meshopt_simplify(result, soup->indices, soup->index_count, places, soup->vertex_count, stride, target, FLT_MAX, 0, NULL);
    if (made <= target) { return made; }
    return meshopt_simplifySloppy(result, soup->indices, soup->index_count, places, soup->vertex_count, stride, target, FLT_MAX,
                                  NULL);
}

/* The new mesh: the triangles of indices. Positions that none of them uses stay, and do no harm. */
static int rebuild(mesh_t *mesh, const soup_t *soup, const uint32_t *indices, size_t index_count, sim_error_t *error) {
    mesh_t made = {.position_count = mesh->position_count,
                   .corner_count = index_count,
                   .face_count = index_count / 3,
                   .material_count = mesh->material_count,
                   .source_face_count = index_count / 3,
                   .skipped_count = mesh->skipped_count,
                   .loose_count = mesh->loose_count};
    const bool textured = mesh->texcoords != NULL, coloured = mesh->colours != NULL;
    made.positions = mesh_array(made.position_count, sizeof *made.positions);
    made.corners = mesh_array(made.corner_count, sizeof *made.corners);
    made.faces = mesh_array(made.face_count, sizeof *made.faces);
    made.materials = mesh_array(made.material_count, sizeof *made.materials);
    if (textured) { made.texcoords = mesh_array(made.corner_count, sizeof *made.texcoords); }
    if (coloured) { made.colours = mesh_array(made.corner_count, sizeof *made.colours); }
    if (mesh->surfaces) { made.surfaces = mesh_array(made.material_count, sizeof *made.surfaces); }
    if (!made.positions || !made.corners || !made.faces || !made.materials || (textured && !made.texcoords) ||
        (coloured && !made.colours) || (mesh->surfaces && !made.surfaces)) {
        mesh_free(&made);
        return sim_fail(error, "out of memory for %zu simplified faces", index_count / 3);
    }
    memcpy(made.positions, mesh->positions, made.position_count * sizeof *made.positions);
    memcpy(made.materials, mesh->materials, made.material_count * sizeof *made.materials);
    if (mesh->surfaces) { memcpy(made.surfaces, mesh->surfaces, made.material_count * sizeof *made.surfaces); }
    for (size_t i = 0; i < index_count; i++) {
        made.corners[i] = soup->positions[indices[i]];
        if (textured) { memcpy(made.texcoords[i], soup->keys[indices[i]].texcoord, sizeof *made.texcoords); }
        if (coloured) { memcpy(made.colours[i], soup->keys[indices[i]].colour, sizeof soup->keys[0].colour); }
    }
    for (size_t f = 0; f < made.face_count; f++) {
        made.faces[f] = (mesh_face_t){
            .first = (uint32_t)(3 * f), .count = 3, .material = soup->keys[indices[3 * f]].material, .source = (uint32_t)f};
    }
    if (mesh_make_normals(&made, false, error)) {
        mesh_free(&made);
        return -1;
    }
    made.textures = mesh->textures; /* moves */
    made.texture_count = mesh->texture_count;
    memcpy(made.warnings, mesh->warnings, sizeof made.warnings);
    mesh->textures = NULL;
    mesh->texture_count = 0;
    mesh_free(mesh);
    *mesh = made;
    return 0;
}

int mesh_simplify(mesh_t *mesh, size_t max_faces, sim_error_t *error) {
    soup_t soup = {0};
    int status;
    if (max_faces < 1 || max_faces > SIZE_MAX / 3) {
        return sim_fail(error, "a model of %zu faces was asked for; 1 is the least", max_faces);
    }
    if (mesh->morph.positions) {
        return sim_fail(error, "a model with a second key frame cannot be simplified; do so before, both alike");
    }
    if (!soup_triangulate(&soup, mesh)) {
        status = sim_fail(error, "out of memory for the triangles of %zu faces", mesh->face_count);
    } else if (soup.index_count <= 3 * max_faces) {
        status = 0;
    } else {
        uint32_t *result = mesh_array(soup.index_count, sizeof *result);
        bool placed = soup_place(&soup, mesh);
        size_t made = placed && result ? reduce(&soup, mesh, 3 * max_faces, result) : 0;
        if (!placed || !result) {
            status = sim_fail(error, "out of memory to simplify %zu triangles", soup.index_count / 3);
        } else if (made == 0 || made > 3 * max_faces) {
            status = sim_fail(error, "the model of %zu triangles cannot be simplified to %zu; allow more", soup.index_count / 3,
                              max_faces);
        } else {
            status = rebuild(mesh, &soup, result, made, error);
        }
        free(result);
    }
    soup_free(&soup);
    return status;
}
