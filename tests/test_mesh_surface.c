/* Materials, textures and vertex colours from model files to the bytes of a compiled model, read back by offsets written down here.
 */
#include "support/check.h"

#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <math.h>

#include "../raster/tuile.h"
#include "../sim/mesh/mesh.h"
#include "support/built.h"
#include "support/decoder.h"
#include "support/folder.h"
#include "support/images.h"

static void fails(const char *path, const mesh_options_t *options, const char *expected) {
    uint8_t *bytes;
    size_t size;
    sim_error_t error = {""};
    if (mesh_load(path, 0, options, &bytes, &size, NULL, &error) == 0) { fail_msg("loads; expected: %s", expected); }
    assert_null(bytes);
    if (!strstr(error.text, expected)) { fail_msg("got: %s\nexpected: %s", error.text, expected); }
}

static const uint8_t *at(const built_t *b, size_t header) { return b->bytes + decoder_u32(b->bytes + header); }

#define MTL "newmtl striped\nKd 1 0.2 0\nmap_Kd stripes.png\n"
#define TRIANGLE "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"

static const char *put_triangle(const char *mtl, const char *texcoords) {
    char text[1024];
    images_put_stripes("stripes.png");
    (void)folder_put_text("a.mtl", mtl);
    (void)snprintf(text, sizeof text, TRIANGLE "%susemtl striped\nf 1/1 2/2 3/3\n", texcoords);
    return folder_put_text("a.obj", text);
}

/* ---- the bytes ------------------------------------------------------------------------------------------------------ */

static void a_textured_triangle_stands_where_the_layout_says(void **state) {
    (void)state;
    built_t b = built_load(put_triangle(MTL, "vt 0 0\nvt 1 0\nvt 0.25 1\n"), NULL);
    static const uint8_t material[16] = {255, 51, 0, 255, 0, 0, 0, 0, 0, 0, 0, TUILE_MATERIAL_REPLACED, 8, 0, 0, 0};
    static const uint8_t palette[8] = {0x00, 0xf8, 0xe0, 0x07, 0x1f, 0x00, 0xff, 0xff};
    static const uint8_t rows[4] = {0x10, 0x32, 0x10, 0x32};
    assert_int_equal(decoder_u16(b.bytes + 12), 3);
    assert_int_equal(decoder_u16(b.bytes + 32), 1);
    assert_memory_equal(at(&b, 88), material, 16);
    assert_int_equal(decoder_u16(b.bytes + 136), 1);
    assert_int_equal(decoder_u16(b.bytes + 138), 0);
    assert_int_equal(decoder_u32(b.bytes + 128), 0);
    for (unsigned i = 140; i < 152; i += 4) {
        assert_int_equal(decoder_u32(b.bytes + i), 0);
    }
    const uint8_t *texture = at(&b, 132);
    assert_int_equal(decoder_u16(texture + 8), 4);
    assert_int_equal(decoder_u16(texture + 10), 2);
    assert_int_equal(texture[12], TUILE_TEXEL_PALETTE4);
    assert_int_equal(texture[13], 3);
    assert_int_equal(texture[14], 0);
    assert_int_equal(decoder_u32(texture + 15) | texture[19], 0);
    assert_memory_equal(b.bytes + decoder_u32(texture), rows, 4);
    assert_memory_equal(b.bytes + decoder_u32(texture + 4), palette, 8);
    /* Repeats: s 0 ... 1, t = 1 - v 0 ... 1. Middles 1/2 are brought to -1/2: one repeat less. In 1/256 texel of 4 x 2. */
    static const int expected[3][2] = {{-4 * 256, 0}, {0, 0}, {-3 * 256, -2 * 256}};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(decoder_s16(at(&b, 124) + 4 * i), expected[i][0]);
        assert_int_equal(decoder_s16(at(&b, 124) + 4 * i + 2), expected[i][1]);
    }
    free(b.bytes);
}

static void materials_and_textures_are_told_by_the_model(void **state) {
    (void)state;
    built_t b = built_load(
        put_triangle("newmtl striped\nKd 1 0.2 0\nKe 0 0.4 1\nKs 0.2 0.6 0.4\nNs 30\nd 0.2\nmap_Kd -clamp on stripes.png\n",
                     "vt 0 0\nvt 1 0\nvt 0.25 1\n"),
        &(mesh_options_t){.bilinear = true, .texture_format = 1 + TUILE_TEXEL_RGB565, .no_mips = true});
    tuile_model_t model;
    assert_int_equal(tuile_model_open(&model, b.bytes, b.size), 0);
    const tuile_material_t material = tuile_model_material(&model, 0);
    static const uint8_t colour[3] = {255, 51, 0}, emission[3] = {0, 102, 255};
    assert_memory_equal(material.colour, colour, 3);
    assert_memory_equal(material.emission, emission, 3);
    assert_int_equal(material.alpha, 51);
    assert_int_equal(material.specular, 153);
    assert_int_equal(material.shininess, 5); /* 2^4.9 */
    assert_int_equal(material.texture, 0);
    assert_int_equal(material.blend, TUILE_BLEND_OVER);
    assert_int_equal(material.flags, TUILE_MATERIAL_BILINEAR | TUILE_MATERIAL_REPLACED);
    assert_int_equal(material.uv_bits, 8);
    const tuile_texture_t texture = tuile_model_texture(&model, 0);
    assert_int_equal(texture.width, 4);
    assert_int_equal(texture.height, 2);
    assert_int_equal(texture.format, TUILE_TEXEL_RGB565);
    assert_int_equal(texture.levels, 1);
    assert_int_equal(texture.flags, TUILE_TEXTURE_CLAMP_S | TUILE_TEXTURE_CLAMP_T);
    assert_null(texture.palette);
    assert_int_equal(texture.texels[0] | texture.texels[1] << 8, 0xf800);
    /* Clamped: nothing is shifted. */
    assert_int_equal(decoder_s16(model.texcoords), 0);
    assert_int_equal(decoder_s16(model.texcoords + 2), 2 * 256);
    assert_int_equal(decoder_s16(model.texcoords + 8), 256);
    assert_int_equal(decoder_s16(model.texcoords + 10), 0);
    free(b.bytes);
}

static void without_textures_a_model_is_as_it_was(void **state) {
    (void)state;
    built_t b = built_load(put_triangle(MTL, "vt 0 0\nvt 1 0\nvt 0.25 1\n"), &(mesh_options_t){.no_textures = true});
    assert_int_equal(decoder_u32(b.bytes + 124) | decoder_u32(b.bytes + 132) | decoder_u16(b.bytes + 136), 0);
    assert_int_equal(at(&b, 88)[9], 255);
    (void)remove(folder_path("stripes.png")); /* images are not looked for */
    built_t again = built_load(folder_path("a.obj"), &(mesh_options_t){.no_textures = true});
    assert_int_equal(again.size, b.size);
    assert_memory_equal(again.bytes, b.bytes, b.size);
    free(again.bytes);
    free(b.bytes);
}

/* ---- damage --------------------------------------------------------------------------------------------------------- */

static int opens_with(const built_t *b, size_t place, unsigned value, size_t count) {
    tuile_model_t model;
    uint8_t *copy = malloc(b->size);
    assert_non_null(copy);
    memcpy(copy, b->bytes, b->size);
    for (size_t i = 0; i < count; i++) {
        copy[place + i] = (uint8_t)(value >> 8 * i);
    }
    const uint32_t crc = decoder_crc(copy + 12, b->size - 12);
    for (size_t i = 0; i < 4; i++) {
        copy[8 + i] = (uint8_t)(crc >> 8 * i);
    }
    const int result = tuile_model_open(&model, copy, b->size);
    free(copy);
    return result;
}

static void what_lies_outside_or_is_unknown_does_not_open(void **state) {
    (void)state;
    built_t b = built_load(put_triangle(MTL, "vt 0 0\nvt 1 0\nvt 0.25 1\n"), NULL);
    const size_t material = decoder_u32(b.bytes + 88), texture = decoder_u32(b.bytes + 132), size = b.size;
    const struct {
        size_t place;
        unsigned value;
        size_t count;
        bool opens;
    } cases[] = {
        {12, 2, 2, false},                            /* the version */
        {material + 8, 7, 1, true},                   /* shininess */
        {material + 8, 8, 1, false},                  /*  */
        {material + 9, 1, 1, false},                  /* a texture too far */
        {material + 9, 255, 1, true},                 /* none */
        {material + 10, 2, 1, true},                  /* blend */
        {material + 10, 3, 1, false},                 /*  */
        {material + 11, 23, 1, true},                 /* flags */
        {material + 11, 8, 1, false},                 /* vertex colours, which it has not */
        {material + 11, 32, 1, false},                /*  */
        {material + 12, 9, 1, false},                 /* uv_bits */
        {material + 13, 1, 1, false},                 /* zeros */
        {material + 15, 1, 1, false},                 /*  */
        {124, 0, 4, false},                           /* texture coordinates that a material needs */
        {124, (unsigned)size - 8, 4, false},          /* beyond the end */
        {124, 153, 4, false},                         /* not aligned */
        {128, (unsigned)size - 12, 4, true},          /* vertex colours may be anything: 3 of 4 bytes */
        {128, (unsigned)size - 8, 4, false},          /*  */
        {132, 0, 4, false},                           /* a count without textures */
        {132, (unsigned)size - 16, 4, false},         /*  */
        {136, 0, 2, false},                           /* textures without a count */
        {136, 256, 2, false},                         /* more than can be named */
        {138, 1, 2, false},                           /* zero */
        {140, (unsigned)size - 20, 4, false},         /* a third of a key frame */
        {144, 152, 4, false},                         /*  */
        {texture, (unsigned)size - 4, 4, false},      /* level 0 fits, the others do not */
        {texture, 154, 4, false},                     /* not aligned */
        {texture + 4, 0, 4, false},                   /* a palette that is missing */
        {texture + 4, (unsigned)size - 28, 4, false}, /* too short */
        {texture + 8, 0, 2, false},                   /* no width */
        {texture + 8, 2049, 2, false},                /*  */
        {texture + 8, 2048, 2, false},                /* more than there is */
        {texture + 10, 0, 2, false},                  /*  */
        {texture + 12, 5, 1, false},                  /* format */
        {texture + 12, TUILE_TEXEL_GREY8, 1, false},  /* which has no palette */
        {texture + 13, 0, 1, false},                  /* levels */
        {texture + 13, 4, 1, false},                  /*  */
        {texture + 13, 1, 1, true},                   /*  */
        {texture + 14, 11, 1, true},                  /* flags: clamped, palette of ARGB4444 */
        {texture + 14, 16, 1, false},                 /*  */
        {texture + 15, 1, 1, false},                  /* zero */
        {texture + 16, 3, 2, false},                  /* a key without the flag */
        {texture + 18, 1, 2, false},                  /* zero */
    };
    assert_int_equal(opens_with(&b, 12, 3, 2), 0);
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        const int result = opens_with(&b, cases[i].place, cases[i].value, cases[i].count);
        if (result != (cases[i].opens ? 0 : TUILE_ERROR_MODEL)) { fail_msg("case %u: %d", i, result); }
    }
    free(b.bytes);
}

static void a_key_is_a_texel_of_its_format(void **state) {
    (void)state;
    built_t b = built_load(put_triangle(MTL, "vt 0 0\nvt 1 0\nvt 0.25 1\n"),
                           &(mesh_options_t){.texture_keyed = true, .texture_key = {255}});
    const size_t texture = decoder_u32(b.bytes + 132);
    assert_int_equal(b.bytes[texture + 14], TUILE_TEXTURE_KEY);
    assert_int_equal(opens_with(&b, texture + 16, 15, 2), 0);
    assert_int_equal(opens_with(&b, texture + 16, 16, 2), TUILE_ERROR_MODEL);
    free(b.bytes);
}

/* ---- texture coordinates --------------------------------------------------------------------------------------------- */

static void the_finest_fraction_that_fits_is_taken(void **state) {
    (void)state;
    static const struct {
        const char *texcoords;
        unsigned bits;
    } cases[] = {
        /* Of 4 texels. 32767 / 256 = 127.99: up to 31.99 repeats on either side of the middle. */
        {"vt 0 0\nvt 60 0\nvt 0 1\n", 8},         /* +-30 repeats: 120 texels */
        {"vt 0 0\nvt 64 0\nvt 0 1\n", 7},         /* +-32: 128 texels, 32768 */
        {"vt 1000 0\nvt 1060 0\nvt 1000 1\n", 8}, /* far from 0, but shifted by whole repeats */
        {"vt 0 0\nvt 16382 0\nvt 0 1\n", 0},      /* +-8191 repeats: 32764 texels */
        {"vt 0 0\nvt 1 0\nvt 0 100\n", 8},        /* of 2 texels: +-50 repeats are 100 */
        {"vt 0 0\nvt 1 0\nvt 0 200\n", 7},
    };
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        built_t b = built_load(put_triangle(MTL, cases[i].texcoords), NULL);
        if (at(&b, 88)[12] != cases[i].bits) { fail_msg("case %u: %u", i, at(&b, 88)[12]); }
        free(b.bytes);
    }
}

static void texture_coordinates_too_far_out_are_told_with_face_material_and_span(void **state) {
    (void)state;
    const char *far =
        "a.obj: face 0, material \"striped\": texture coordinates (1e+09, 0) are too far out: those of a material may "
        "span 16383.5 x 32767 repeats of its image of 4x2 texels";
    fails(put_triangle(MTL, "vt 0 0\nvt 1e9 0\nvt 0 1\n"), NULL, far);
    fails(put_triangle(MTL, "vt 1e9 0\nvt 1e9 0\nvt 1e9 0\n"), NULL, far);
    fails(put_triangle(MTL, "vt 0 0\nvt 16386 0\nvt 0 1\n"), NULL, "(0, 0) are too far out");
    fails(put_triangle(MTL, "vt 0 0\nvt 0 nan\nvt 0 1\n"), NULL, "a.obj:6: texture vertex 2 (0, nan) is not finite");
    fails(put_triangle(MTL, "vt 0 0\nvt 0 1e39\nvt 0 1\n"), NULL, "a.obj:6: texture vertex 2 (0, 1e+39) is not finite");
    built_t b = built_load(folder_path("a.obj"), &(mesh_options_t){.no_textures = true});
    free(b.bytes);
    /* Clamped ones cannot be shifted. */
    fails(put_triangle("newmtl striped\nmap_Kd -clamp on stripes.png\n", "vt 9000 0\nvt 9000 0\nvt 9000 1\n"), NULL, "too far out");
}

/* Every corner of every face of spider.obj: at its place a vertex with the coordinates that Assimp gives, modulo whole repeats. */
static void the_spider_has_its_texture_coordinates_within_half_a_unit(void **state) {
    (void)state;
    const char *path = getenv("SPIDER");
    if (!path) { skip(); }
    built_t b = built_load(path, NULL);
    tuile_model_t model;
    assert_int_equal(tuile_model_open(&model, b.bytes, b.size), 0);
    const struct aiScene *scene = aiImportFile(path, 0);
    assert_non_null(scene);
    const double step = ldexp(model.step.mantissa, model.step.exponent);
    unsigned checked = 0, outside = 0;
    uint32_t source = 0, face_index = 0;
    uint32_t *faces = calloc(model.source_face_count, sizeof *faces); /* of each source face: 1 + its face */
    assert_non_null(faces);
    for (uint32_t f = 0; f < model.face_count; f++) {
        faces[tuile_model_source_face(&model, f)] = f + 1;
    }
    /* Of each face its cluster's first vertex, its corners and material. */
    struct corner {
        uint32_t vertex[3], material;
    } *corners = calloc(model.face_count, sizeof *corners);
    assert_non_null(corners);
    for (uint32_t k = 0; k < model.cluster_count; k++) {
        const uint8_t *cluster = model.clusters + 28 * (size_t)k, *face = model.faces + decoder_u32(cluster + 20);
        assert_int_equal(cluster[27], 0);
        for (unsigned i = 0; i < decoder_u16(cluster + 24); i++, face += 4, face_index++) {
            for (int c = 0; c < 3; c++) {
                corners[face_index].vertex[c] = decoder_u32(cluster + 12) + face[c];
            }
            corners[face_index].material = face[3];
        }
    }
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *mesh = scene->mMeshes[m];
        for (unsigned f = 0; f < mesh->mNumFaces; f++, source++) {
            if (!faces[source]) { continue; }
            const struct corner *corner = &corners[faces[source] - 1];
            const tuile_material_t material = tuile_model_material(&model, corner->material);
            const tuile_texture_t texture = tuile_model_texture(&model, material.texture);
            assert_int_equal(mesh->mFaces[f].mNumIndices, 3);
            double repeats[2] = {0};
            for (int c = 0; c < 3; c++) {
                const unsigned v = mesh->mFaces[f].mIndices[c];
                const double uv[2] = {(double)mesh->mTextureCoords[0][v].x, 1 - (double)mesh->mTextureCoords[0][v].y};
                const double place[3] = {(double)mesh->mVertices[v].x, (double)mesh->mVertices[v].y, (double)mesh->mVertices[v].z};
                for (int k = 0; k < 3; k++) {
                    const double q = decoder_s16(model.positions + 6 * (size_t)corner->vertex[c] + 2 * k);
                    assert_true(fabs((q + model.offset[k]) * step - place[k]) <= step * 0.500001);
                }
                for (int k = 0; k < 2; k++) {
                    const double size = k ? texture.height : texture.width;
                    const double unit = ldexp(1, material.uv_bits);
                    const double told = decoder_s16(model.texcoords + 4 * (size_t)corner->vertex[c] + 2 * k) / unit;
                    double shift = uv[k] * size - told;
                    outside += uv[k] < 0 || uv[k] > 1;
                    const double whole = nearbyint(shift / size);
                    if (c == 0) { repeats[k] = whole; }
                    assert_true(whole == repeats[k]); /* the same for the whole face */
                    shift -= whole * size;
                    assert_true(fabs(shift) <= 0.500001 / unit);
                    checked++;
                }
            }
        }
    }
    assert_int_equal(source, model.source_face_count);
    assert_true(checked > 7000);
    assert_true(outside > 100);
    free(corners);
    free(faces);
    aiReleaseImport(scene);
    free(b.bytes);
}

/* ---- images ---------------------------------------------------------------------------------------------------------- */

#define UVS "vt 0 0\nvt 1 0\nvt 0.25 1\n"

static void images_that_are_missing_or_broken_are_told_with_their_material(void **state) {
    (void)state;
    fails(put_triangle("newmtl striped\nmap_Kd gone.png\n", UVS), NULL,
          "a.obj: material \"striped\": texture \"gone.png\" is not there (");
    fails(put_triangle("newmtl striped\nmap_Kd gone.png\n", UVS), NULL, "--no-textures");
    (void)folder_put_text("text.png", "no image");
    fails(put_triangle("newmtl striped\nmap_Kd text.png\n", UVS), NULL,
          "text.png\": is neither a PNG nor a JPEG file; convert it, or leave images out (--no-textures)");
    (void)folder_put_bytes("cut.png", "\x89PNG\r\n\x1a\n", 8);
    fails(put_triangle("newmtl striped\nmap_Kd cut.png\n", UVS), NULL, "cut.png\": is a broken PNG file");
    (void)folder_put_bytes("empty.png", "", 0);
    fails(put_triangle("newmtl striped\nmap_Kd empty.png\n", UVS), NULL, "material \"striped\": ");
    uint8_t *wide = calloc(2049, 3);
    assert_non_null(wide);
    (void)images_put("wide.png", images_png_rgb(2049, 1, wide, false));
    free(wide);
    const char *path = put_triangle("newmtl striped\nmap_Kd wide.png\n", UVS);
    fails(path, NULL, "wide.png\": is 2049x1 pixels");
    built_t b = built_load(path, &(mesh_options_t){.texture_size = 2048});
    assert_int_equal(decoder_u16(at(&b, 132) + 8), 1024);
    free(b.bytes);
}

static void an_image_is_found_by_its_bare_name_too(void **state) {
    (void)state;
    static const char *const names[] = {".\\stripes.png", "C:\\home\\me\\stripes.png", "/nowhere/stripes.png",
                                        "textures/stripes.png"};
    for (unsigned i = 0; i < CHECK_COUNT(names); i++) {
        char mtl[200];
        (void)snprintf(mtl, sizeof mtl, "newmtl striped\nmap_Kd %s\n", names[i]);
        built_t b = built_load(put_triangle(mtl, UVS), NULL);
        assert_int_equal(decoder_u16(b.bytes + 136), 1);
        free(b.bytes);
    }
}

static void an_image_of_two_materials_is_stored_once(void **state) {
    (void)state;
    images_put_stripes("stripes.png");
    (void)folder_put_text("two.mtl",
                          "newmtl a\nKd 1 0 0\nmap_Kd stripes.png\nnewmtl b\nKd 0 1 0\nmap_Kd stripes.png\nnewmtl c\nKd 0 0 1\n");
    built_t b =
        built_load(folder_put_text("two.obj", "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                              "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 4/3\nusemtl c\nf 2/1 3/2 4/3\n"),
                   NULL);
    assert_int_equal(decoder_u16(b.bytes + 136), 1);
    assert_int_equal(decoder_u16(b.bytes + 32), 3);
    assert_int_equal(at(&b, 88)[9], 0);
    assert_int_equal(at(&b, 88)[16 + 9], 0);
    assert_int_equal(at(&b, 88)[32 + 9], 255);
    free(b.bytes);
}

/* A triangle of glTF with a 1 x 1 image of (1, 2, 3), all in one file. */
static const char *put_gltf(const char *sampler, const char *transform) {
    static const char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static const uint8_t pixel[3] = {1, 2, 3};
    const float buffer[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
    image_bytes_t png = images_png_rgb(1, 1, pixel, false);
    char texts[2][1024], json[4096];
    const uint8_t *blocks[2] = {(const uint8_t *)buffer, png.at};
    const size_t sizes[2] = {sizeof buffer, png.size};
    for (int b = 0; b < 2; b++) {
        size_t used = 0;
        for (size_t i = 0; i < sizes[b]; i += 3) {
            uint32_t bits = 0;
            for (size_t k = 0; k < 3; k++) {
                bits = bits << 8 | (i + k < sizes[b] ? blocks[b][i + k] : 0);
            }
            for (size_t k = 0; k < 4; k++) {
                texts[b][used++] = i + k <= sizes[b] ? alphabet[bits >> (18 - 6 * k) & 63] : '=';
            }
        }
        texts[b][used] = 0;
    }
    free(png.at);
    (void)snprintf(json, sizeof json,
                   "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_texture_transform\"],\"scene\":0,\"scenes\":[{"
                   "\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
                   "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"material\":0}]}],"
                   "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0%s}},\"doubleSided\":true}],"
                   "\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{%s}],"
                   "\"images\":[{\"uri\":\"data:image/png;base64,%s\"}],"
                   "\"buffers\":[{\"byteLength\":60,\"uri\":\"data:application/octet-stream;base64,%s\"}],"
                   "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":24}],"
                   "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
                   "\"max\":[1,1,0]},{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}]}",
                   transform, sampler, texts[1], texts[0]);
    return folder_put_text("one.gltf", json);
}

static void embedded_images_sampler_and_sides_of_gltf_are_read(void **state) {
    (void)state;
    built_t b =
        built_load(put_gltf("\"wrapS\":33071,\"wrapT\":10497", ""), &(mesh_options_t){.texture_format = 1 + TUILE_TEXEL_GREY8});
    const uint8_t *texture = at(&b, 132);
    assert_int_equal(decoder_u16(b.bytes + 136), 1);
    assert_int_equal(texture[14], TUILE_TEXTURE_CLAMP_S);
    assert_int_equal(b.bytes[decoder_u32(texture)], 2);         /* (77 + 300 + 87) / 256 */
    assert_int_equal(at(&b, 88)[11], TUILE_MATERIAL_TWO_SIDED); /* the texture is multiplied by the colour */
    assert_int_equal(at(&b, 88)[3], 255);
    /* (0, 0), (1, 0), (0, 1), downwards; along t, which repeats, one less. */
    static const int expected[6] = {0, -256, 256, -256, 0, 0};
    for (size_t i = 0; i < 6; i++) {
        assert_int_equal(decoder_s16(at(&b, 124) + 2 * i), expected[i]);
    }
    assert_string_equal(b.report.warnings, "");
    free(b.bytes);
}

static void what_is_done_otherwise_is_warned_of(void **state) {
    (void)state;
    built_t b = built_load(put_gltf("\"wrapS\":33648,\"wrapT\":33648", ""), NULL);
    assert_non_null(strstr(b.report.warnings, "mirrored along s; it is repeated\n"));
    assert_non_null(strstr(b.report.warnings, "mirrored along t; it is repeated\n"));
    assert_int_equal(at(&b, 132)[14], 0);
    assert_null(strstr(b.report.warnings, "moved"));
    free(b.bytes);
    b = built_load(put_gltf("", ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0]}}"), NULL);
    assert_non_null(strstr(b.report.warnings, "is moved, scaled or turned; that is left out\n"));
    free(b.bytes);
    b = built_load(put_gltf("", ",\"extensions\":{\"KHR_texture_transform\":{\"scale\":[1,1]}}"), NULL);
    assert_string_equal(b.report.warnings, "");
    free(b.bytes);
    images_put_stripes("stripes.png");
    (void)folder_put_text("a.mtl", MTL);
    b = built_load(folder_put_text("bare.obj", TRIANGLE "usemtl striped\nf 1 2 3\n"), NULL);
    assert_non_null(strstr(b.report.warnings, "it has no texture coordinates; it is drawn without\n"));
    assert_int_equal(at(&b, 88)[9], 255);
    free(b.bytes);
}

/* ---- vertex colours -------------------------------------------------------------------------------------------------- */

/* others: red, green, blue, alpha of two corners; last: of the third. */
static const char *put_ply(const char *others, const char *last) {
    char text[1024];
    (void)snprintf(text, sizeof text,
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                   "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face 1\n"
                   "property list uchar int vertex_indices\nend_header\n0 0 0 %s\n1 0 0 %s\n0 1 0 %s\n3 0 1 2\n",
                   others, others, last);
    return folder_put_text("c.ply", text);
}

static void colours_that_differ_within_a_face_are_kept_at_its_vertices(void **state) {
    (void)state;
    built_t b = built_load(put_ply("30 0 0 255", "90 60 255 128"), NULL);
    static const uint8_t colours[12] = {30, 0, 0, 255, 30, 0, 0, 255, 90, 60, 255, 128}, mean[3] = {50, 20, 85};
    assert_memory_equal(at(&b, 128), colours, 12);
    assert_memory_equal(at(&b, 88), mean, 3); /* for those who draw without */
    assert_int_equal(at(&b, 88)[11], TUILE_MATERIAL_VERTEX_COLOURS);
    free(b.bytes);
    b = built_load(put_ply("30 0 0 255", "90 60 255 128"), &(mesh_options_t){.vertex_colours = MESH_COLOURS_FACES});
    assert_int_equal(decoder_u32(b.bytes + 128), 0);
    assert_memory_equal(at(&b, 88), mean, 3);
    assert_int_equal(at(&b, 88)[11], 0);
    free(b.bytes);
}

static void one_colour_a_face_is_its_material(void **state) {
    (void)state;
    built_t b = built_load(put_ply("30 0 0 255", "30 0 0 255"), NULL);
    assert_int_equal(decoder_u32(b.bytes + 128), 0);
    assert_int_equal(at(&b, 88)[0], 30);
    free(b.bytes);
    b = built_load(put_ply("30 0 0 255", "30 0 0 255"), &(mesh_options_t){.vertex_colours = MESH_COLOURS_VERTICES});
    assert_int_not_equal(decoder_u32(b.bytes + 128), 0);
    free(b.bytes);
    b = built_load(put_ply("30 0 0 254", "30 0 0 254"), NULL); /* alpha a face has not */
    assert_int_not_equal(decoder_u32(b.bytes + 128), 0);
    free(b.bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_textured_triangle_stands_where_the_layout_says),
        cmocka_unit_test(materials_and_textures_are_told_by_the_model),
        cmocka_unit_test(without_textures_a_model_is_as_it_was),
        cmocka_unit_test(what_lies_outside_or_is_unknown_does_not_open),
        cmocka_unit_test(a_key_is_a_texel_of_its_format),
        cmocka_unit_test(the_finest_fraction_that_fits_is_taken),
        cmocka_unit_test(texture_coordinates_too_far_out_are_told_with_face_material_and_span),
        cmocka_unit_test(the_spider_has_its_texture_coordinates_within_half_a_unit),
        cmocka_unit_test(images_that_are_missing_or_broken_are_told_with_their_material),
        cmocka_unit_test(an_image_is_found_by_its_bare_name_too),
        cmocka_unit_test(an_image_of_two_materials_is_stored_once),
        cmocka_unit_test(embedded_images_sampler_and_sides_of_gltf_are_read),
        cmocka_unit_test(what_is_done_otherwise_is_warned_of),
        cmocka_unit_test(colours_that_differ_within_a_face_are_kept_at_its_vertices),
        cmocka_unit_test(one_colour_a_face_is_its_material),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
