/* Model files through Assimp's C API, without any of its post-processing: polygons stay polygons and faces stay in order. */
#include "stages.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <math.h>
#include <meshoptimizer.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define NODE_DEPTH_MAX 512 /* of the node tree: a file may not decide how deep the stack gets */

/* ---- Assimp's log ------------------------------------------------------------------------------------------- */

typedef struct log_catch {
    char text[256]; /* the first message that tells of damage */
} log_catch_t;

/* Assimp reports some damage only here, in passing, and goes on. Its other warnings and errors (a missing material file, a
 * texture) leave the faces whole. */
static void catch_log(const char *message, char *user) {
    static const char *const damage[] = {"unexpected EOF", "unexpected end", "Unexpected end",
                                         "is incorrect",   "out of range",   "truncated"};
    log_catch_t *caught = (log_catch_t *)(void *)user;
    if (caught->text[0] || (strncmp(message, "Warn", 4) && strncmp(message, "Error", 5))) { return; }
    const char *text = strstr(message, ": ");
    text = text ? text + 2 : message;
    for (size_t i = 0; i < sizeof damage / sizeof *damage; i++) {
        if (strstr(text, damage[i])) {
            (void)snprintf(caught->text, sizeof caught->text, "%s", text);
            caught->text[strcspn(caught->text, "\r\n")] = 0;
        }
    }
}

/* ---- collecting --------------------------------------------------------------------------------------------- */

typedef struct collector {
    const char *path;
    const struct aiScene *scene;
    bool flat_normals; /* those of the file are of facets: of no use for smooth shading */
    mesh_t mesh;
    size_t positions, normals, corners, corner_normals, faces, colours; /* capacities */
    uint8_t (*colour)[3];                                               /* of each face */
    sim_error_t *error;
} collector_t;

typedef struct matrix {
    double m[3][4];
} matrix_t;

static matrix_t multiply(const matrix_t *a, const struct aiMatrix4x4 *b) {
    const double right[4][4] = {{(double)b->a1, (double)b->a2, (double)b->a3, (double)b->a4},
                                {(double)b->b1, (double)b->b2, (double)b->b3, (double)b->b4},
                                {(double)b->c1, (double)b->c2, (double)b->c3, (double)b->c4},
                                {0, 0, 0, 1}};
    matrix_t product = {{{0}}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            product.m[i][j] = j == 3 ? a->m[i][3] : 0;
            for (int k = 0; k < 3; k++) {
                product.m[i][j] += a->m[i][k] * right[k][j];
            }
        }
    }
    return product;
}

static double determinant(const matrix_t *matrix) {
    const double(*m)[4] = matrix->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Normals go by the inverse transpose, which is the matrix of cofactors but for a factor whose sign counts. False for a normal
 * that is of no use. */
static bool transform_normal(const matrix_t *matrix, double sign, const struct aiVector3D *from, double to[3]) {
    const double(*m)[4] = matrix->m;
    const double v[3] = {(double)from->x, (double)from->y, (double)from->z};
    double squares = 0;
    for (int i = 0; i < 3; i++) {
        int a = (i + 1) % 3, b = (i + 2) % 3;
        to[i] = 0;
        for (int j = 0; j < 3; j++) {
            int c = (j + 1) % 3, d = (j + 2) % 3;
            to[i] += sign * (m[a][c] * m[b][d] - m[a][d] * m[b][c]) * v[j];
        }
        squares += to[i] * to[i];
    }
    double length = sqrt(squares);
    if (!(length > 0) || !isfinite(length)) { return false; }
    for (int i = 0; i < 3; i++) {
        to[i] = to[i] / length + 0.0;
    }
    return true;
}

static int no_memory(const collector_t *c) {
    return sim_fail(c->error, "%s: out of memory after %zu faces; export a smaller model", c->path, c->mesh.face_count);
}

/* Appends the vertices of one instance of a mesh; what its indices have to be raised by is the count before. */
static int collect_vertices(collector_t *c, const struct aiMesh *from, const matrix_t *matrix) {
    mesh_t *mesh = &c->mesh;
    size_t count = mesh->position_count + from->mNumVertices;
    if (count >= UINT32_MAX || !mesh_reserve(&mesh->positions, &c->positions, count, sizeof *mesh->positions) ||
        !mesh_reserve(&mesh->normals, &c->normals, count, sizeof *mesh->normals)) {
        return no_memory(c);
    }
    bool lit = from->mNormals && !c->flat_normals;
    double sign = determinant(matrix) < 0 ? -1 : 1;
    for (unsigned v = 0; v < from->mNumVertices; v++) {
        const struct aiVector3D *at = &from->mVertices[v];
        double *to = mesh->positions[mesh->position_count + v];
        for (int k = 0; k < 3; k++) {
            const double *row = matrix->m[k];
            to[k] = row[0] * (double)at->x + row[1] * (double)at->y + row[2] * (double)at->z + row[3];
            if (!isfinite(to[k])) {
                return sim_fail(c->error, "%s: vertex %u of mesh \"%.60s\" is not finite: (%g, %g, %g); repair or remove it",
                                c->path, v, from->mName.data, (double)at->x, (double)at->y, (double)at->z);
            }
            to[k] += 0.0; /* -0 and 0 are one place */
        }
        double *normal = mesh->normals[mesh->position_count + v];
        if (!lit || !transform_normal(matrix, sign, &from->mNormals[v], normal)) {
            memset(normal, 0, sizeof *mesh->normals); /* marks it as missing */
        }
    }
    mesh->position_count = count;
    return 0;
}

static uint8_t unit_to_byte(double value) { return (uint8_t)(value >= 1 ? 255 : value > 0 ? value * 255 + 0.5 : 0); }

static void material_colour(const struct aiScene *scene, const struct aiMesh *from, uint8_t colour[3]) {
    struct aiColor4D diffuse = {0.8F, 0.8F, 0.8F, 1};
    if (from->mMaterialIndex < scene->mNumMaterials) {
        (void)aiGetMaterialColor(scene->mMaterials[from->mMaterialIndex], AI_MATKEY_COLOR_DIFFUSE, &diffuse);
    }
    colour[0] = unit_to_byte((double)diffuse.r);
    colour[1] = unit_to_byte((double)diffuse.g);
    colour[2] = unit_to_byte((double)diffuse.b);
}

/* Vertex colours take the place of the material's: files that have them rarely mean the product. */
static void mean_colour(const struct aiMesh *from, const struct aiFace *face, uint8_t colour[3]) {
    double sum[3] = {0};
    for (unsigned i = 0; i < face->mNumIndices; i++) {
        const struct aiColor4D *corner = &from->mColors[0][face->mIndices[i]];
        sum[0] += (double)corner->r;
        sum[1] += (double)corner->g;
        sum[2] += (double)corner->b;
    }
    for (int k = 0; k < 3; k++) {
        colour[k] = unit_to_byte(sum[k] / face->mNumIndices);
    }
}

static int collect_face(collector_t *c, const struct aiMesh *from, const struct aiFace *face, size_t base, bool mirrored,
                        const uint8_t colour[3]) {
    mesh_t *mesh = &c->mesh;
    unsigned count = face->mNumIndices;
    if (!mesh_reserve(&mesh->corners, &c->corners, mesh->corner_count + count, sizeof *mesh->corners) ||
        !mesh_reserve(&mesh->faces, &c->faces, mesh->face_count + 1, sizeof *mesh->faces) ||
        !mesh_reserve(&c->colour, &c->colours, mesh->face_count + 1, sizeof *c->colour) ||
        mesh->corner_count + count >= UINT32_MAX) {
        return no_memory(c);
    }
    for (unsigned i = 0; i < count; i++) { /* a reflection turns the winding; the first corner stays the first */
        unsigned from_corner = mirrored && i ? count - i : i;
        mesh->corners[mesh->corner_count + i] = (uint32_t)(base + face->mIndices[from_corner]);
    }
    memcpy(c->colour[mesh->face_count], colour, 3);
    if (from->mColors[0]) { mean_colour(from, face, c->colour[mesh->face_count]); }
    mesh->faces[mesh->face_count++] =
        (mesh_face_t){.first = (uint32_t)mesh->corner_count, .count = count, .source = (uint32_t)(mesh->source_face_count - 1)};
    mesh->corner_count += count;
    return 0;
}

static int collect_mesh(collector_t *c, const struct aiMesh *from, const matrix_t *matrix) {
    const unsigned loose = aiPrimitiveType_POINT | aiPrimitiveType_LINE;
    uint8_t colour[3];
    size_t base = c->mesh.position_count;
    bool mirrored = determinant(matrix) < 0;
    if (from->mNumFaces && !from->mVertices) {
        return sim_fail(c->error, "%s: mesh \"%.60s\" has faces but no vertices; export it again", c->path, from->mName.data);
    }
    if (collect_vertices(c, from, matrix)) { return -1; }
    material_colour(c->scene, from, colour);
    for (unsigned f = 0; f < from->mNumFaces; f++) {
        const struct aiFace *face = &from->mFaces[f];
        for (unsigned i = 0; i < face->mNumIndices; i++) {
            if (face->mIndices[i] >= from->mNumVertices) {
                return sim_fail(c->error,
                                "%s: face %u of mesh \"%.60s\" asks for vertex %u of %u; the file is damaged, export it again",
                                c->path, f, from->mName.data, face->mIndices[i], from->mNumVertices);
            }
        }
        if (face->mNumIndices == 0) {
            return sim_fail(c->error, "%s: face %u of mesh \"%.60s\" has no corners; the file is damaged, export it again", c->path,
                            f, from->mName.data);
        }
        if (face->mNumIndices < 3 && (from->mPrimitiveTypes & loose)) {
            c->mesh.loose_count++;
            continue;
        }
        if (c->mesh.source_face_count++ >= UINT32_MAX - 1) { return no_memory(c); }
        if (face->mNumIndices < 3) {
            c->mesh.skipped_count++;
        } else if (collect_face(c, from, face, base, mirrored, colour)) {
            return -1;
        }
    }
    return 0;
}

static int collect_node(collector_t *c, const struct aiNode *node, const matrix_t *parent, int depth) {
    if (depth > NODE_DEPTH_MAX) {
        return sim_fail(c->error, "%s: its node tree is more than %d deep; export it with fewer levels", c->path, NODE_DEPTH_MAX);
    }
    matrix_t matrix = multiply(parent, &node->mTransformation);
    for (unsigned m = 0; m < node->mNumMeshes; m++) {
        if (node->mMeshes[m] >= c->scene->mNumMeshes) {
            return sim_fail(c->error, "%s: node \"%.60s\" asks for mesh %u of %u; the file is damaged, export it again", c->path,
                            node->mName.data, node->mMeshes[m], c->scene->mNumMeshes);
        }
        if (collect_mesh(c, c->scene->mMeshes[node->mMeshes[m]], &matrix)) { return -1; }
    }
    for (unsigned n = 0; n < node->mNumChildren; n++) { /* the RAW importer leaves gaps */
        if (node->mChildren[n] && collect_node(c, node->mChildren[n], &matrix, depth + 1)) { return -1; }
    }
    return 0;
}

/* ---- joining ------------------------------------------------------------------------------------------------ */

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

/* Joins vertices at equal positions, drops the faces that have fewer than three of them, and sets up materials. */
static int join(collector_t *c) {
    mesh_t *mesh = &c->mesh;
    uint32_t *remap = mesh_array(mesh->position_count, sizeof *remap);
    mesh->corner_normals = mesh_array(mesh->corner_count, sizeof *mesh->corner_normals);
    if (!remap || !mesh->corner_normals) {
        free(remap);
        return no_memory(c);
    }
    size_t count = meshopt_generateVertexRemap(remap, NULL, mesh->position_count, mesh->positions, mesh->position_count,
                                               sizeof *mesh->positions);
    for (size_t i = 0; i < mesh->corner_count; i++) {
        const double *normal = mesh->normals[mesh->corners[i]];
        bool missing = normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
        mesh->corner_normals[i] = missing ? MESH_NO_NORMAL : mesh->corners[i];
        mesh->corners[i] = remap[mesh->corners[i]];
    }
    for (size_t v = 0; v < mesh->position_count; v++) { /* in place: a position never moves up */
        memmove(mesh->positions[remap[v]], mesh->positions[v], sizeof *mesh->positions);
    }
    free(remap);
    mesh->normal_count = mesh->position_count;
    mesh->position_count = count;
    size_t kept = 0;
    for (size_t f = 0; f < mesh->face_count; f++) {
        if (distinct_corners(mesh, &mesh->faces[f])) {
            memmove(c->colour[kept], c->colour[f], sizeof *c->colour);
            mesh->faces[kept++] = mesh->faces[f];
        }
    }
    mesh->skipped_count += mesh->face_count - kept;
    mesh->face_count = kept;
    return 0;
}

static int paint(collector_t *c) {
    mesh_t *mesh = &c->mesh;
    uint32_t *index = mesh_array(mesh->face_count, sizeof *index);
    mesh->materials = mesh_array(MESH_MATERIALS_MAX, sizeof *mesh->materials);
    if (!index || !mesh->materials ||
        mesh_palette((const uint8_t(*)[3])c->colour, mesh->face_count, mesh->materials, &mesh->material_count, index)) {
        free(index);
        return no_memory(c);
    }
    for (size_t f = 0; f < mesh->face_count; f++) {
        mesh->faces[f].material = index[f];
    }
    free(index);
    return 0;
}

static int collect(collector_t *c) {
    const matrix_t identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    if (c->scene->mRootNode && collect_node(c, c->scene->mRootNode, &identity, 0)) { return -1; }
    bool bare = c->mesh.position_count == 0; /* no node has a mesh: then they stand as they are */
    for (unsigned m = 0; bare && m < c->scene->mNumMeshes; m++) {
        if (collect_mesh(c, c->scene->mMeshes[m], &identity)) { return -1; }
    }
    if (c->mesh.source_face_count && join(c)) { return -1; }
    if (c->mesh.face_count == 0) {
        return sim_fail(c->error, "%s: no face with an area (%zu degenerate faces, %zu points and lines); nothing to draw", c->path,
                        c->mesh.skipped_count, c->mesh.loose_count);
    }
    return paint(c) ? -1 : mesh_make_normals(&c->mesh, false, c->error);
}

int mesh_import(mesh_t *mesh, const char *path, sim_error_t *error) {
    char *text;
    size_t size_bytes;
    memset(mesh, 0, sizeof *mesh);
    if (mesh_read_file(path, &text, &size_bytes, error)) { return -1; }
    int status = mesh_check_text(path, text, size_bytes, error);
    free(text);
    if (status) { return -1; }
    log_catch_t caught = {{0}};
    struct aiLogStream stream = {catch_log, (char *)&caught};
    aiAttachLogStream(&stream); /* also keeps Assimp's messages off the console */
    const struct aiScene *scene = aiImportFile(path, 0);
    (void)aiDetachLogStream(&stream);
    if (!scene) {
        char reason[301];
        (void)snprintf(reason, sizeof reason, "%s", aiGetErrorString());
        for (char *p = reason; (p = strpbrk(p, "\r\n"));) { /* some run over several lines */
            *p = ' ';
        }
        return sim_fail(error, "%s: %s; export it again or convert it to OBJ", path, reason);
    }
    const char *dot = strrchr(path, '.');
    collector_t collector = {.path = path, .scene = scene, .flat_normals = dot && !strcasecmp(dot, ".stl"), .error = error};
    status = caught.text[0] ? sim_fail(error, "%s: %.300s; the file is damaged, export it again", path, caught.text)
                            : collect(&collector);
    aiReleaseImport(scene);
    free(collector.colour);
    if (status) {
        mesh_free(&collector.mesh);
        return -1;
    }
    *mesh = collector.mesh;
    return 0;
}
