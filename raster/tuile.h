/* Tuile: 3D scenes on small displays, drawn tile by tile in a few kilobytes.
 *
 * CONVENTIONS
 *   World and view   right-handed, y up; the camera looks along -z; front faces are counter-clockwise.
 *   Window           x right, y down, origin at the top left corner of the top left pixel;
 *                    pixel (i, j) is sampled at its centre (i + 1/2, j + 1/2).
 *   Vertices         are snapped to 1/16 pixel (round half up) before anything is decided about coverage.
 *   Coverage         even-odd; a pixel is drawn iff its centre is inside the snapped polygon or on a left or
 *                    top edge of it. Hence faces that share an edge neither overlap nor leave a gap.
 *   Depth            larger is nearer; 0 is the background. Perspective: (65528 / 65536) * near / w in units of
 *                    1 / 65536, which is affine in the window. Orthographic: affine in the distance.
 *                    Of two faces equally deep at a pixel, the one with the lower index is seen.
 *   Qm.n             a signed integer divided by 2^n; m counts the sign bit.
 *   Negative numbers are rounded towards minus infinity wherever they are divided or shifted.
 *
 * A frame is pulled: tuile_begin, then tuile_next until it returns 0, then tuile_end. All memory is one block
 * that the caller gives to tuile_init; with less of it a frame takes more passes over the model, and the picture
 * is the same. Nothing here allocates, blocks, uses floating point or keeps state outside that block, so any
 * number of renderers may run at once, on any number of cores, over one scene.
 */
#ifndef TUILE_H
#define TUILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef int32_t q16_16_t; /* lengths in world units, pixels with a fraction */
typedef int32_t q2_30_t;  /* components of unit vectors and rotations */
typedef int16_t q2_14_t;  /* the same, compact: light directions */
typedef int32_t q28_4_t;  /* window coordinates in 1/16 pixel */
typedef uint16_t bam16_t; /* angles: 65536 is a full turn */

#define TUILE_Q16(x) ((q16_16_t)((x)*65536.0 + ((x) < 0 ? -0.5 : 0.5))) /* for constant expressions */
#define TUILE_ONE_Q30 ((q2_30_t)1 << 30)
#define TUILE_ONE_Q14 ((q2_14_t)(1 << 14))

/* Errors are negative. No function reports success after it dropped something. */
typedef enum tuile_error {
    TUILE_OK = 0,
    TUILE_ERROR_ARGUMENT = -1, /* a field of a struct is out of the range stated here */
    TUILE_ERROR_MEMORY = -2,   /* the block is too small; the size wanted is reported */
    TUILE_ERROR_MODEL = -3,    /* the bytes of a model are not a model, or are damaged */
    TUILE_ERROR_CAMERA = -4,   /* degenerate: eye = at, up along the view, near <= 0, far <= near ... */
    TUILE_ERROR_RANGE = -5,    /* model, pose and camera together leave the number range */
    TUILE_ERROR_SEQUENCE = -6, /* tuile_next without tuile_begin, and the like */
    TUILE_ERROR_LIMITS = -7,   /* a model exceeds the cluster_vertices, corners or tree_depth that the renderer was laid out for */
    TUILE_ERROR_TREE = -8,     /* TUILE_TREE, and a model has no display tree */
    TUILE_ERROR_EFFECTS = -9,  /* the scene asks for what config.effects (or the build) leaves out */
    TUILE_ERROR_FONT = -10,    /* the bytes of a font are not a font, or are damaged */
} tuile_error_t;

/* One line of English about an error code; never NULL. */
const char *tuile_error_text(int error);

/* ---- models ------------------------------------------------------------------------------------------------ */

/* mantissa * 2^exponent, for sizes whose order of magnitude is not known in advance. */
typedef struct tuile_scale {
    uint32_t mantissa;
    int32_t exponent;
} tuile_scale_t;

#define TUILE_SCALE_ONE ((tuile_scale_t){1, 0})

/* ---- textures and materials ---------------------------------------------------------------------------------- */

#define TUILE_TEXTURE_MAX 2048 /* texels across or down */

typedef enum tuile_texel {
    TUILE_TEXEL_RGB565 = 0,   /* 2 bytes, little-endian */
    TUILE_TEXEL_PALETTE8 = 1, /* 1 byte, an index into the palette */
    TUILE_TEXEL_PALETTE4 = 2, /* 4 bits, the left one of two texels in the low half; rows begin on whole bytes */
    TUILE_TEXEL_GREY8 = 3,    /* 1 byte of luminance */
    TUILE_TEXEL_ARGB4444 = 4, /* 2 bytes, little-endian: alpha, red, green, blue, 4 bits each from the top */
} tuile_texel_t;

typedef enum tuile_texture_flags {
    TUILE_TEXTURE_CLAMP_S = 1, /* else the texture repeats */
    TUILE_TEXTURE_CLAMP_T = 2,
    TUILE_TEXTURE_KEY = 4,           /* texels equal to `key` (the texel's bits, or its index) are not there */
    TUILE_TEXTURE_PALETTE_ALPHA = 8, /* the palette's entries are ARGB4444, else RGB565 */
} tuile_texture_flags_t;

/* Row 0 is the top of the image, and t grows downwards. Points into the caller's bytes. */
typedef struct tuile_texture {
    const uint8_t *texels;  /* level 0 row by row without gaps, then, 2-byte aligned, each further level: half as wide and high,
                               rounded down, 1 at least */
    const uint8_t *palette; /* 256 or 16 entries of 2 bytes, little-endian; NULL without one */
    uint16_t width, height; /* 1 ... TUILE_TEXTURE_MAX; powers of two are fastest */
    uint8_t format;         /* tuile_texel_t */
    uint8_t levels;         /* mip levels, 1 at least */
    uint8_t flags;          /* tuile_texture_flags_t, or-ed */
    uint16_t key;
} tuile_texture_t;

typedef enum tuile_blend {
    TUILE_BLEND_OVER = 0,     /* alpha * colour + (1 - alpha) * what is behind */
    TUILE_BLEND_ADD = 1,      /* alpha * colour + what is behind, held at white */
    TUILE_BLEND_MULTIPLY = 2, /* what is behind * (1 - alpha + alpha * colour) */
} tuile_blend_t;

typedef enum tuile_material_flags {
    TUILE_MATERIAL_TWO_SIDED = 1, /* back faces are seen too, lit as front faces */
    TUILE_MATERIAL_BILINEAR = 2,  /* texels are interpolated, else the nearest one is taken */
    TUILE_MATERIAL_UNLIT = 4,     /* colour and texture as they are */
    TUILE_MATERIAL_VERTEX_COLOURS = 8, /* the vertex colours of the model take the place of `colour`, which is their mean */
    TUILE_MATERIAL_REPLACED = 16, /* by its texture: `colour` is what faces have where textures are not drawn, and else white */
} tuile_material_flags_t;

#define TUILE_NO_TEXTURE 255u

/* What a face is made of. A face is translucent, and drawn after all others, back to front, if its material has an alpha below 255
 * or a blend other than OVER, or its texture has alpha or a key, or its model has vertex colours with alpha. */
typedef struct tuile_material {
    uint8_t colour[3]; /* red, green, blue; multiplied by the texture and the vertex colour */
    uint8_t alpha;     /* 255: opaque */
    uint8_t emission[3]; /* added to the light: 255 = 1.0 */
    uint8_t specular;    /* the highlight's level, 255 = 1.0; 0: none. White, over texture and colour; with TUILE_FLAT a part of
                            the light */
    uint8_t shininess;   /* log2 of the exponent of the highlight, 0 ... 7 */
    uint8_t texture;     /* index among the model's textures, or TUILE_NO_TEXTURE */
    uint8_t blend;       /* tuile_blend_t */
    uint8_t flags;       /* tuile_material_flags_t, or-ed */
    uint8_t uv_bits;     /* fraction bits of the model's texture coordinates of this material, 0 ... 8 */
} tuile_material_t;

/* An opened model: pointers into the caller's bytes, which must outlive it. geometry/model.h has the layout. */
typedef struct tuile_model {
    const uint8_t *bytes;
    uint32_t size_bytes;
    uint32_t vertex_count, face_count, cluster_count, material_count;
    uint32_t source_face_count;    /* faces in the order in which the importer delivered them */
    uint16_t cluster_vertices_max; /* vertices of the largest cluster */
    uint16_t corners_max;          /* corners of the face with most */
    tuile_scale_t step;            /* model units per quantisation step */
    int32_t offset[3];             /* in steps: position = step * (offset + stored int16) */
    int16_t centre[3];             /* bounding sphere, in steps relative to offset */
    uint16_t radius;
    uint16_t flags;
    const uint8_t *positions, *normals, *clusters, *faces, *face_normals, *materials, *source;
    const uint8_t *fractions; /* NULL: none */
    const uint8_t *tree;      /* NULL: none */
    const uint8_t *texcoords, *colours, *textures; /* NULL: none */
    const uint8_t *morph_positions, *morph_normals, *morph_face_normals; /* the second key frame; NULL: none */
    uint16_t texture_count;
    uint32_t tree_words;
    uint16_t tree_depth;     /* nodes on the longest path */
    int16_t low[3], high[3]; /* the box of all positions, in steps relative to offset */
} tuile_model_t;

/* Opens a model that `tuile mesh` wrote, from flash or from a file read into memory. Every index, offset and count
 * is checked (the check sum too), so that a model that opens can be drawn without a read out of bounds.
 * bytes: 4-byte aligned. Returns 0, TUILE_ERROR_ARGUMENT or TUILE_ERROR_MODEL. */
int tuile_model_open(tuile_model_t *model, const void *bytes, size_t size_bytes);

/* The importer's number of a face of the model (0-based), for a face index as drawn. */
uint32_t tuile_model_source_face(const tuile_model_t *model, uint32_t face);

/* Material or texture `index` of an opened model, index < material_count or texture_count. */
tuile_material_t tuile_model_material(const tuile_model_t *model, uint32_t index);
tuile_texture_t tuile_model_texture(const tuile_model_t *model, uint32_t index);

/* ---- scene ------------------------------------------------------------------------------------------------- */

/* Where an instance stands: world = rotation * (scale * model) + translation. */
typedef struct tuile_pose {
    q2_30_t rotation[3][3]; /* orthonormal; a reflection turns front faces into back faces */
    tuile_scale_t scale;    /* > 0 */
    q16_16_t translation[3];
} tuile_pose_t;

typedef struct tuile_instance {
    const tuile_model_t *model;
    tuile_pose_t pose;
    bool two_sided; /* draw back faces too, lit as front faces */
    const tuile_material_t *materials; /* material_count of them in the place of the model's own; NULL: the model's. Without
                                          config.effects a scene has 256 materials at most, those of a model counted once for each
                                          array in their place; with SURFACES there is no limit. A texture that the
                                          model does not have is none; fields out of range are TUILE_ERROR_ARGUMENT */
    uint16_t morph; /* how far towards the second key frame, 0 ... TUILE_MORPH_ONE; 0 for models without one. See TUILE_MORPH_BYTES */
} tuile_instance_t;

#define TUILE_MORPH_ONE 32768u

typedef enum tuile_light_kind {
    TUILE_LIGHT_DIRECTIONAL = 0,
    TUILE_LIGHT_POINT = 1,
} tuile_light_kind_t;

typedef struct tuile_light {
    q2_14_t direction[3]; /* directional: unit vector, world space, the way the light travels */
    uint8_t intensity;    /* 255 = 1.0 */
    uint8_t kind;         /* tuile_light_kind_t; point lights want TUILE_SURFACES */
    uint8_t colour[3];    /* red, green, blue; {0, 0, 0} = white; other colours want TUILE_SURFACES */
    q16_16_t position[3]; /* point: world space */
    q16_16_t range;       /* point: at a distance d the light is intensity * (1 - d^2 / range^2)^2, none from range on; > 0 */
} tuile_light_t;

typedef enum tuile_fog_kind {
    TUILE_FOG_NONE = 0,
    TUILE_FOG_LINEAR = 1,      /* of the colour: (w - near) / (far - near), held to 0 ... 1; w: distance along the view axis */
    TUILE_FOG_EXPONENTIAL = 2, /* 1 - 2^-((w - near) / far), 0 before near: half of the rest every `far` */
} tuile_fog_kind_t;

/* Over faces, lines, edges and sprites, not over the background: give that the fog's colour. What is blended by ADD fades to black,
 * by MULTIPLY to white. */
typedef struct tuile_fog {
    uint8_t kind; /* tuile_fog_kind_t; wants TUILE_SURFACES */
    uint8_t colour[3];
    q16_16_t near, far; /* world units; far > near >= 0 for LINEAR, far > 0 for EXPONENTIAL */
} tuile_fog_t;

/* A straight line between two points of the world, hidden where faces are before it. Wants TUILE_LAYERS. */
typedef struct tuile_line {
    q16_16_t from[3], to[3];
    uint8_t colour[3];
    bool smooth; /* anti-aliased, else Bresenham's */
} tuile_line_t;

/* A picture, disc or square that always faces the camera, hidden where faces are before it. Wants TUILE_LAYERS. */
typedef struct tuile_sprite {
    q16_16_t at[3];                 /* world: its centre */
    q16_16_t width, height;         /* world units; or pixels if `pixels` */
    const tuile_texture_t *texture; /* NULL: a plain square of `colour` */
    uint8_t colour[3], alpha;       /* multiplied by the texture; alpha 255 = opaque */
    uint8_t blend;                  /* tuile_blend_t */
    bool pixels, round;             /* size is in pixels, whatever the distance; a disc or ellipse instead of the rectangle */
} tuile_sprite_t;

typedef enum tuile_projection {
    TUILE_PERSPECTIVE = 0,
    TUILE_ORTHOGRAPHIC = 1,
} tuile_projection_t;

/* view = rotation * (world - eye); window x = centre_x + focal_x * view.x / -view.z, y = centre_y - focal_y * view.y / -view.z;
 * orthographic: window x = centre_x + focal_x * view.x, y = centre_y - focal_y * view.y. */
typedef struct tuile_camera {
    tuile_projection_t projection;
    q2_30_t rotation[3][3]; /* world to view */
    q16_16_t eye[3];
    q16_16_t focal_x, focal_y;   /* perspective: focal length / pixel pitch, in pixels; orthographic: pixels per unit */
    q16_16_t centre_x, centre_y; /* principal point in pixels; the middle of a window is width / 2, height / 2 */
    q16_16_t near, far;          /* distances along the view axis; faces are clipped to them. Perspective: near > 0 */
} tuile_camera_t;

/* Sets rotation and eye. up need not be perpendicular to the view, only not parallel to it. */
int tuile_camera_look_at(tuile_camera_t *camera, const q16_16_t eye[3], const q16_16_t at[3], const q16_16_t up[3]);

/* Focal length in pixels for a full field of view (0 < fov < half a turn) across size_px pixels. 0 when out of range. */
q16_16_t tuile_focal_px(bam16_t fov, uint16_t size_px);

/* Rotation by angle about x (0), y (1) or z (2), counter-clockwise seen from the positive end of the axis. */
void tuile_rotation(q2_30_t rotation[3][3], int axis, bam16_t angle);

q2_30_t tuile_sin(bam16_t angle);
q2_30_t tuile_cos(bam16_t angle);

typedef struct tuile_scene {
    const tuile_instance_t *instances;
    uint16_t instance_count;
    const tuile_light_t *lights;
    uint8_t light_count;
    uint8_t ambient;       /* 255 = 1.0 */
    uint8_t background[3]; /* red, green, blue */
    tuile_camera_t camera;
    uint8_t ambient_colour[3]; /* {0, 0, 0} = white; others want TUILE_SURFACES */
    tuile_fog_t fog;
    const tuile_line_t *lines;
    const tuile_sprite_t *sprites;
    uint16_t line_count, sprite_count;
} tuile_scene_t;

/* ---- renderer ---------------------------------------------------------------------------------------------- */

typedef enum tuile_format {
    TUILE_RGB565_BE = 0, /* 2 bytes a pixel, high byte first: what MIPI DCS panels take */
    TUILE_RGB565_LE = 1,
    TUILE_FACE_IDS = 2, /* 4 bytes a pixel, a native uint32_t: 0 = background, else 1 + face index counted through the
                           instances in order (of each, its model's face order); translucent faces count as opaque */
    TUILE_RGB444 = 3,   /* 12 bits: two pixels in 3 bytes, R1G1 B1R2 G2B2; tiles are an even number of pixels wide */
    TUILE_RGB666 = 4,   /* 3 bytes, each colour in the upper 6 bits of one */
    TUILE_RGB332 = 5,   /* 1 byte */
    TUILE_GREY8 = 6,    /* 1 byte of luminance */
    TUILE_GREY4 = 7,    /* 4 bits, the left one of two pixels in the high half; tiles are an even number of pixels wide */
    TUILE_MONO_PAGES = 8, /* 1 bit: a byte is 8 pixels below one another, bit 0 on top, bytes run along the row; tiles are a
                             multiple of 8 high */
    TUILE_MONO_ROWS = 9,  /* 1 bit: a byte is 8 pixels beside one another, bit 7 left; tiles are a multiple of 8 wide */
    TUILE_MONO_PAGES_TURNED = 10, /* MONO_PAGES with x and y exchanged, for panels that cannot exchange them: pixel (x, y) of a tile is
                                     bit x % 8 of byte x / 8 * height + y; tiles are a multiple of 8 wide */
    TUILE_GREY4_TURNED = 11, /* GREY4 with x and y exchanged: pixel (x, y) of a tile is in byte x * ((height + 1) / 2) + y / 2, in
                                the high half where y is even; tiles are an even number of pixels high */
    TUILE_RGB111 = 12,   /* 1 bit a colour: two pixels a byte, 00RGBRGB, the left one in the upper three bits; tiles are an even
                            number of pixels wide */
    TUILE_XRGB1111 = 13, /* 4 bits, 0RGB, the left one of two pixels in the high half; tiles are an even number of pixels wide */
    TUILE_BGR888 = 14,   /* 3 bytes: blue, green, red */
    TUILE_XRGB8888 = 15, /* 4 bytes: blue, green, red, 0 */
} tuile_format_t;
#define TUILE_FORMAT_COUNT 16

/* What beside white directional light, flat or Gouraud, on opaque faces a renderer is laid out for: or-ed. Without SURFACES textures,
 * vertex colours, emission and highlights of models are left out and faces have the colours of their materials. Without LAYERS
 * translucent faces are drawn as opaque ones. */
typedef enum tuile_effects {
    TUILE_SURFACES = 1, /* textures, vertex colours, coloured and point lights, highlights, emission, fog */
    TUILE_LAYERS = 2,   /* translucent faces, lines, sprites, wireframes; brings SURFACES with it */
} tuile_effects_t;

/* Supersampling: each pixel is the mean of so many samples, on a regular grid inside it. */
typedef enum tuile_aa {
    TUILE_AA_NONE = 0,
    TUILE_AA_2X2 = 1,
    TUILE_AA_4X4 = 2,
} tuile_aa_t;

/* Edges of faces as lines, over the faces; want TUILE_LAYERS. */
typedef enum tuile_edges {
    TUILE_EDGES_NONE = 0,
    TUILE_EDGES_ALL = 1,     /* all edges, and no faces */
    TUILE_EDGES_FRONT = 2,   /* edges of front faces, and no faces */
    TUILE_EDGES_HIDDEN = 3,  /* edges of front faces that no face hides; faces in the background's colour */
    TUILE_EDGES_OUTLINE = 4, /* silhouettes over the shaded faces */
} tuile_edges_t;

/* How textures are drawn, whatever their materials say; for study and for comparison. Or-ed. */
typedef enum tuile_texturing {
    TUILE_TEXTURE_AFFINE = 1,   /* without perspective correction */
    TUILE_TEXTURE_NEAREST = 2,  /* no interpolation between texels */
    TUILE_TEXTURE_NO_MIPS = 4,  /* level 0 only */
    TUILE_TEXTURE_OFF = 8,      /* colours of materials only */
} tuile_texturing_t;

/* Hidden-surface methods. They show the same face at every pixel, but for pixels where two faces are within one step of depth. */
typedef enum tuile_method {
    TUILE_ZBUFFER = 0,  /* 16 bits of depth per pixel of a tile; draws any scene in the least memory */
    TUILE_SCANLINE = 1, /* depth of one line of a tile, and the faces that cross it */
    TUILE_WARNOCK = 2,  /* no depth: windows divided until one face fills each */
    TUILE_PAINTER = 3,  /* no depth: faces sorted back to front for each frame, and cut where they cross */
    TUILE_TREE = 4,     /* no depth and no sort: the order stands in the models (`tuile mesh --tree`) */
} tuile_method_t;

typedef enum tuile_shade {
    TUILE_FLAT = 0,    /* one colour a face, from the face's normal */
    TUILE_GOURAUD = 1, /* light at each corner, interpolated */
} tuile_shade_t;

typedef enum tuile_tie {
    TUILE_TIE_FIRST = 0, /* of two faces equally deep the one with the lower index is seen */
    TUILE_TIE_LAST = 1,
} tuile_tie_t;

#define TUILE_WINDOW_MAX_PX 1024 /* width and height */

/* How TUILE_WARNOCK divides, or-ed together. They draw the same picture; tuile_stats_t tells what each of them takes. */
typedef enum tuile_warnock {
    TUILE_WARNOCK_QUARTERS = 1, /* nothing but quarters, down to single pixels; what the others are compared with */
    TUILE_WARNOCK_SINGLE = 2,   /* a window that one face meets, before the background or a face behind it, is painted at once */
    TUILE_WARNOCK_BOX = 4,      /* windows that few faces meet are cut along the sides of a face's bounding box */
    TUILE_WARNOCK_SORTED = 8,   /* the faces of a tile are sorted by their nearest vertex */
    TUILE_WARNOCK_PIXELS = 16, /* a window of up to 32 pixels goes to pixels at once: coverage as bits, depth where faces overlap */
} tuile_warnock_t;

/* Why a window was divided no further. */
typedef enum tuile_why {
    TUILE_WHY_EMPTY = 0,      /* no face meets it */
    TUILE_WHY_SINGLE = 1,     /* one face meets it, before the background or a face that fills it */
    TUILE_WHY_SURROUNDED = 2, /* a face fills it and hides all others in it */
    TUILE_WHY_PIXEL = 3,      /* it is one pixel */
} tuile_why_t;

/* Callbacks for those who want to watch; any of them may be NULL. */
typedef struct tuile_trace {
    void *context;
    /* A tile comes: pixels left ... right - 1, top ... bottom - 1. Then each face that reaches into its rows, in the order in which
     * faces are drawn within the pass (number counts on from tile to tile of a pass; methods that paint show the later face), with
     * its id (TUILE_FACE_IDS, else 0), and behind it each run of pixels first ... end - 1 of a row that it covers in the tile. */
    void (*tile)(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom);
    void (*face)(void *context, uint32_t number, uint32_t id);
    void (*span)(void *context, unsigned row, unsigned first, unsigned end);
    /* TUILE_WARNOCK: pixels left ... right - 1, top ... bottom - 1 have their colours; why: tuile_why_t. */
    void (*window)(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom, unsigned why);
} tuile_trace_t;

/* The pixels of a tile, for what is drawn over the faces: overlay/overlay.h has what draws into it. */
typedef struct tuile_canvas tuile_canvas_t;
typedef void (*tuile_overlay_fn)(void *context, tuile_canvas_t *canvas);

/* Zero = default, throughout. */
typedef struct tuile_config {
    uint16_t width, height;           /* window, 1 ... TUILE_WINDOW_MAX_PX */
    uint16_t tile_width, tile_height; /* 0 = whole width; 0 = as high as suits the block, at most 24 rows */
    uint8_t format;                   /* tuile_format_t */
    uint8_t method;                   /* tuile_method_t */
    uint8_t shade;                    /* tuile_shade_t */
    uint8_t tie;                      /* tuile_tie_t */
    uint8_t buffers;                  /* tiles in flight: 1 or 2; 0 = 2 */
    uint16_t cluster_vertices;        /* largest cluster of any model to be drawn (cluster_vertices_max), 0 = 255 */
    uint16_t corners;                 /* corners of the face with most (corners_max), up to 255, 0 = 4 */
    uint16_t tree_depth;              /* deepest tree of any model to be drawn (tree_depth), TUILE_TREE only; 0 = 64 */
    uint16_t tile_first, tile_step;   /* draw tiles first, first + step, ... in row-major order; step 0 = 1 */
    uint16_t row_first, row_end;      /* draw only the tiles that start in rows [first, end); end 0 = height */
    uint8_t warnock;                  /* tuile_warnock_t; 0 = SINGLE | BOX | PIXELS */
    const tuile_trace_t *trace;       /* NULL = none; outlives the renderer */
    uint8_t effects;                  /* tuile_effects_t, or-ed */
    uint8_t aa;                       /* tuile_aa_t. Width and height times the samples along them are at most TUILE_SAMPLES_MAX */
    uint8_t edges;                    /* tuile_edges_t */
    uint8_t texturing;                /* tuile_texturing_t, or-ed */
    bool dither;                      /* ordered, by an 8x8 matrix that is fixed to the window; RGB and grey formats, always for mono */
    uint8_t edge_colour[3];           /* of edges */
    tuile_overlay_fn overlay;         /* called for each tile when its faces are drawn; NULL = none */
    void *overlay_context;
} tuile_config_t;

#define TUILE_SAMPLES_MAX 1920 /* along the width or the height of the window */

/* Constant expressions for the size of the block, in bytes. */
/* Tile bytes as they go out. */
#define TUILE_WIRE_BYTES(format, w, h)                                                                       \
    ((format) <= TUILE_RGB565_LE                                 ? (size_t)2 * (w) * (h)                      \
     : (format) == TUILE_FACE_IDS || (format) == TUILE_XRGB8888  ? (size_t)4 * (w) * (h)                      \
     : (format) == TUILE_RGB666 || (format) == TUILE_BGR888      ? (size_t)3 * (w) * (h)                      \
     : (format) == TUILE_RGB444                                  ? ((size_t)3 * (w) * (h) + 1u) / 2u          \
     : (format) == TUILE_RGB332 || (format) == TUILE_GREY8       ? (size_t)(w) * (h)                          \
     : (format) == TUILE_RGB111                                  ? ((size_t)(w) * (h) + 1u) / 2u              \
     : (format) == TUILE_GREY4 || (format) == TUILE_XRGB1111     ? (((size_t)(w) + 1u) / 2u) * (h)            \
     : (format) == TUILE_GREY4_TURNED                            ? (((size_t)(h) + 1u) / 2u) * (w)            \
     : (format) == TUILE_MONO_PAGES                              ? (size_t)(w) * (((h) + 7u) / 8u)            \
                                                                 : (((size_t)(w) + 7u) / 8u) * (h))
/* Bytes of a sample while a tile is drawn: 16 bits of colour in the wire's own steps or of luminance; 4 where colours are kept whole. */
#define TUILE_SAMPLE_BYTES(format, dither)                                                                                          \
    ((format) == TUILE_FACE_IDS || (format) == TUILE_RGB666 || (format) >= TUILE_RGB111 || ((dither) && ((format) <= TUILE_RGB332)) \
         ? 4u                                                                                                                       \
         : 2u)
/* Does a tile become wire bytes in a step of its own? Else it is drawn in them. */
#define TUILE_RESOLVES(format, samples, dither) \
    ((format) != TUILE_FACE_IDS && ((format) > TUILE_FACE_IDS || (samples) > 1 || (dither)))
#define TUILE_ALIGN8(n) (((n) + 7u) & ~(size_t)7u)
#define TUILE_ALIGN64(n) (((n) + 63u) & ~(size_t)63u)
#define TUILE_STATE_BYTES 1280u /* the renderer itself: an upper bound, asserted */
#define TUILE_CLIP_BYTES 512u   /* room for one clipped face of up to four corners */
/* The same for more corners: to be added to the sizes below. A plane may turn n vertices of a face that is not convex into 3 n / 2,
 * and there are six: n * 1.5^6 vertices of 8 bytes. */
#define TUILE_CORNERS_BYTES(corners) ((corners) > 4u ? 96u * (size_t)(corners) : 0u)
/* State, tile buffers, their depth, one shading ramp and the table of tile rows. */
#define TUILE_FIXED_BYTES(height, tile_w, tile_h, format, buffers)                    \
    (TUILE_STATE_BYTES + TUILE_ALIGN64(2u * (tile_w) * (tile_h)) +                    \
     (buffers)*TUILE_ALIGN64(TUILE_WIRE_BYTES(format, tile_w, tile_h)) + 128u +       \
     TUILE_ALIGN8(2u * (((height) + (tile_h)-1u) / (tile_h))))
/* What more than that a renderer takes with effects, anti-aliasing, dithering or a format that is resolved: to be added. `samples`
 * is 1, 2 or 4, along one axis. */
#define TUILE_SAMPLE_COUNT(tile_w, tile_h, samples) ((size_t)(tile_w) * (tile_h) * (samples) * (samples))
#define TUILE_DEPTH_EXTRA_BYTES(tile_w, tile_h, samples) \
    (TUILE_ALIGN64(2u * TUILE_SAMPLE_COUNT(tile_w, tile_h, samples)) - TUILE_ALIGN64(2u * (tile_w) * (tile_h)))
#define TUILE_WORKING_BYTES(tile_w, tile_h, format, samples, dither)                                    \
    (TUILE_RESOLVES(format, samples, dither)                                                            \
         ? TUILE_ALIGN64(TUILE_SAMPLE_BYTES(format, dither) * TUILE_SAMPLE_COUNT(tile_w, tile_h, samples)) \
         : (size_t)0)
#define TUILE_NUMBER_BYTES(tile_w, tile_h, samples) TUILE_ALIGN64(2u * TUILE_SAMPLE_COUNT(tile_w, tile_h, samples))
/* TUILE_LAYERS: which materials are translucent, and a row of samples of the tile. */
#define TUILE_LAYER_SAMPLE_BYTES 16u
#define TUILE_LAYER_HEAD_BYTES 64u
#define TUILE_LAYER_BYTES(tile_w, samples) \
    (TUILE_LAYER_HEAD_BYTES + TUILE_ALIGN64(TUILE_LAYER_SAMPLE_BYTES * (size_t)(tile_w) * (samples)))
#define TUILE_SURFACE_BYTES(cluster_vertices) (16u + 4u * (size_t)(cluster_vertices) + 2u * TUILE_CLIP_BYTES)
/* The least block in which TUILE_ZBUFFER draws any scene whose clusters have at most cluster_vertices vertices and whose faces at
 * most four corners. Other methods have no depth of a tile and other things (tuile_init tells the size); so has TUILE_TREE a least
 * block that draws any scene of objects that planes separate. TUILE_SCANLINE, TUILE_WARNOCK and TUILE_PAINTER also want room for
 * all faces of one tile at once: without it tuile_next returns TUILE_ERROR_MEMORY. */
#define TUILE_LEAST_BYTES(height, tile_w, tile_h, format, buffers, cluster_vertices) \
    (TUILE_FIXED_BYTES(height, tile_w, tile_h, format, buffers) + 8u * (cluster_vertices) + TUILE_CLIP_BYTES)
/* The same with effects (tuile_effects_t, or-ed), anti-aliasing (tuile_aa_t) and dithering. Colours that are kept whole are shaded as
 * with TUILE_SURFACES. */
#define TUILE_DEFERS(format, effects, dither) \
    ((effects) != 0 || ((format) != TUILE_FACE_IDS && TUILE_SAMPLE_BYTES(format, dither) == 4u))
#define TUILE_BLOCK_BYTES(height, tile_w, tile_h, format, buffers, cluster_vertices, effects, aa, dither)          \
    (TUILE_LEAST_BYTES(height, tile_w, tile_h, format, buffers, cluster_vertices) +                                \
     TUILE_DEPTH_EXTRA_BYTES(tile_w, tile_h, 1u << (aa)) +                                                         \
     TUILE_WORKING_BYTES(tile_w, tile_h, format, 1u << (aa), dither) +                                             \
     (TUILE_DEFERS(format, effects, dither)                                                                        \
          ? TUILE_NUMBER_BYTES(tile_w, tile_h, 1u << (aa)) + TUILE_SURFACE_BYTES(cluster_vertices)                 \
          : (size_t)0) +                                                                                           \
     ((effects)&TUILE_LAYERS ? TUILE_LAYER_BYTES(tile_w, 1u << (aa)) : (size_t)0))

/* What a frame with an instance whose morph is not 0 takes besides: to be added. vertices and faces: of the largest cluster of the
 * models that morph; `tuile mesh` makes clusters of at most TUILE_MORPH_FACES faces. */
#define TUILE_MORPH_FACES 128u
#define TUILE_MORPH_BYTES(vertices, faces) TUILE_ALIGN8(12u * (vertices) + 3u * (faces))

/* What a frame takes besides in which some light is coloured or a point, or there are more than 8 of them, or some material has a
 * highlight or two sides: to be added. */
#define TUILE_LIGHTS_BYTES(lights) (40u + 64u * (size_t)(lights))

typedef struct tuile tuile_t;

/* Lays a renderer out in block, which must be 8-byte aligned and outlive it. Nothing else is ever written but the block.
 * wanted_bytes (may be NULL) receives the least size for this configuration, whether or not the call succeeds.
 * TUILE_ERROR_MEMORY when size_bytes is less. */
int tuile_init(tuile_t **renderer, const tuile_config_t *config, void *block, size_t size_bytes, size_t *wanted_bytes);

/* After TUILE_ERROR_MEMORY from tuile_begin or tuile_next: the size of a block that would have been enough there, in bytes. Where
 * the painter's method cuts faces, how often cannot be foreseen: a larger size to be tried next. */
size_t tuile_wanted(const tuile_t *renderer);

/* The configuration in force, with every default filled in. */
const tuile_config_t *tuile_config(const tuile_t *renderer);

/* Starts a frame. The scene and all it points to stay unchanged until tuile_end. TUILE_TREE: every model must have a tree
 * (TUILE_ERROR_TREE); TUILE_ERROR_MEMORY when the order of the objects finds no room. */
int tuile_begin(tuile_t *renderer, const tuile_scene_t *scene);

typedef struct tuile_tile {
    uint16_t x, y, width, height; /* rectangle in the window, cut to it */
    uint8_t *bytes;               /* width * height pixels, row by row without gaps, in wire order; the caller may change them. GREY4,
                                     XRGB1111 and MONO_ROWS: rows begin on whole bytes, MONO_PAGES: pages of 8 rows follow one another,
                                     turned formats: the same with columns for rows; bits beyond the tile are 0 */
    uint32_t size_bytes;
} tuile_tile_t;

/* Draws the next tile. Returns 1 and the tile, 0 when the frame is complete, or an error.
 * tile->bytes stay valid until `buffers` more calls have been made: with two buffers one tile may be on the wire
 * while the next is drawn. */
int tuile_next(tuile_t *renderer, tuile_tile_t *tile);

/* What the next tuile_next does before it writes a tile's bytes: vertices and faces, where its tile is the first of a pass. tuile_next
 * then leaves it out, so that a caller may make it while all buffers are on the wire. Returns 1, 0 when the frame is complete, or an
 * error, as tuile_next would. */
int tuile_prepare(tuile_t *renderer);

/* Draws one tile out of turn, by its number in row-major order; tuile_next then goes on behind it. Any order gives the
 * same picture; going forward row by row is the cheap one. */
int tuile_seek(tuile_t *renderer, uint32_t tile_index);

/* Figures of a frame. Counts of work are summed over passes: what was done, not what was there. */
typedef struct tuile_stats {
    uint32_t faces;                /* in the scene */
    uint32_t clusters;             /* looked at */
    uint32_t clusters_outside;     /* dropped whole: outside the window, near or far plane */
    uint32_t clusters_facing_away; /* dropped whole: normal cone */
    uint32_t vertices;             /* transformed */
    uint32_t faces_tested;         /* of the clusters that were left */
    uint32_t faces_back;           /* culled by signed area */
    uint32_t faces_degenerate;     /* no area after snapping */
    uint32_t faces_outside;        /* outside the window or the band of the pass, or between pixel centres */
    uint32_t faces_clipped;        /* cut by near plane, far plane or guard band */
    uint32_t faces_clipped_away;   /* nothing left of them */
    uint32_t faces_binned;         /* handed to tiles */
    uint32_t faces_setup;          /* edge and gradient set-ups */
    uint32_t faces_resumed;        /* set up again because there was no room to carry their state */
    uint32_t passes;               /* over the model, failed attempts included */
    uint32_t tiles;
    uint32_t tiles_narrow;     /* that took a pass of their own, for lack of memory */
    uint32_t active_max;       /* scan-line: most faces on one line of a tile */
    uint32_t windows;          /* Warnock: windows looked at, the tiles themselves among them, */
    uint32_t windows_depth;    /* the greatest number of divisions that led to one, */
    uint32_t windows_pixels;   /* how many were one pixel in the end and decided as such, */
    uint32_t windows_waiting;  /* and the most that were on the stack at once */
    uint32_t compared;         /* painter: pairs of faces compared, of those whose boxes and depths overlap, */
    uint32_t moved;            /* faces moved before another, */
    uint32_t splits;           /* and cut because they cross or overlap in a cycle */
    uint32_t nodes;            /* tree: nodes visited */
    uint32_t instances_sorted; /* tree: instances that no plane separates from one another, drawn by the painter's method */
    uint32_t instances;         /* looked at */
    uint32_t instances_outside; /* dropped whole: outside the window, near or far plane */
    uint32_t glyphs_missing;   /* overlay: boxes drawn for characters that a font has not */
    uint32_t size_bytes;       /* the block */
    uint32_t least_bytes;      /* the least block for this configuration */
    uint32_t peak_bytes;       /* a block of so many, or of least_bytes where they are more, gives no more passes */
} tuile_stats_t;

/* Ends a frame, complete or not. stats may be NULL. */
int tuile_end(tuile_t *renderer, tuile_stats_t *stats);

/* ---- picking ----------------------------------------------------------------------------------------------- */

typedef struct tuile_hit {
    uint16_t instance;
    uint32_t face;     /* index in the instance's model */
    uint16_t depth;    /* as in the depth buffer */
    q16_16_t point[3]; /* on the plane of the face, in steps of the model relative to its offset, times 65536 */
} tuile_hit_t;

/* The face seen at pixel (x, y) of the window that config describes, and the point of it there: where the ray through the pixel's
 * centre meets the plane of the face (saturated where the face is seen from its edge). block: scratch, 8-byte aligned, of at least
 * TUILE_PICK_BYTES. Only config's width, height, tie, cluster_vertices and corners matter. Returns 1 and the hit, 0 where the
 * background is seen, or an error. */
#define TUILE_PICK_BYTES(height, cluster_vertices) TUILE_LEAST_BYTES(height, 1u, 1u, TUILE_FACE_IDS, 1u, cluster_vertices)
int tuile_pick(const tuile_scene_t *scene, const tuile_config_t *config, uint16_t x, uint16_t y, void *block, size_t size_bytes,
               tuile_hit_t *hit);

#endif
