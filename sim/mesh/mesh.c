#include "tree.h"

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
    free(mesh->surfaces);
    free(mesh->texcoords);
    free(mesh->colours);
    for (size_t t = 0; t < mesh->texture_count; t++) {
        free(mesh->textures[t].name);
        free(mesh->textures[t].texels);
        free(mesh->textures[t].palette);
    }
    free(mesh->textures);
    free(mesh->morph.positions);
    free(mesh->morph.normals);
    free(mesh->morph.corner_normals);
    memset(mesh, 0, sizeof *mesh);
}

/* The compiler trusts nobody with indices: meshes also come from text scenes. */
static int check(const mesh_t *mesh, sim_error_t *error) {
    if (mesh->material_count < 1 || mesh->material_count > MESH_MATERIALS_MAX) {
        return sim_fail(error, "the model has %zu materials; 1 to %u fit", mesh->material_count, MESH_MATERIALS_MAX);
    }
    for (size_t m = 0; mesh->surfaces && m < mesh->material_count; m++) {
        if (mesh->surfaces[m].texture != TUILE_NO_TEXTURE &&
            (mesh->surfaces[m].texture >= mesh->texture_count || !mesh->texcoords)) {
            return sim_fail(error, "material %zu of the model has a texture that is not there", m);
        }
    }
    if (mesh->morph.positions && (!mesh->normal_count || !mesh->morph.normals || !mesh->morph.corner_normals)) {
        return sim_fail(error, "the model has a second key frame without normals, or a first one");
    }
    for (size_t f = 0; f < mesh->face_count; f++) {
        const mesh_face_t *face = &mesh->faces[f];
        if (face->count < 3 || face->first > mesh->corner_count || face->count > mesh->corner_count - face->first ||
            face->material >= mesh->material_count || face->source >= mesh->source_face_count) {
            return sim_fail(error, "face %zu of the model has corners, a material or a number out of range", f);
        }
    }
    for (size_t c = 0; mesh->morph.positions && c < mesh->corner_count; c++) {
        const double *at = mesh->corners[c] < mesh->position_count ? mesh->morph.positions[mesh->corners[c]] : NULL;
        if (!at || !isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2]) ||
            mesh->morph.corner_normals[c] >= mesh->morph.normal_count) {
            return sim_fail(error, "corner %zu of the model is not finite in the second key frame, or has no normal there", c);
        }
    }
    for (size_t c = 0; c < mesh->corner_count; c++) {
        if (mesh->corners[c] >= mesh->position_count || (mesh->normal_count && mesh->corner_normals[c] >= mesh->normal_count)) {
            return sim_fail(error, "corner %zu of the model refers to a vertex or normal that is not there", c);
        }
        if (mesh->texcoords && !(fabs(mesh->texcoords[c][0]) < 1e9 && fabs(mesh->texcoords[c][1]) < 1e9)) {
            return sim_fail(error, "corner %zu of the model has a texture coordinate that is not finite or over 10^9 texels", c);
        }
        const double *at = mesh->positions[mesh->corners[c]];
        if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2])) {
            return sim_fail(error, "vertex %u of the model is not finite: (%g, %g, %g)", mesh->corners[c], at[0], at[1], at[2]);
        }
    }
    return 0;
}

typedef struct compiling {
    solid_t solid;
    clusters_t clusters;
    tree_t tree;
    mesh_tree_report_t counts;
} compiling_t;

static void count_tree(mesh_tree_report_t *counts, const tree_t *tree, const space_t *space) {
    for (size_t n = 0; n < tree->node_count; n++) {
        ++*(tree->nodes[n].kind == TREE_CONVEX ? &counts->convex_nodes : &counts->plane_nodes);
    }
    counts->depth = tree->depth;
    counts->splits = space->splits;
    counts->non_planar = space->non_planar;
}

/* The solid in the order of its display tree, in place of the one that was. */
static int compile_tree(compiling_t *c, const mesh_options_t *options, sim_error_t *error) {
    space_t space;
    solid_t ordered = {0};
    tree_counts_t counts = {0};
    c->counts.faces_in = c->solid.face_count;
    int status = space_open(&space, &c->solid) ? 0 : sim_fail(error, "out of memory for %zu faces", c->solid.face_count);
    if (!status) { status = tree_build(&c->tree, &space, options, error); }
    if (!status) { status = tree_make_solid(&c->tree, &space, &ordered, options, &counts, error); }
    count_tree(&c->counts, &c->tree, &space);
    c->counts.faces_out = ordered.face_count;
    c->counts.seam_corners = counts.seam_corners;
    c->counts.dropped = counts.dropped;
    space_close(&space);
    solid_free(&c->solid);
    c->solid = ordered;
    if (!status) { status = tree_cut_clusters(&c->tree, &c->solid, &c->clusters, error); }
    if (!status) { status = tree_write_words(&c->tree, &c->clusters, error); }
    c->counts.size_bytes = 4 * c->tree.word_count;
    return status;
}

static int compile(const mesh_t *mesh, const mesh_options_t *options, uint8_t **bytes, size_t *size_bytes, mesh_report_t *report,
                   sim_error_t *error) {
    compiling_t c = {.counts = {0}};
    size_t vertex_count = 0;
    if (mesh->morph.positions && options->tree) {
        return sim_fail(error, "a display tree holds for one key frame, and the model has two; leave the tree out");
    }
    int status = solid_quantise(&c.solid, mesh, options, error);
    if (!status && options->tree) {
        status = compile_tree(&c, options, error);
    } else if (!status) {
        status = clusters_grow(&c.clusters, &c.solid, options->keep_order, error);
    }
    const tree_section_t tree = {c.tree.words, c.tree.word_count, c.tree.depth};
    if (!status) {
        status = solid_encode(&c.solid, &c.clusters, mesh, options->tree ? &tree : NULL, bytes, size_bytes, &vertex_count, error);
    }
    if (!status && report) {
        *report = (mesh_report_t){.vertices = vertex_count,
                                  .faces = c.solid.face_count,
                                  .polygons = c.solid.polygons,
                                  .non_planar = c.solid.non_planar,
                                  .split = c.solid.split,
                                  .skipped = mesh->skipped_count + c.solid.skipped,
                                  .clusters = c.clusters.count,
                                  .size_bytes = *size_bytes,
                                  .tree = c.counts,
                                  .quantisation_error = c.solid.error};
    }
    tree_free(&c.tree);
    clusters_free(&c.clusters);
    solid_free(&c.solid);
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
