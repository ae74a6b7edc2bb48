#include "stages.h"

#include <math.h>
#include <string.h>

void mesh_free(mesh_t *mesh) {
    if (!mesh) { return; }
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->corners);
    free(mesh->corner_normals);
    free(mesh->faces);
    free(mesh->materials);
    memset(mesh, 0, sizeof *mesh);
}

bool mesh_reserve(void *array, size_t *capacity, size_t count, size_t item_bytes) {
    if (count <= *capacity) { return true; }
    size_t wanted = *capacity < 64 ? 64 : *capacity;
    while (wanted < count) {
        if (wanted > SIZE_MAX / 2) { return false; }
        wanted *= 2;
    }
    if (wanted > SIZE_MAX / item_bytes) { return false; }
    void *old;
    memcpy(&old, array, sizeof old);
    void *grown = realloc(old, wanted * item_bytes);
    if (!grown) { return false; }
    memcpy(array, &grown, sizeof grown);
    *capacity = wanted;
    return true;
}

/* The compiler trusts nobody with indices: meshes also come from text scenes. */
static int check(const mesh_t *mesh, sim_error_t *error) {
    if (mesh->material_count < 1 || mesh->material_count > MESH_MATERIALS_MAX) {
        return sim_fail(error, "the model has %zu materials; 1 to %u fit", mesh->material_count, MESH_MATERIALS_MAX);
    }
    for (size_t f = 0; f < mesh->face_count; f++) {
        const mesh_face_t *face = &mesh->faces[f];
        if (face->count < 3 || face->first > mesh->corner_count || face->count > mesh->corner_count - face->first ||
            face->material >= mesh->material_count || face->source >= mesh->source_face_count) {
            return sim_fail(error, "face %zu of the model has corners, a material or a number out of range", f);
        }
    }
    for (size_t c = 0; c < mesh->corner_count; c++) {
        if (mesh->corners[c] >= mesh->position_count || (mesh->normal_count && mesh->corner_normals[c] >= mesh->normal_count)) {
            return sim_fail(error, "corner %zu of the model refers to a vertex or normal that is not there", c);
        }
        const double *at = mesh->positions[mesh->corners[c]];
        if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2])) {
            return sim_fail(error, "vertex %u of the model is not finite: (%g, %g, %g)", mesh->corners[c], at[0], at[1], at[2]);
        }
    }
    return 0;
}

static int compile(const mesh_t *mesh, const mesh_options_t *options, uint8_t **bytes, size_t *size_bytes, mesh_report_t *report,
                   sim_error_t *error) {
    solid_t solid = {0};
    clusters_t clusters = {0};
    size_t vertex_count = 0;
    int status = solid_quantise(&solid, mesh, options, error);
    if (!status) { status = clusters_grow(&clusters, &solid, options->keep_order, error); }
    if (!status) { status = solid_encode(&solid, &clusters, mesh, bytes, size_bytes, &vertex_count, error); }
    if (!status && report) {
        *report = (mesh_report_t){.vertices = vertex_count,
                                  .faces = solid.face_count,
                                  .polygons = solid.polygons,
                                  .non_planar = solid.non_planar,
                                  .split = solid.split,
                                  .skipped = mesh->skipped_count + solid.skipped,
                                  .clusters = clusters.count,
                                  .size_bytes = *size_bytes,
                                  .quantisation_error = solid.error};
    }
    clusters_free(&clusters);
    solid_free(&solid);
    return status;
}

int mesh_compile(const mesh_t *mesh, const mesh_options_t *options, uint8_t **bytes, size_t *size_bytes, mesh_report_t *report,
                 sim_error_t *error) {
    static const mesh_options_t defaults = {0};
    if (!options) { options = &defaults; }
    *bytes = NULL;
    *size_bytes = 0;
    if (check(mesh, error)) { return -1; }
    if (mesh->normal_count) { return compile(mesh, options, bytes, size_bytes, report, error); }
    /* Normals are made on the side: the caller's mesh is const, and its other arrays are only looked at. */
    mesh_t lit = *mesh;
    lit.normals = NULL;
    lit.corner_normals = NULL;
    int status = mesh_make_normals(&lit, options->keep_planar, error);
    if (!status) { status = compile(&lit, options, bytes, size_bytes, report, error); }
    free(lit.normals);
    free(lit.corner_normals);
    return status;
}
