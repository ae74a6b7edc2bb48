/* One door for every file a user may name. */
#include "stages.h"

#include <string.h>

static size_t count_polygons(const tuile_model_t *model) {
    size_t polygons = 0;
    for (uint32_t k = 0; k < model->cluster_count; k++) {
        const uint8_t *cluster = model->clusters + (size_t)k * MODEL_CLUSTER_BYTES;
        const uint8_t *face = model->faces + model_u32(cluster + CLUSTER_AT_FACE_BYTES);
        unsigned faces = cluster[CLUSTER_AT_KIND] == MODEL_CLUSTER_POLYGONS ? model_u16(cluster + CLUSTER_AT_FACE_COUNT) : 0;
        for (; faces > 0; faces--, face += MODEL_POLYGON_BYTES(face[0])) {
            polygons += face[0] > 3;
        }
    }
    return polygons;
}

static int load_compiled(const char *path, size_t max_faces, const mesh_options_t *options, const uint8_t *bytes, size_t size_bytes,
                         mesh_report_t *report, sim_error_t *error) {
    tuile_model_t model;
    if (tuile_model_open(&model, bytes, size_bytes)) {
        uint32_t promised = size_bytes >= 8 ? model_u32(bytes + MODEL_AT_SIZE) : 0;
        if (promised != size_bytes) {
            return sim_fail(error, "%s: %zu bytes of a compiled model of %u: cut short or damaged; compile it again", path,
                            size_bytes, promised);
        }
        return sim_fail(error, "%s: a damaged compiled model, or one of another version; compile it again", path);
    }
    if (max_faces && model.face_count > max_faces) {
        return sim_fail(error,
                        "%s: is compiled already and has %u faces, more than the %zu asked for; compile it anew from its source",
                        path, model.face_count, max_faces);
    }
    if (options->triangles && model.corners_max > 3) {
        return sim_fail(error, "%s: is compiled already and has polygons; compile it anew from its source for triangles", path);
    }
    if (options->morph_path && !model.morph_positions) {
        return sim_fail(error, "%s: is compiled already, without a second key frame; compile it anew from its source with --morph",
                        path);
    }
    if (options->tree && !model.tree) {
        return sim_fail(error,
                        "%s: is compiled already, without a display tree; make one from its source: tuile mesh SOURCE -o %s --tree",
                        path, path);
    }
    if (report) {
        *report = (mesh_report_t){.vertices = model.vertex_count,
                                  .faces = model.face_count,
                                  .polygons = count_polygons(&model),
                                  .clusters = model.cluster_count,
                                  .size_bytes = size_bytes};
    }
    return 0;
}

/* Polygons are kept while they are few enough; what is counted are the faces that come out, as bent ones are cut, but before a tree
 * cuts them. */
static int load_source(const char *path, size_t max_faces, const mesh_options_t *options, uint8_t **bytes, size_t *size_bytes,
                       mesh_report_t *report, sim_error_t *error) {
    mesh_t mesh;
    mesh_report_t counts = {0};
    if (mesh_import_with(&mesh, path, options, error)) { return -1; }
    int status = 0;
    bool few = !max_faces || mesh.face_count <= max_faces;
    mesh_options_t plain = *options;
    plain.tree = options->tree && !max_faces;
    if (few) { status = mesh_compile(&mesh, &plain, bytes, size_bytes, &counts, error); }
    const bool many = !few || (max_faces && counts.faces > max_faces);
    if (!status && (many || plain.tree != options->tree)) {
        free(*bytes);
        *bytes = NULL;
        if (many) { status = mesh_simplify(&mesh, max_faces, error); }
        if (!status) { status = mesh_compile(&mesh, options, bytes, size_bytes, &counts, error); }
    }
    memcpy(counts.warnings, mesh.warnings, sizeof counts.warnings);
    if (status && error) { /* the later stages do not know the file */
        sim_error_t inner = *error;
        (void)sim_fail(error, "%s: %.400s", path, inner.text);
    }
    mesh_free(&mesh);
    if (report) { *report = counts; }
    return status;
}

int mesh_load(const char *path, size_t max_faces, const mesh_options_t *options, uint8_t **bytes, size_t *size_bytes,
              mesh_report_t *report, sim_error_t *error) {
    static const mesh_options_t defaults = {0};
    if (!options) { options = &defaults; }
    char *text;
    size_t length;
    *bytes = NULL;
    *size_bytes = 0;
    if (mesh_read_file(path, &text, &length, error)) { return -1; }
    static const uint8_t magic[4] = {MODEL_MAGIC & 0xff, MODEL_MAGIC >> 8 & 0xff, MODEL_MAGIC >> 16 & 0xff, MODEL_MAGIC >> 24};
    if (length < sizeof magic || memcmp(text, magic, sizeof magic)) {
        free(text);
        return load_source(path, max_faces, options, bytes, size_bytes, report, error);
    }
    if (load_compiled(path, max_faces, options, (uint8_t *)text, length, report, error)) {
        free(text);
        return -1;
    }
    *bytes = (uint8_t *)text;
    *size_bytes = length;
    return 0;
}
