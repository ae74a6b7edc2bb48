/* Materials of a model file, and the images of their textures. */
#include "image.h"
#include "import.h"
#include "texels.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

void mesh_warn(mesh_t *mesh, const char *format, ...) {
    const size_t used = strlen(mesh->warnings), room = sizeof mesh->warnings - used;
    va_list arguments;
    va_start(arguments, format);
    const int wanted = vsnprintf(mesh->warnings + used, room, format, arguments);
    va_end(arguments);
    if (wanted < 0 || (size_t)wanted + 2 > room) {
        mesh->warnings[used] = 0;
        return;
    }
    memcpy(mesh->warnings + used + wanted, "\n", 2);
}

/* ---- images ------------------------------------------------------------------------------------------------------- */

static bool is_file(const char *path) {
    struct stat status;
    return !stat(path, &status) && !S_ISDIR(status.st_mode);
}

/* Where an image is: as the model file names it, seen from there, else under its bare name beside the model, since exporters like
 * to write down where it lay on their own machine. False: nowhere; path is then where it should be. */
static bool find_image(const char *model_path, const char *named, char *path, size_t size) {
    char name[1024];
    const char *slash = strrchr(model_path, '/');
    const int folder = slash ? (int)(slash - model_path + 1) : 0;
    (void)snprintf(name, sizeof name, "%s", named);
    for (char *p = name; (p = strchr(p, '\\'));) {
        *p = '/';
    }
    const char *start = name, *bare = strrchr(name, '/');
    while (!strncmp(start, "./", 2)) {
        start += 2;
    }
    if (bare) {
        (void)snprintf(path, size, "%.*s%s", folder, model_path, bare + 1);
        if (name[0] != '/') {
            char beside[2048];
            (void)snprintf(beside, sizeof beside, "%.*s%s", folder, model_path, start);
            if (is_file(beside) || !is_file(path)) { (void)snprintf(path, size, "%s", beside); }
        } else if (is_file(name)) {
            (void)snprintf(path, size, "%s", name);
        }
    } else {
        (void)snprintf(path, size, "%.*s%s", folder, model_path, start);
    }
    return is_file(path);
}

/* Named "*3", by its number, or by its file's name. NULL: not embedded. */
static const struct aiTexture *find_embedded(const struct aiScene *scene, const char *named) {
    char *end;
    const unsigned long number = named[0] == '*' ? strtoul(named + 1, &end, 10) : ULONG_MAX;
    if (number < scene->mNumTextures && *end == 0) { return scene->mTextures[number]; }
    for (unsigned t = 0; t < scene->mNumTextures; t++) {
        if (scene->mTextures[t]->mFilename.length && !strcmp(scene->mTextures[t]->mFilename.data, named)) {
            return scene->mTextures[t];
        }
    }
    return NULL;
}

static int embedded_image(const struct aiTexture *from, image_t *image, const char *label, sim_error_t *error) {
    if (from->mHeight == 0) { return image_decode(image, (const uint8_t *)from->pcData, from->mWidth, label, error); }
    const size_t count = (size_t)from->mWidth * from->mHeight;
    if (from->mWidth < 1 || from->mWidth > IMAGE_SIDE_MAX || from->mHeight > IMAGE_SIDE_MAX) {
        return sim_fail(error, "%s: is %ux%u pixels; 1x1 to %ux%u fit", label, from->mWidth, from->mHeight, IMAGE_SIDE_MAX,
                        IMAGE_SIDE_MAX);
    }
    *image = (image_t){from->mWidth, from->mHeight, mesh_array(count, sizeof *image->pixels)};
    if (!image->pixels) { return sim_fail(error, "%s: out of memory", label); }
    for (size_t i = 0; i < count; i++) {
        const struct aiTexel *texel = &from->pcData[i];
        const uint8_t pixel[4] = {texel->r, texel->g, texel->b, texel->a};
        memcpy(image->pixels[i], pixel, sizeof pixel);
    }
    return 0;
}

static int read_image(const collector_t *c, const import_material_t *material, const char *named, image_t *image, char label[600]) {
    char path[2048], *bytes;
    size_t size_bytes;
    const struct aiTexture *embedded = find_embedded(c->scene, named);
    (void)snprintf(label, 600, "%.200s: material \"%s\": texture \"%.200s\"", c->path, material->name, named);
    if (embedded) { return embedded_image(embedded, image, label, c->error); }
    if (!find_image(c->path, named, path, sizeof path)) {
        return sim_fail(c->error, "%s is not there (%.200s); put it there, or draw without textures (--no-textures)", label, path);
    }
    (void)snprintf(label, 600, "%.200s: material \"%s\": texture \"%.200s\"", c->path, material->name, path);
    sim_error_t inner = {""};
    if (mesh_read_file(path, &bytes, &size_bytes, &inner)) {
        return sim_fail(c->error, "%.100s: material \"%s\": %.300s", c->path, material->name, inner.text);
    }
    const int status = image_decode(image, (const uint8_t *)bytes, size_bytes, label, c->error);
    free(bytes);
    return status;
}

/* ---- textures ----------------------------------------------------------------------------------------------------- */

static bool is_set(const struct aiMaterial *from, const char *key, const char *value) {
    struct aiString text;
    return aiGetMaterialString(from, key, 0, 0, &text) == aiReturn_SUCCESS && !strcmp(text.data, value);
}

/* The number of the texture with this image and these flags, made if it is new; -1: error is set. */
static int enter_texture(collector_t *c, const import_material_t *material, const char *named, unsigned flags, bool opaque) {
    mesh_t *mesh = &c->mesh;
    char label[600];
    image_t image = {0};
    for (size_t t = 0; t < mesh->texture_count; t++) {
        if (!strcmp(mesh->textures[t].name, named) &&
            (mesh->textures[t].flags & (TUILE_TEXTURE_CLAMP_S | TUILE_TEXTURE_CLAMP_T)) == flags) {
            return (int)t;
        }
    }
    if (mesh->texture_count >= TUILE_NO_TEXTURE) {
        return sim_fail(c->error, "%s: has more than %u textures; draw without (--no-textures)", c->path, TUILE_NO_TEXTURE);
    }
    mesh_texture_t *textures = realloc(mesh->textures, (mesh->texture_count + 1) * sizeof *textures);
    if (!textures) { return import_no_memory(c); }
    mesh->textures = textures;
    if (read_image(c, material, named, &image, label)) { return -1; }
    for (size_t i = 0; opaque && i < (size_t)image.width * image.height; i++) {
        image.pixels[i][3] = 255;
    }
    mesh_texture_t *texture = &textures[mesh->texture_count];
    const int status = texels_make(texture, &image, flags, c->options, label, c->error);
    image_free(&image);
    if (status) { return -1; }
    texture->name = strdup(named);
    mesh->texture_count++;
    return texture->name ? (int)mesh->texture_count - 1 : import_no_memory(c);
}

static bool is_transformed(const struct aiMaterial *from, enum aiTextureType type) {
    float of[5] = {0, 0, 1, 1, 0}; /* translation, scaling, rotation: struct aiUVTransform */
    unsigned count = 5;
    return aiGetMaterialFloatArray(from, _AI_MATKEY_UVTRANSFORM_BASE, (unsigned)type, 0, of, &count) == aiReturn_SUCCESS &&
           (of[0] < 0 || of[0] > 0 || of[1] < 0 || of[1] > 0 || of[2] < 1 || of[2] > 1 || of[3] < 1 || of[3] > 1 || of[4] < 0 ||
            of[4] > 0);
}

static int import_texture(collector_t *c, const struct aiMaterial *from, import_material_t *to) {
    enum aiTextureType type = aiTextureType_DIFFUSE;
    struct aiString named;
    enum aiTextureMapping mapping = aiTextureMapping_UV;
    enum aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned flags = 0;
    if (aiGetMaterialTextureCount(from, type) == 0) { type = aiTextureType_BASE_COLOR; }
    if (c->options->no_textures || aiGetMaterialTextureCount(from, type) == 0 ||
        aiGetMaterialTexture(from, type, 0, &named, &mapping, &to->channel, NULL, NULL, modes, NULL) != aiReturn_SUCCESS ||
        named.length == 0) {
        return 0;
    }
    if (mapping != aiTextureMapping_UV) {
        mesh_warn(&c->mesh, "material \"%s\": its texture is projected, which is not done; it is left out", to->name);
        return 0;
    }
    if (is_transformed(from, type)) {
        mesh_warn(&c->mesh, "material \"%s\": its texture is moved, scaled or turned; that is left out", to->name);
    }
    for (int axis = 0; axis < 2; axis++) {
        if (modes[axis] == aiTextureMapMode_Clamp || modes[axis] == aiTextureMapMode_Decal) {
            flags |= axis ? TUILE_TEXTURE_CLAMP_T : TUILE_TEXTURE_CLAMP_S;
        } else if (modes[axis] == aiTextureMapMode_Mirror) {
            mesh_warn(&c->mesh, "material \"%s\": its texture is mirrored along %c; it is repeated", to->name, axis ? 't' : 's');
        }
    }
    const int texture = enter_texture(c, to, named.data, flags, is_set(from, "$mat.gltf.alphaMode", "OPAQUE"));
    if (texture < 0) { return -1; }
    to->surface.texture = (uint8_t)texture;
    if (c->options->bilinear) { to->surface.flags |= TUILE_MATERIAL_BILINEAR; }
    /* In glTF a texture is multiplied by the material's colour. In the older formats, as tools write and read them, it takes its
     * place. */
    struct aiString mode;
    if (aiGetMaterialString(from, "$mat.gltf.alphaMode", 0, 0, &mode) != aiReturn_SUCCESS) {
        to->surface.flags |= TUILE_MATERIAL_REPLACED;
    }
    return 0;
}

/* ---- materials ---------------------------------------------------------------------------------------------------- */

static double number_of(const struct aiMaterial *from, const char *key, double otherwise) {
    float value;
    unsigned count = 1;
    return aiGetMaterialFloatArray(from, key, 0, 0, &value, &count) == aiReturn_SUCCESS && count == 1 ? (double)value : otherwise;
}

static void bytes_of(const struct aiColor4D *colour, uint8_t bytes[3]) {
    bytes[0] = import_byte((double)colour->r);
    bytes[1] = import_byte((double)colour->g);
    bytes[2] = import_byte((double)colour->b);
}

/* is_ply: Assimp calls all faces of such files two-sided; here they are taken as they are turned. */
static void import_light(const struct aiMaterial *from, bool is_ply, import_material_t *to) {
    struct aiColor4D colour;
    tuile_material_t *surface = &to->surface;
    if (aiGetMaterialColor(from, AI_MATKEY_COLOR_EMISSIVE, &colour) == aiReturn_SUCCESS) { bytes_of(&colour, surface->emission); }
    const double exponent = number_of(from, "$mat.shininess", 0);
    if (exponent > 0 && aiGetMaterialColor(from, AI_MATKEY_COLOR_SPECULAR, &colour) == aiReturn_SUCCESS) {
        const double level = fmax((double)colour.r, fmax((double)colour.g, (double)colour.b));
        surface->specular = import_byte(level * number_of(from, "$mat.shinpercent", 1));
        if (surface->specular) { surface->shininess = (uint8_t)fmax(0, fmin(MODEL_SHININESS_MAX, round(log2(exponent)))); }
    }
    if (!is_set(from, "$mat.gltf.alphaMode", "OPAQUE")) { surface->alpha = import_byte(number_of(from, "$mat.opacity", 1)); }
    int number = 0;
    if (!is_ply && aiGetMaterialInteger(from, AI_MATKEY_TWOSIDED, &number) == aiReturn_SUCCESS && number) {
        surface->flags |= TUILE_MATERIAL_TWO_SIDED;
    }
    number = 0;
    if (aiGetMaterialInteger(from, "$mat.gltf.unlit", 0, 0, &number) == aiReturn_SUCCESS && number) {
        surface->flags |= TUILE_MATERIAL_UNLIT;
    }
}

const import_material_t *import_material(collector_t *c, unsigned index) {
    const unsigned count = c->scene->mNumMaterials;
    if (!c->materials) { c->materials = mesh_array((size_t)count + 1, sizeof *c->materials); }
    if (!c->materials) { return import_no_memory(c), NULL; }
    import_material_t *to = &c->materials[index < count ? index : count];
    if (to->used) { return to; }
    struct aiColor4D diffuse = {0.8F, 0.8F, 0.8F, 1};
    *to = (import_material_t){.used = true, .surface = {.alpha = 255, .texture = TUILE_NO_TEXTURE}};
    if (index < count) {
        const struct aiMaterial *from = c->scene->mMaterials[index];
        struct aiString name = {0};
        (void)aiGetMaterialString(from, AI_MATKEY_NAME, &name);
        (void)snprintf(to->name, sizeof to->name, "%.60s", name.data);
        (void)aiGetMaterialColor(from, AI_MATKEY_COLOR_DIFFUSE, &diffuse);
        const char *dot = strrchr(c->path, '.');
        import_light(from, dot && !strcasecmp(dot, ".ply"), to);
        if (import_texture(c, from, to)) { return NULL; }
    }
    bytes_of(&diffuse, to->colour);
    return to;
}
