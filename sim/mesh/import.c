/* Model files through Assimp's C API, without any of its post-processing: polygons stay polygons and faces stay in order. */
#include "import.h"

#include <assimp/cimport.h>
#include <math.h>
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

int import_no_memory(const collector_t *c) {
    return sim_fail(c->error, "%s: out of memory after %zu faces; export a smaller model", c->path, c->mesh.face_count);
}

/* Of the channel that the material names, else of the first; NULL: none. */
static const struct aiVector3D *texcoords_of(const struct aiMesh *from, const import_material_t *material) {
    const unsigned channel = material->channel < AI_MAX_NUMBER_OF_TEXTURECOORDS ? material->channel : 0;
    return from->mTextureCoords[channel] ? from->mTextureCoords[channel] : from->mTextureCoords[0];
}

/* Texture coordinates and colours of vertices whose places are collected. Assimp's v goes upwards. */
static void collect_varying(collector_t *c, const struct aiMesh *from, const import_material_t *material) {
    const bool textured = material->surface.texture != TUILE_NO_TEXTURE;
    const struct aiVector3D *texcoords = textured ? texcoords_of(from, material) : NULL;
    const struct aiColor4D *colours = from->mColors[0];
    if (textured && !texcoords && from->mNumFaces) {
        mesh_warn(&c->mesh,
                  "mesh \"%.60s\": its material \"%s\" has a texture, but it has no texture coordinates; it is drawn without",
                  from->mName.data, material->name);
    }
    for (unsigned v = 0; v < from->mNumVertices; v++) {
        double *texcoord = c->texcoords[c->mesh.position_count + v];
        uint8_t *tint = c->tints[c->mesh.position_count + v];
        texcoord[0] = texcoords ? (double)texcoords[v].x + 0.0 : 0;
        texcoord[1] = texcoords ? 1 - (double)texcoords[v].y : 0;
        memset(tint, 255, sizeof *c->tints);
        if (colours) {
            const double channels[4] = {(double)colours[v].r, (double)colours[v].g, (double)colours[v].b, (double)colours[v].a};
            for (int k = 0; k < 4; k++) {
                tint[k] = import_byte(channels[k]);
            }
        }
    }
    c->textured = c->textured || texcoords;
    c->tinted = c->tinted || colours;
}

/* Appends the vertices of one instance of a mesh; what its indices have to be raised by is the count before. */
static int collect_vertices(collector_t *c, const struct aiMesh *from, const matrix_t *matrix, const import_material_t *material) {
    mesh_t *mesh = &c->mesh;
    size_t count = mesh->position_count + from->mNumVertices;
    if (count >= UINT32_MAX || !mesh_reserve(&mesh->positions, &c->positions, count, sizeof *mesh->positions) ||
        !mesh_reserve(&mesh->normals, &c->normals, count, sizeof *mesh->normals) ||
        !mesh_reserve(&c->texcoords, &c->texcoord_room, count, sizeof *c->texcoords) ||
        !mesh_reserve(&c->tints, &c->tint_room, count, sizeof *c->tints)) {
        return import_no_memory(c);
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
    collect_varying(c, from, material);
    mesh->position_count = count;
    return 0;
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
        colour[k] = import_byte(sum[k] / face->mNumIndices);
    }
}

static int collect_face(collector_t *c, const struct aiMesh *from, const struct aiFace *face, size_t base, bool mirrored,
                        const import_material_t *material) {
    mesh_t *mesh = &c->mesh;
    unsigned count = face->mNumIndices;
    if (!mesh_reserve(&mesh->corners, &c->corners, mesh->corner_count + count, sizeof *mesh->corners) ||
        !mesh_reserve(&mesh->faces, &c->faces, mesh->face_count + 1, sizeof *mesh->faces) ||
        !mesh_reserve(&c->colour, &c->colours, mesh->face_count + 1, sizeof *c->colour) ||
        !mesh_reserve(&c->material, &c->face_materials, mesh->face_count + 1, sizeof *c->material) ||
        mesh->corner_count + count >= UINT32_MAX) {
        return import_no_memory(c);
    }
    for (unsigned i = 0; i < count; i++) { /* a reflection turns the winding; the first corner stays the first */
        unsigned from_corner = mirrored && i ? count - i : i;
        mesh->corners[mesh->corner_count + i] = (uint32_t)(base + face->mIndices[from_corner]);
    }
    memcpy(c->colour[mesh->face_count], material->colour, 3);
    if (from->mColors[0]) { mean_colour(from, face, c->colour[mesh->face_count]); }
    c->material[mesh->face_count] = 4 * (uint32_t)(material - c->materials);
    if (from->mColors[0]) { c->material[mesh->face_count] |= IMPORT_TINTED; }
    if (!texcoords_of(from, material)) { c->material[mesh->face_count] |= IMPORT_BARE; }
    mesh->faces[mesh->face_count++] =
        (mesh_face_t){.first = (uint32_t)mesh->corner_count, .count = count, .source = (uint32_t)(mesh->source_face_count - 1)};
    mesh->corner_count += count;
    return 0;
}

static int collect_mesh(collector_t *c, const struct aiMesh *from, const matrix_t *matrix) {
    const unsigned loose = aiPrimitiveType_POINT | aiPrimitiveType_LINE;
    size_t base = c->mesh.position_count;
    bool mirrored = determinant(matrix) < 0;
    if (from->mNumFaces && !from->mVertices) {
        return sim_fail(c->error, "%s: mesh \"%.60s\" has faces but no vertices; export it again", c->path, from->mName.data);
    }
    const import_material_t *material = import_material(c, from->mMaterialIndex);
    if (!material || collect_vertices(c, from, matrix, material)) { return -1; }
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
        if (c->mesh.source_face_count++ >= UINT32_MAX - 1) { return import_no_memory(c); }
        if (face->mNumIndices < 3) {
            c->mesh.skipped_count++;
        } else if (collect_face(c, from, face, base, mirrored, material)) {
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

static int collect(collector_t *c) {
    const matrix_t identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    if (c->scene->mRootNode && collect_node(c, c->scene->mRootNode, &identity, 0)) { return -1; }
    bool bare = c->mesh.position_count == 0; /* no node has a mesh: then they stand as they are */
    for (unsigned m = 0; bare && m < c->scene->mNumMeshes; m++) {
        if (collect_mesh(c, c->scene->mMeshes[m], &identity)) { return -1; }
    }
    return 0;
}

/* ---- files -------------------------------------------------------------------------------------------------- */

/* Opens and collects; the collector is to be closed in any case. */
static int collector_read(collector_t *c) {
    char *text;
    size_t size_bytes;
    if (mesh_read_file(c->path, &text, &size_bytes, c->error)) { return -1; }
    int status = mesh_check_text(c->path, text, size_bytes, !c->options->no_textures, c->error);
    free(text);
    if (status) { return -1; }
    log_catch_t caught = {{0}};
    struct aiLogStream stream = {catch_log, (char *)&caught};
    aiAttachLogStream(&stream); /* also keeps Assimp's messages off the console */
    c->scene = aiImportFile(c->path, 0);
    (void)aiDetachLogStream(&stream);
    if (!c->scene) {
        char reason[301];
        (void)snprintf(reason, sizeof reason, "%s", aiGetErrorString());
        for (char *p = reason; (p = strpbrk(p, "\r\n"));) { /* some run over several lines */
            *p = ' ';
        }
        return sim_fail(c->error, "%s: %s; export it again or convert it to OBJ", c->path, reason);
    }
    const char *dot = strrchr(c->path, '.');
    c->flat_normals = dot && !strcasecmp(dot, ".stl");
    return caught.text[0] ? sim_fail(c->error, "%s: %.300s; the file is damaged, export it again", c->path, caught.text)
                          : collect(c);
}

static void collector_close(collector_t *c) {
    if (c->scene) { aiReleaseImport(c->scene); }
    free(c->texcoords);
    free(c->tints);
    free(c->colour);
    free(c->material);
    free(c->materials);
    mesh_free(&c->mesh);
}

int mesh_import_with(mesh_t *mesh, const char *path, const mesh_options_t *options, sim_error_t *error) {
    static const mesh_options_t defaults = {0};
    mesh_options_t plain = options ? *options : defaults;
    collector_t first = {.path = path, .options = options ? options : &defaults, .error = error};
    plain.no_textures = true; /* of the second key frame only places count */
    collector_t second = {.path = plain.morph_path, .options = &plain, .error = error};
    memset(mesh, 0, sizeof *mesh);
    int status = collector_read(&first);
    if (!status && second.path) { status = collector_read(&second); }
    if (!status) { status = import_join(&first, second.path ? &second : NULL); }
    if (!status) {
        *mesh = first.mesh;
        memset(&first.mesh, 0, sizeof first.mesh);
    }
    collector_close(&first);
    collector_close(&second);
    return status;
}

int mesh_import(mesh_t *mesh, const char *path, sim_error_t *error) {
    static const mesh_options_t plain = {.no_textures = true, .vertex_colours = MESH_COLOURS_FACES};
    return mesh_import_with(mesh, path, &plain, error);
}
