/* From what was collected to one mesh: places joined, materials, texture coordinates in texels, normals, a second key frame. */
#include "import.h"

#include <math.h>
#include <meshoptimizer.h>
#include <string.h>

/* ---- the second key frame ------------------------------------------------------------------------------------ */

/* The same faces, corner by corner, in the order in which both files were read. */
static int same_faces(const collector_t *c, const collector_t *second) {
    const mesh_t *a = &c->mesh, *b = &second->mesh;
    if (a->source_face_count != b->source_face_count || a->face_count != b->face_count) {
        return sim_fail(c->error, "%s has %zu faces (%zu of them degenerate) and %s %zu (%zu): key frames need the same faces",
                        c->path, a->source_face_count, a->skipped_count, second->path, b->source_face_count, b->skipped_count);
    }
    if (a->position_count != b->position_count) {
        return sim_fail(c->error, "%s has %zu vertices and %s %zu: key frames need the same vertices", c->path, a->position_count,
                        second->path, b->position_count);
    }
    for (size_t f = 0; f < a->face_count; f++) {
        const mesh_face_t *p = &a->faces[f], *q = &b->faces[f];
        if (p->count != q->count || p->source != q->source) {
            return sim_fail(c->error, "face %u has %u corners in %s and %u in %s: key frames need the same faces", p->source,
                            p->count, c->path, q->count, second->path);
        }
        for (uint32_t i = 0; i < p->count; i++) {
            const uint32_t v = a->corners[p->first + i], w = b->corners[q->first + i];
            if (v != w) {
                return sim_fail(c->error, "corner %u of face %u is vertex %u in %s and %u in %s: key frames need the same faces", i,
                                p->source, v, c->path, w, second->path);
            }
        }
    }
    return 0;
}

/* Places and normals of each vertex, before they are joined. */
static bool take_second(collector_t *c, const collector_t *second) {
    mesh_morph_t *morph = &c->mesh.morph;
    const size_t count = second->mesh.position_count;
    morph->positions = mesh_array(count, sizeof *morph->positions);
    morph->normals = mesh_array(count, sizeof *morph->normals);
    morph->corner_normals = mesh_array(second->mesh.corner_count, sizeof *morph->corner_normals);
    if (!morph->positions || !morph->normals || !morph->corner_normals) { return false; }
    memcpy(morph->positions, second->mesh.positions, count * sizeof *morph->positions);
    memcpy(morph->normals, second->mesh.normals, count * sizeof *morph->normals);
    morph->normal_count = count;
    return true;
}

/* ---- joining ------------------------------------------------------------------------------------------------- */

static bool distinct_corners(const mesh_t *mesh, const mesh_face_t *face) {
    const uint32_t *corner = mesh->corners + face->first;
    uint32_t second = corner[0];
    for (uint32_t i = 1; i < face->count; i++) {
        if (corner[i] != corner[0] && second == corner[0]) {
            second = corner[i];
        } else if (corner[i] != corner[0] && corner[i] != second) {
            return true;
        }
    }
    return false;
}

/* A number for each place; with a second key frame, for each pair of places. 0 without memory. */
static size_t number_places(const mesh_t *mesh, uint32_t *remap) {
    const size_t count = mesh->position_count;
    if (!mesh->morph.positions) {
        return meshopt_generateVertexRemap(remap, NULL, count, mesh->positions, count, sizeof *mesh->positions);
    }
    double(*pairs)[6] = mesh_array(count, sizeof *pairs);
    for (size_t v = 0; pairs && v < count; v++) {
        memcpy(pairs[v], mesh->positions[v], sizeof *mesh->positions);
        memcpy(pairs[v] + 3, mesh->morph.positions[v], sizeof *mesh->positions);
    }
    const size_t places = pairs ? meshopt_generateVertexRemap(remap, NULL, count, pairs, count, sizeof *pairs) : 0;
    free(pairs);
    return places;
}

static uint32_t normal_of(const double (*normals)[3], uint32_t vertex) {
    const double *normal = normals[vertex];
    return normal[0] == 0 && normal[1] == 0 && normal[2] == 0 ? MESH_NO_NORMAL : vertex;
}

/* What stands at each vertex is given to the corners. */
static void spread(collector_t *c) {
    mesh_t *mesh = &c->mesh;
    for (size_t i = 0; i < mesh->corner_count; i++) {
        const uint32_t vertex = mesh->corners[i];
        mesh->corner_normals[i] = normal_of((const double(*)[3])mesh->normals, vertex);
        if (mesh->morph.positions) { mesh->morph.corner_normals[i] = normal_of((const double(*)[3])mesh->morph.normals, vertex); }
        if (mesh->texcoords) { memcpy(mesh->texcoords[i], c->texcoords[vertex], sizeof *mesh->texcoords); }
        if (mesh->colours) { memcpy(mesh->colours[i], c->tints[vertex], sizeof *mesh->colours); }
    }
}

static void drop_degenerate(collector_t *c) {
    mesh_t *mesh = &c->mesh;
    size_t kept = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        if (distinct_corners(mesh, &mesh->faces[f])) {
            memmove(c->colour[kept], c->colour[f], sizeof *c->colour);
            c->material[kept] = c->material[f];
            mesh->faces[kept++] = mesh->faces[f];
        }
    }
    mesh->skipped_count += mesh->face_count - kept;
    mesh->face_count = kept;
}

static int join(collector_t *c) {
    mesh_t *mesh = &c->mesh;
    uint32_t *remap = mesh_array(mesh->position_count, sizeof *remap);
    mesh->corner_normals = mesh_array(mesh->corner_count, sizeof *mesh->corner_normals);
    if (c->textured) { mesh->texcoords = mesh_array(mesh->corner_count, sizeof *mesh->texcoords); }
    if (c->tinted) { mesh->colours = mesh_array(mesh->corner_count, sizeof *mesh->colours); }
    const size_t count = remap ? number_places(mesh, remap) : 0;
    if (!count || !mesh->corner_normals || (c->textured && !mesh->texcoords) || (c->tinted && !mesh->colours)) {
        free(remap);
        return import_no_memory(c);
    }
    spread(c);
    for (size_t i = 0; i < mesh->corner_count; i++) {
        mesh->corners[i] = remap[mesh->corners[i]];
    }
    for (size_t v = 0; v < mesh->position_count; v++) { /* in place: a position never moves up */
        memmove(mesh->positions[remap[v]], mesh->positions[v], sizeof *mesh->positions);
        if (mesh->morph.positions) {
            memmove(mesh->morph.positions[remap[v]], mesh->morph.positions[v], sizeof *mesh->morph.positions);
        }
    }
    free(remap);
    mesh->normal_count = mesh->position_count;
    mesh->position_count = count;
    drop_degenerate(c);
    return 0;
}

/* ---- vertex colours ------------------------------------------------------------------------------------------ */

/* Vertex colours are kept where a mean for each face would lose something, unless options say what to do. */
static bool keeps_tints(const collector_t *c) {
    const mesh_t *mesh = &c->mesh;
    if (!mesh->colours || c->options->vertex_colours != MESH_COLOURS_AUTO) {
        return mesh->colours && c->options->vertex_colours == MESH_COLOURS_VERTICES;
    }
    for (size_t f = 0; f < mesh->face_count; f++) {
        const mesh_face_t *face = &mesh->faces[f];
        for (uint32_t i = 0; i < face->count; i++) {
            const uint8_t *colour = mesh->colours[face->first + i];
            if (memcmp(colour, mesh->colours[face->first], sizeof *mesh->colours) != 0 || colour[3] != 255) { return true; }
        }
    }
    return false;
}

/* ---- materials ----------------------------------------------------------------------------------------------- */

typedef struct painter {
    collector_t *c;
    tuile_material_t *kinds; /* distinct materials but for their colours */
    uint32_t *kind;          /* of each face */
    size_t kind_count;
    uint8_t (*wide)[4];
    uint32_t *index, *faces;
} painter_t;

static bool same_surface(const tuile_material_t *a, const tuile_material_t *b) {
    return a->alpha == b->alpha && !memcmp(a->emission, b->emission, sizeof a->emission) && a->specular == b->specular &&
           a->shininess == b->shininess && a->texture == b->texture && a->blend == b->blend && a->flags == b->flags &&
           a->uv_bits == b->uv_bits;
}

static tuile_material_t surface_of(const collector_t *c, size_t face) {
    tuile_material_t surface = c->materials[c->material[face] / 4].surface;
    if (c->material[face] & IMPORT_BARE) {
        surface.texture = TUILE_NO_TEXTURE;
        surface.uv_bits = 0;
        surface.flags = (uint8_t)(surface.flags & ~(unsigned)(TUILE_MATERIAL_BILINEAR | TUILE_MATERIAL_REPLACED));
    }
    if (c->mesh.colours && (c->material[face] & IMPORT_TINTED)) { surface.flags |= TUILE_MATERIAL_VERTEX_COLOURS; }
    return surface;
}

static void find_kinds(painter_t *p) {
    for (size_t f = 0; f < p->c->mesh.face_count; f++) {
        const tuile_material_t surface = surface_of(p->c, f);
        size_t kind = f ? p->kind[f - 1] : 0; /* mostly so */
        if (kind >= p->kind_count || !same_surface(&p->kinds[kind], &surface)) { kind = 0; }
        while (kind < p->kind_count && !same_surface(&p->kinds[kind], &surface)) {
            kind++;
        }
        if (kind == p->kind_count) { p->kinds[p->kind_count++] = surface; }
        p->kind[f] = (uint32_t)kind;
    }
}

/* Each pair of kind and colour is a material, in order of first use. False when there are too many. */
static bool paint_exactly(painter_t *p) {
    mesh_t *mesh = &p->c->mesh;
    uint32_t kinds[MESH_MATERIALS_MAX];
    mesh->material_count = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        size_t m = 0;
        while (m < mesh->material_count && (kinds[m] != p->kind[f] || memcmp(mesh->materials[m], p->c->colour[f], 3) != 0)) {
            m++;
        }
        if (m == MESH_MATERIALS_MAX) { return false; }
        if (m == mesh->material_count) {
            kinds[m] = p->kind[f];
            memcpy(mesh->materials[m], p->c->colour[f], 3);
            mesh->surfaces[mesh->material_count++] = p->kinds[p->kind[f]];
        }
        mesh->faces[f].material = (uint32_t)m;
    }
    return true;
}

/* The same share of the materials for each kind, as a palette of its own. */
static bool paint_kind(painter_t *p, size_t kind) {
    mesh_t *mesh = &p->c->mesh;
    uint8_t palette[MESH_MATERIALS_MAX][4];
    size_t count = 0, entries = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        if (p->kind[f] != kind) { continue; }
        memcpy(p->wide[count], p->c->colour[f], 3);
        p->faces[count++] = (uint32_t)f;
    }
    if (mesh_palette_of((const uint8_t(*)[4])p->wide, count, MESH_MATERIALS_MAX / p->kind_count, palette, &entries, p->index)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        mesh->faces[p->faces[i]].material = (uint32_t)mesh->material_count + p->index[i];
    }
    for (size_t i = 0; i < entries; i++) {
        mesh->surfaces[mesh->material_count] = p->kinds[kind];
        memcpy(mesh->materials[mesh->material_count++], palette[i], 3);
    }
    return true;
}

static int paint_all(painter_t *p) {
    mesh_t *mesh = &p->c->mesh;
    if (p->kind_count > MESH_MATERIALS_MAX) {
        return sim_fail(p->c->error, "%s: has %zu different materials; %u fit", p->c->path, p->kind_count, MESH_MATERIALS_MAX);
    }
    if (p->kind_count > 1 && paint_exactly(p)) { return 0; }
    mesh->material_count = 0;
    for (size_t kind = 0; kind < p->kind_count; kind++) {
        if (!paint_kind(p, kind)) { return import_no_memory(p->c); }
    }
    return 0;
}

static int paint(collector_t *c) {
    mesh_t *mesh = &c->mesh;
    const size_t scene = 4 * ((size_t)c->scene->mNumMaterials + 1);
    painter_t p = {.c = c};
    p.kinds = mesh_array(scene, sizeof *p.kinds);
    p.kind = mesh_array(mesh->face_count, sizeof *p.kind);
    p.wide = mesh_array(mesh->face_count, sizeof *p.wide);
    p.index = mesh_array(mesh->face_count, sizeof *p.index);
    p.faces = mesh_array(mesh->face_count, sizeof *p.faces);
    mesh->materials = mesh_array(MESH_MATERIALS_MAX, sizeof *mesh->materials);
    mesh->surfaces = mesh_array(MESH_MATERIALS_MAX, sizeof *mesh->surfaces);
    int status = 0;
    if (p.kinds && p.kind && p.wide && p.index && p.faces && mesh->materials && mesh->surfaces) {
        find_kinds(&p);
        status = paint_all(&p);
    } else {
        status = import_no_memory(c);
    }
    free(p.kinds);
    free(p.kind);
    free(p.wide);
    free(p.index);
    free(p.faces);
    return status;
}

/* ---- putting it together --------------------------------------------------------------------------------------- */

/* Of the mesh as it stands in the second key frame. */
static int make_second_normals(collector_t *c) {
    mesh_t there = c->mesh;
    there.positions = c->mesh.morph.positions;
    there.normals = c->mesh.morph.normals;
    there.normal_count = c->mesh.morph.normal_count;
    there.corner_normals = c->mesh.morph.corner_normals;
    const int status = mesh_make_normals(&there, false, c->error);
    c->mesh.morph.normals = there.normals;
    c->mesh.morph.normal_count = there.normal_count;
    c->mesh.morph.corner_normals = there.corner_normals;
    return status;
}

int import_join(collector_t *c, const collector_t *second) {
    mesh_t *mesh = &c->mesh;
    if (second && same_faces(c, second)) { return -1; }
    if (second && mesh->source_face_count && !take_second(c, second)) { return import_no_memory(c); }
    if (mesh->source_face_count && join(c)) { return -1; }
    if (mesh->face_count == 0) {
        return sim_fail(c->error, "%s: no face with an area (%zu degenerate faces, %zu points and lines); nothing to draw", c->path,
                        mesh->skipped_count, mesh->loose_count);
    }
    if (!keeps_tints(c)) {
        free(mesh->colours);
        mesh->colours = NULL;
    }
    if ((mesh->texcoords && import_fit_texcoords(c)) || paint(c) || mesh_make_normals(mesh, false, c->error)) { return -1; }
    return mesh->morph.positions ? make_second_normals(c) : 0;
}
