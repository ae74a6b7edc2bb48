/* The layout of a compiled model, the same bytes in flash and in a .tuile file.
 *
 * All numbers are little-endian. The block is 4-byte aligned and begins with the header; sections lie at the byte offsets that
 * the header names, 4-byte aligned, in any order, without overlap with the header.
 *
 * A cluster is a small group of neighbouring faces with vertices of its own (a vertex on the border of two clusters stands in
 * both), so that it can be dropped, transformed and forgotten as one. Its bounding sphere and its cone of normals decide that
 * before a vertex is touched.
 */
#ifndef TUILE_GEOMETRY_MODEL_H
#define TUILE_GEOMETRY_MODEL_H

#include "../flash.h"
#include "../tuile.h"

#define MODEL_MAGIC 0x4c495554u /* "TUIL" */
#define MODEL_VERSION 3u
#define MODEL_HEADER_BYTES 152u

/* Byte offsets in the header. */
enum {
    MODEL_AT_MAGIC = 0,          /* u32 */
    MODEL_AT_SIZE = 4,           /* u32, of the whole block */
    MODEL_AT_CRC32 = 8,          /* u32, IEEE 802.3 (reflected, as zlib's), over bytes 12 ... size - 1 */
    MODEL_AT_VERSION = 12,       /* u16 */
    MODEL_AT_FLAGS = 14,         /* u16, MODEL_FLAG_... */
    MODEL_AT_VERTICES = 16,      /* u32 */
    MODEL_AT_FACES = 20,         /* u32 */
    MODEL_AT_CLUSTERS = 24,      /* u32 */
    MODEL_AT_SOURCE_FACES = 28,  /* u32 */
    MODEL_AT_MATERIALS = 32,     /* u16, 1 ... 256 */
    MODEL_AT_CLUSTER_MAX = 34,   /* u16, vertices of the largest cluster, 3 ... 255 */
    MODEL_AT_CORNERS_MAX = 36,   /* u16, corners of the largest face, 3 ... 255 */
    MODEL_AT_RADIUS = 38,        /* u16, bounding sphere */
    MODEL_AT_CENTRE = 40,        /* 3 x i16 */
    MODEL_AT_STEP_EXPONENT = 46, /* i16 */
    MODEL_AT_STEP_MANTISSA = 48, /* u32, > 0 */
    MODEL_AT_OFFSET = 52,        /* 3 x i32 */
    MODEL_AT_POSITIONS = 64,     /* u32 byte offset of the section, and so on */
    MODEL_AT_NORMALS = 68,
    MODEL_AT_CLUSTER_TABLE = 72,
    MODEL_AT_FACE_BYTES = 76,
    MODEL_AT_FACE_BYTES_SIZE = 80, /* u32, size of that section */
    MODEL_AT_FACE_NORMALS = 84,
    MODEL_AT_MATERIAL_TABLE = 88,
    MODEL_AT_SOURCE = 92,           /* 0 when there is no source map */
    MODEL_AT_TREE = 96,             /* 0 when there is no display tree */
    MODEL_AT_TREE_WORDS = 100,      /* u32, size of that section in 32-bit words */
    MODEL_AT_TREE_DEPTH = 104,      /* u16, nodes on the longest path; 0 without a tree */
    MODEL_AT_ZERO = 106,            /* u16, 0 */
    MODEL_AT_LOW = 108,             /* 3 x i16, least of all positions */
    MODEL_AT_HIGH = 114,            /* 3 x i16, greatest */
    MODEL_AT_FRACTIONS = 120,       /* 0 when all positions are whole steps */
    MODEL_AT_TEXCOORDS = 124,       /* 0 when no material has a texture */
    MODEL_AT_COLOURS = 128,         /* 0 when there are no vertex colours */
    MODEL_AT_TEXTURES = 132,        /* the texture table; 0 when there are no textures */
    MODEL_AT_TEXTURE_COUNT = 136,   /* u16, 0 ... 255 */
    MODEL_AT_ZERO2 = 138,           /* u16, 0 */
    MODEL_AT_MORPH_POSITIONS = 140, /* the second key frame: all three of these, or 0. Not with a display tree */
    MODEL_AT_MORPH_NORMALS = 144,
    MODEL_AT_MORPH_FACE_NORMALS = 148,
};

enum {
    MODEL_FLAG_SOURCE32 = 1, /* the source map has u32 entries, else u16 */
};

/* positions    vertices x 3 x i16, in steps
 * fractions    vertices x 3 x i8, to be added to the position, in 1/256 step: vertices that the display tree made by cutting
 * normals      vertices x 3 x i8, 127 = 1.0, outward
 * face normals faces x 3 x i8, of the plane, outward
 * materials    materials x 16 bytes, as below
 * texcoords    vertices x 2 x i16: s, t in texels of level 0 of the texture of the vertex's material, times 2^uv_bits of it;
 *              vertices of materials without one have 0
 * colours      vertices x 4 x u8: red, green, blue, alpha
 * textures     textures x 20 bytes, as below; texels and palettes lie anywhere behind the header, 4-byte aligned
 * morph        positions, normals and face normals of the second key frame, in the same steps; positions lie in low ... high
 * source       faces x u16 or u32: the importer's number of each face, 0-based; several may share one (a split polygon)
 * face bytes   per cluster, at its face_bytes offset:
 *              MODEL_CLUSTER_TRIANGLES: per face u8 a, b, c, material, 4-byte aligned
 *              MODEL_CLUSTER_POLYGONS:  per face u8 corners n, u8 flags, u8 material, n x u8 corner, u8 n again
 *              a corner is an index into the cluster's vertices; front faces are counter-clockwise.
 *              n stands at both ends so that the display tree can go through them backwards. Bytes between clusters are 0.
 * clusters     28 bytes each, as below. Their faces and vertices follow on one another: cluster k's first face is the sum of the
 *              face counts before it, and so for vertices.
 */
#define MODEL_CLUSTER_BYTES 28u
enum {
    CLUSTER_AT_CENTRE = 0,        /* 3 x i16: sphere around its vertices */
    CLUSTER_AT_RADIUS = 6,        /* u16, rounded up */
    CLUSTER_AT_AXIS = 8,          /* 3 x i8: mean direction of the face normals, 120 ... 128 long */
    CLUSTER_AT_CUTOFF = 11,       /* u8: the cluster faces away from an eye e when
                                     dot(centre - e, axis) - radius * |axis| >= (cutoff / 254) * |axis| * |centre - e|
                                     (with |axis| rounded up); 255 = never. See geometry/cull.c. */
    CLUSTER_AT_FIRST_VERTEX = 12, /* u32 */
    CLUSTER_AT_FIRST_FACE = 16,   /* u32 */
    CLUSTER_AT_FACE_BYTES = 20,   /* u32, relative to the face bytes section */
    CLUSTER_AT_FACE_COUNT = 24,   /* u16, >= 1 */
    CLUSTER_AT_VERTEX_COUNT = 26, /* u8, 3 ... 255 */
    CLUSTER_AT_KIND = 27,         /* u8 */
};
/* A material, field by field as tuile_material_t. */
#define MODEL_MATERIAL_BYTES 16u
enum {
    MATERIAL_AT_COLOUR = 0,   /* 3 x u8 */
    MATERIAL_AT_ALPHA = 3,    /* u8, and so on */
    MATERIAL_AT_EMISSION = 4, /* 3 x u8 */
    MATERIAL_AT_SPECULAR = 7,
    MATERIAL_AT_SHININESS = 8, /* 0 ... 7 */
    MATERIAL_AT_TEXTURE = 9,   /* index, or TUILE_NO_TEXTURE */
    MATERIAL_AT_BLEND = 10,
    MATERIAL_AT_FLAGS = 11,
    MATERIAL_AT_UV_BITS = 12, /* 0 ... MODEL_UV_BITS_MAX */
    MATERIAL_AT_ZERO = 13,    /* 3 x 0 */
};
#define MODEL_UV_BITS_MAX 8u
#define MODEL_SHININESS_MAX 7u

/* A texture: see tuile_texture_t, also for how its levels lie. */
#define MODEL_TEXTURE_BYTES 20u
enum {
    TEXTURE_AT_TEXELS = 0,  /* u32, from the start of the block */
    TEXTURE_AT_PALETTE = 4, /* u32, the same; 0 without a palette */
    TEXTURE_AT_WIDTH = 8,   /* u16, 1 ... TUILE_TEXTURE_MAX */
    TEXTURE_AT_HEIGHT = 10,
    TEXTURE_AT_FORMAT = 12, /* u8, tuile_texel_t */
    TEXTURE_AT_LEVELS = 13, /* u8, 1 ... as many as lead to one texel */
    TEXTURE_AT_FLAGS = 14,  /* u8, tuile_texture_flags_t */
    TEXTURE_AT_ZERO = 15,   /* u8, 0 */
    TEXTURE_AT_KEY = 16,    /* u16, a texel of the format; 0 without TUILE_TEXTURE_KEY */
    TEXTURE_AT_ZERO2 = 18,  /* u16, 0 */
};

enum { MODEL_CLUSTER_TRIANGLES = 0, MODEL_CLUSTER_POLYGONS = 1 };
#define MODEL_POLYGON_BYTES(corners) (4u + (corners))
enum {
    MODEL_FACE_CONVEX = 1,   /* strictly: may be cut into a fan from its first corner */
    MODEL_FACE_CROSSING = 2, /* crosses itself: parts of it may turn the other way, so that its area in the window does not tell
                                which of its sides is seen */
};

#define MODEL_TRIANGLE_CLUSTER_VERTICES 128u /* a cluster of triangles has at most so many vertices */

/* The display tree (S10): nodes made of little-endian 32-bit words, the root first, in preorder: a node's first child follows
 * directly behind it, the second one behind all nodes below the first. The first word of a node has bit 0 set; all others are the
 * value shifted left by one, so that they have not.
 *
 * Word 0      TREE_START | kind << 1 | TREE_FIRST if there is a first child | TREE_SECOND if it is a second child itself
 *             | value << 8: TREE_CONVEX the cluster of its first face, TREE_PLANE 0
 * TREE_CONVEX 4 words: word 0; first face; number of faces whose normals lead into the set (I); number of the others (O).
 *             Faces first ... first + I - 1 look inwards, the O behind them outwards; both may lie in several clusters.
 *             Its first child is inside. I + O >= 1; nodes name all faces of the model, each once, in order.
 *             To be drawn: the faces whose inside is seen, then the child, then the faces whose outside is seen.
 * TREE_PLANE  7 words: word 0; second child, in words from the start of the section (0 = none); n[3], |n[i]| < 2^30; bits 0 ... 29
 *             of d; the rest of d, signed; |d| < 2^48. n . q + d tells the side of a position q in steps: the first child is on the
 *             plus side, the second one on the minus side. There is one child at least.
 * Before each second child stands one word: the place of its parent, in words from the start of the section. With it a tree can be
 * checked in one pass without any memory.
 */
enum { TREE_CONVEX = 1, TREE_PLANE = 2 };
#define TREE_START 1u
#define TREE_KIND(word) ((word) >> 1 & 3u)
#define TREE_FIRST 8u
#define TREE_SECOND 16u
#define TREE_VALUE(word) ((word) >> 8)
#define TREE_CONVEX_WORDS 4u
#define TREE_PLANE_WORDS 7u
#define TREE_CLUSTERS_MAX (1u << 24)

static inline uint16_t model_u16(const TUILE_FLASH uint8_t *p) { return (uint16_t)(p[0] | (uint16_t)p[1] << 8); }
static inline int16_t model_i16(const TUILE_FLASH uint8_t *p) { return (int16_t)model_u16(p); }
static inline uint32_t model_u32(const TUILE_FLASH uint8_t *p) {
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* CRC-32 as in the header; start with crc = 0. */
uint32_t model_crc32(uint32_t crc, const uint8_t *bytes, size_t size_bytes);

/* model_surface.c: bytes of all levels of a texture; width, height >= 1, levels <= 12: below 2^24. */
uint32_t model_texture_bytes(unsigned format, uint32_t width, uint32_t height, unsigned levels);

/* Entries of the palette of a format, 0 for formats without one. */
unsigned model_palette_entries(unsigned format);

/* The section of count * item_bytes bytes whose offset stands at `at` in the header, or NULL. */
const uint8_t *model_section(const tuile_model_t *model, unsigned at, uint32_t count, uint32_t item_bytes);

/* The box is believed by those who order instances: no position may lie outside of it. */
bool model_in_box(const tuile_model_t *model, const uint8_t *positions);

/* Sets the materials, texture coordinates, colours and textures of a model whose counts are known, all checked; false: damaged. */
bool model_open_surface(tuile_model_t *model);

/* The same for the second key frame; the box and the tree must be known. */
bool model_open_morph(tuile_model_t *model);

#endif
