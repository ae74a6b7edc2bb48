/* A frame: the block laid out, one tile after the other. How a tile comes by its faces is pass.c's. */
#include "frame.h"

#include "../features.h"
#include "../memory.h"

const char *tuile_error_text(int error) {
    switch (error) {
    case TUILE_OK: return "no error";
    case TUILE_ERROR_ARGUMENT: return "an argument is out of range";
    case TUILE_ERROR_MEMORY: return "the memory block is too small";
    case TUILE_ERROR_MODEL: return "not a compiled model, or a damaged one";
    case TUILE_ERROR_CAMERA: return "the camera is degenerate";
    case TUILE_ERROR_RANGE: return "model, pose and camera leave the number range";
    case TUILE_ERROR_SEQUENCE: return "called out of sequence";
    case TUILE_ERROR_LIMITS:
        return "a model has larger clusters, faces with more corners or a deeper tree than the renderer was laid out for";
    case TUILE_ERROR_TREE: return "a model has no display tree";
    case TUILE_ERROR_EFFECTS: return "the scene asks for effects that the renderer was not laid out or built for";
    case TUILE_ERROR_FONT: return "not a compiled font, or a damaged one";
    default: return "unknown error";
    }
}

/* ---- init ---- */

/* Boards that draw by one method leave out the code of the others: -DTUILE_METHODS=1 keeps the z-buffer only. */
#ifndef TUILE_METHODS
#define TUILE_METHODS 0x1f
#endif
#define METHOD(number, method) ((TUILE_METHODS) >> (number)&1 ? &(method) : NULL)

static const visibility_method_t *method_of(uint8_t number) {
    switch (number) {
    case TUILE_ZBUFFER: return METHOD(TUILE_ZBUFFER, visibility_zbuffer);
    case TUILE_SCANLINE: return METHOD(TUILE_SCANLINE, visibility_scanline);
    case TUILE_WARNOCK: return METHOD(TUILE_WARNOCK, visibility_warnock);
    case TUILE_PAINTER: return METHOD(TUILE_PAINTER, visibility_painter);
    case TUILE_TREE: return METHOD(TUILE_TREE, visibility_tree);
    default: return NULL;
    }
}

/* Layers want the depth of a tile, which the z-buffer has; c in pixels. */
static size_t layer_depth_bytes(const tuile_config_t *c) {
    if (!(c->effects & TUILE_LAYERS) || c->method == TUILE_ZBUFFER) { return 0; }
    return TUILE_NUMBER_BYTES(c->tile_width, c->tile_height, 1u << c->aa);
}

/* Of a tile of width x height pixels. */
static size_t wire_bytes(uint8_t format, size_t width, size_t height) { return TUILE_WIRE_BYTES(format, width, height); }

/* What of a block grows with the tile, but for the method's own memory; c in pixels. */
static size_t tile_bytes_of(const tuile_config_t *c) {
    const unsigned samples = 1u << c->aa;
    size_t bytes = c->buffers * TUILE_ALIGN64(wire_bytes(c->format, c->tile_width, c->tile_height));
    bytes += TUILE_WORKING_BYTES(c->tile_width, c->tile_height, c->format, samples, c->dither);
    if (c->effects) { bytes += TUILE_NUMBER_BYTES(c->tile_width, c->tile_height, samples); }
    bytes += layer_depth_bytes(c);
    if (c->effects & TUILE_LAYERS) { bytes += TUILE_LAYER_BYTES(c->tile_width, samples); }
    return bytes;
}

/* Rows that a tile's height must be a multiple of, unless it reaches the window's lower end. */
static uint16_t rows_together(const tuile_config_t *c) {
    return c->format == TUILE_MONO_PAGES ? 8 : c->format == TUILE_GREY4_TURNED ? 2 : 1;
}

/* Columns that a tile's width must be a multiple of, unless it reaches the window's right end. */
static uint16_t columns_together(const tuile_config_t *c) {
    switch (c->format) {
    case TUILE_MONO_ROWS:
    case TUILE_MONO_PAGES_TURNED: return 8;
    case TUILE_RGB444:
    case TUILE_GREY4:
    case TUILE_RGB111:
    case TUILE_XRGB1111: return 2;
    default: return 1;
    }
}

static bool is_mono(const tuile_config_t *c) {
    return c->format == TUILE_MONO_PAGES || c->format == TUILE_MONO_PAGES_TURNED || c->format == TUILE_MONO_ROWS;
}

/* Tile height that leaves five sixths of the block to the arena: a second pass costs more than lower tiles do. */
static uint16_t default_tile_height(const tuile_config_t *given, size_t size_bytes) {
    tuile_config_t c = *given;
    const size_t together = rows_together(&c);
    c.tile_height = (uint16_t)together;
    const size_t depth = c.method == TUILE_ZBUFFER ? sizeof(uint16_t) << 2 * c.aa : 0;
    const size_t band_bytes = (size_t)c.tile_width * together * depth + tile_bytes_of(&c);
    size_t rows = size_bytes / 6u / band_bytes * together;
    rows = rows > 24 ? 24 : rows < together ? together : rows;
    return (uint16_t)(rows > c.height ? c.height : rows);
}

static bool layers_refused(const tuile_config_t *c) {
    const bool layers = c->effects & TUILE_LAYERS;
    return (layers && !TUILE_HAS(LAYERS)) || (c->edges != TUILE_EDGES_NONE && (!layers || !TUILE_HAS(LINES)));
}

static bool config_complete(tuile_config_t *c, size_t size_bytes) {
    if (c->width == 0 || c->height == 0 || c->width > TUILE_WINDOW_MAX_PX || c->height > TUILE_WINDOW_MAX_PX || c->buffers > 2 ||
        c->format >= TUILE_FORMAT_COUNT || method_of(c->method) == NULL || c->shade > TUILE_GOURAUD || c->tie > TUILE_TIE_LAST ||
        c->tile_width > TUILE_WINDOW_MAX_PX || c->tile_height > TUILE_WINDOW_MAX_PX || c->cluster_vertices > 255 ||
        c->corners > 255 || c->row_first > c->height || c->row_end > c->height || (c->row_end != 0 && c->row_end < c->row_first) ||
        c->warnock > 31 || c->aa > TUILE_AA_4X4 || c->effects > 3 || c->edges > TUILE_EDGES_OUTLINE || c->texturing > 15 ||
        c->width << c->aa > TUILE_SAMPLES_MAX || c->height << c->aa > TUILE_SAMPLES_MAX || layers_refused(c) ||
        (!TUILE_HAS(OVERLAY) && c->overlay) || !TUILE_HAS_FORMAT(c->format) ||
        (!TUILE_HAS(RESOLVE) && TUILE_RESOLVES(c->format, 1u << c->aa, c->dither)) || (!TUILE_HAS(SAMPLES) && c->aa) ||
        (!TUILE_HAS(SURFACES) && TUILE_DEFERS(c->format, c->effects, c->dither)) ||
        (c->format == TUILE_FACE_IDS && (c->aa || c->dither || c->effects || c->overlay))) {
        return false;
    }
    if (c->effects & TUILE_LAYERS) { c->effects |= TUILE_SURFACES; }
    if (is_mono(c)) { c->dither = true; }
    if (TUILE_SAMPLE_BYTES(c->format, c->dither) == 4 && c->format != TUILE_FACE_IDS) { c->effects |= TUILE_SURFACES; }
    if (c->buffers == 0) { c->buffers = 2; }
    if (c->tile_width == 0 || c->tile_width > c->width) { c->tile_width = c->width; }
    if (c->tile_height == 0) { c->tile_height = default_tile_height(c, size_bytes); }
    if (c->tile_height > c->height) { c->tile_height = c->height; }
    if ((c->tile_height % rows_together(c) != 0 && c->tile_height != c->height) ||
        (c->tile_width % columns_together(c) != 0 && c->tile_width != c->width)) {
        return false;
    }
    if (c->cluster_vertices == 0) { c->cluster_vertices = 255; }
    if (c->corners == 0) { c->corners = 4; }
    if (c->tree_depth == 0) { c->tree_depth = 64; }
    if (c->tile_step == 0) { c->tile_step = 1; }
    if (c->row_end == 0) { c->row_end = c->height; }
    if (c->warnock == 0) { c->warnock = TUILE_WARNOCK_SINGLE | TUILE_WARNOCK_BOX | TUILE_WARNOCK_PIXELS; }
    return true;
}

/* Window and tiles in samples. */
static void config_sample(tuile_config_t *c) {
    c->width = (uint16_t)(c->width << c->aa);
    c->height = (uint16_t)(c->height << c->aa);
    c->tile_width = (uint16_t)(c->tile_width << c->aa);
    c->tile_height = (uint16_t)(c->tile_height << c->aa);
    c->row_first = (uint16_t)(c->row_first << c->aa);
    c->row_end = (uint16_t)(c->row_end << c->aa);
}

/* One row of samples at least; more may take an eighth of what the block has beyond the least. */
static size_t layers_lay_out(tuile_t *t, uint8_t *at, size_t depth_bytes) {
    const tuile_config_t *c = &t->config;
    const size_t row = TUILE_LAYER_BYTES(t->given.tile_width, 1u << c->aa) - TUILE_LAYER_HEAD_BYTES;
    size_t rows = 1 + (t->stats.size_bytes - t->stats.least_bytes) / 8 / row;
    if (rows > c->tile_height) { rows = c->tile_height; }
    t->layer_depth = (uint16_t *)(void *)(depth_bytes ? at : (uint8_t *)t->tile_memory);
    t->translucent = (uint32_t *)(void *)(at + depth_bytes);
    t->layer_samples = at + depth_bytes + TUILE_LAYER_HEAD_BYTES;
    t->layer_rows = (uint16_t)rows;
    return depth_bytes + TUILE_LAYER_HEAD_BYTES + rows * row;
}

int tuile_init(tuile_t **renderer, const tuile_config_t *config, void *block, size_t size_bytes, size_t *wanted_bytes) {
    if (renderer == NULL || config == NULL) { return TUILE_ERROR_ARGUMENT; }
    tuile_config_t c = *config;
    *renderer = NULL;
    if (!config_complete(&c, size_bytes)) { return TUILE_ERROR_ARGUMENT; }
    const tuile_config_t given = c;
    const visibility_method_t *method = method_of(c.method);
    const size_t working_bytes = TUILE_WORKING_BYTES(c.tile_width, c.tile_height, c.format, 1u << c.aa, c.dither);
    const size_t number_bytes = c.effects ? TUILE_NUMBER_BYTES(c.tile_width, c.tile_height, 1u << c.aa) : 0;
    const size_t layer_depth = layer_depth_bytes(&c);
    config_sample(&c);
    if (c.edges != TUILE_EDGES_NONE && c.edges != TUILE_EDGES_OUTLINE) { c.shade = TUILE_FLAT; } /* whole faces, no fans */
    const size_t tile_bytes = TUILE_ALIGN64(method->tile_bytes ? method->tile_bytes(&c) : 0);
    const size_t least = TUILE_BLOCK_BYTES((size_t)given.height, (size_t)given.tile_width, (size_t)given.tile_height, c.format,
                                           (size_t)c.buffers, (size_t)c.cluster_vertices, c.effects, c.aa, c.dither) -
                         TUILE_ALIGN64(2u * (size_t)c.tile_width * c.tile_height) + tile_bytes + TUILE_CORNERS_BYTES(c.corners) +
                         layer_depth +
                         /* the stack, the order of up to four instances, the tag of a ramp */
                         (c.method == TUILE_TREE ? TUILE_ALIGN8(4u * (size_t)c.tree_depth) + 8 + 8 : 0);
    if (wanted_bytes) { *wanted_bytes = least; }
    if (block == NULL || size_bytes < least) { return TUILE_ERROR_MEMORY; }
    if ((uintptr_t)block % 8 != 0 || size_bytes > UINT32_MAX) { return TUILE_ERROR_ARGUMENT; }

    tuile_t *t = block;
    uint8_t *at = (uint8_t *)block + TUILE_STATE_BYTES;
    memset(t, 0, sizeof *t);
    t->config = c;
    t->given = given;
    t->samples = c.aa;
    t->pixel_kind = (uint8_t)pixel_kind_of(c.format, c.dither);
    t->stats.size_bytes = (uint32_t)size_bytes;
    t->stats.least_bytes = (uint32_t)least;
    t->tile_columns = (uint16_t)((c.width + c.tile_width - 1) / c.tile_width);
    t->tile_rows = (uint16_t)((c.height + c.tile_height - 1) / c.tile_height);
    t->tile_memory = at;
    at += tile_bytes;
    for (unsigned b = 0; b < c.buffers; b++) {
        t->colours[b] = at;
        at += TUILE_ALIGN64(wire_bytes(c.format, given.tile_width, given.tile_height));
    }
    if (working_bytes) { t->working = at; }
    at += working_bytes;
    if (number_bytes) { t->numbers = (uint16_t *)(void *)at; }
    at += number_bytes;
    if (c.effects & TUILE_LAYERS) { at += layers_lay_out(t, at, layer_depth); }
    t->buckets = (uint16_t *)(void *)at;
    at += TUILE_ALIGN8(2u * (size_t)t->tile_rows);
    t->arena = at;
    t->arena_end = (uint8_t *)block + (size_bytes & ~(size_t)7u);
    t->record_bytes = c.format == TUILE_FACE_IDS || c.effects ? sizeof(record_id_t) : sizeof(record_t);
    t->rows_hint = t->tile_rows;
    t->method = method;
    t->span_kind = c.format == TUILE_FACE_IDS ? SPAN_IDS : c.shade == TUILE_GOURAUD && !c.effects ? SPAN_GOURAUD : SPAN_FLAT;
    *renderer = t;
    return TUILE_OK;
}

size_t tuile_wanted(const tuile_t *t) { return t->wanted_bytes; }

const tuile_config_t *tuile_config(const tuile_t *t) { return &t->given; }

/* ---- begin ---- */

/* Lines and sprites. */
static int check_layers(const tuile_t *t, const tuile_scene_t *scene) {
    if ((scene->line_count != 0 && scene->lines == NULL) || (scene->sprite_count != 0 && scene->sprites == NULL)) {
        return TUILE_ERROR_ARGUMENT;
    }
    if ((scene->line_count | scene->sprite_count) != 0 && !frame_layers(t)) { return TUILE_ERROR_EFFECTS; }
    if (scene->line_count != 0 && !TUILE_HAS(LINES)) { return TUILE_ERROR_EFFECTS; }
    for (unsigned i = 0; i < scene->sprite_count; i++) {
        const tuile_sprite_t *sprite = &scene->sprites[i];
        if (sprite->width < 0 || sprite->height < 0 || sprite->blend > TUILE_BLEND_MULTIPLY) { return TUILE_ERROR_ARGUMENT; }
    }
    return TUILE_OK;
}

static int check_scene(const tuile_t *t, const tuile_scene_t *scene, uint32_t *materials, uint32_t *faces) {
    *materials = *faces = 0;
    const int error = check_layers(t, scene);
    if (error) { return error; }
    if (scene->instance_count != 0 && scene->instances == NULL) { return TUILE_ERROR_ARGUMENT; }
    if (scene->light_count != 0 && scene->lights == NULL) { return TUILE_ERROR_ARGUMENT; }
    for (unsigned i = 0; i < scene->instance_count; i++) {
        const tuile_model_t *model = scene->instances[i].model;
        if (model == NULL) { return TUILE_ERROR_ARGUMENT; }
        if (model->cluster_vertices_max > t->config.cluster_vertices || model->corners_max > t->config.corners) {
            return TUILE_ERROR_LIMITS;
        }
        if (!TUILE_HAS(TEXTURES) && frame_deferred(t) && model->texture_count > 0 && !(t->config.texturing & TUILE_TEXTURE_OFF)) {
            return TUILE_ERROR_EFFECTS;
        }
        if (!TUILE_HAS(MORPH) && scene->instances[i].morph != 0) { return TUILE_ERROR_EFFECTS; }
        if (scene->instances[i].morph > (model->morph_positions ? TUILE_MORPH_ONE : 0)) { return TUILE_ERROR_ARGUMENT; }
        if (!frame_materials_fit(&scene->instances[i])) { return TUILE_ERROR_ARGUMENT; }
        if (frame_counts_materials(t) && frame_first_use(scene, i)) { *materials += model->material_count; }
        *faces += model->face_count;
    }
    return *materials > 256 ? TUILE_ERROR_ARGUMENT : TUILE_OK;
}

/* The camera in samples. */
static int camera_sample(tuile_t *t, const tuile_scene_t *scene) {
    q16_16_t *const lengths[4] = {&t->camera.focal_x, &t->camera.focal_y, &t->camera.centre_x, &t->camera.centre_y};
    t->camera = scene->camera;
    for (unsigned i = 0; i < 4; i++) {
        const int64_t scaled = (int64_t)*lengths[i] * (1 << t->samples);
        if (scaled > INT32_MAX || scaled < INT32_MIN) { return TUILE_ERROR_RANGE; }
        *lengths[i] = (q16_16_t)scaled;
    }
    return TUILE_OK;
}

static bool is_white(const uint8_t colour[3]) {
    return colour[0] == colour[1] && colour[0] == colour[2] && (colour[0] == 0 || colour[0] == 255);
}

/* 1: vertices' 8 bits are not enough for the scene's light; 0; or an error. */
static int scene_colours(const tuile_scene_t *scene) {
    bool coloured = !is_white(scene->ambient_colour) || scene->light_count > TRANSFORM_LIGHTS_MAX;
    for (unsigned l = 0; l < scene->light_count; l++) {
        const tuile_light_t *light = &scene->lights[l];
        const bool point = light->kind == TUILE_LIGHT_POINT;
        if (light->kind > TUILE_LIGHT_POINT || (point && light->range <= 0)) { return TUILE_ERROR_ARGUMENT; }
        coloured |= point || !is_white(light->colour);
    }
    return coloured;
}

/* Light and fog of the scene; those who want no more than ids need none. */
static int begin_light(tuile_t *t, uint8_t **arena) {
    const tuile_fog_t *fog = &t->scene->fog;
    t->fog.kind = TUILE_FOG_NONE;
    t->lamps = NULL;
    t->coloured = t->coloured_scene = t->careful = t->mixed = t->backs = false;
    const int coloured = scene_colours(t->scene);
    if (coloured < 0) { return coloured; }
    if (fog->kind != TUILE_FOG_NONE && t->span_kind != SPAN_IDS) {
        if (!TUILE_HAS(FOG) || !frame_deferred(t)) { return TUILE_ERROR_EFFECTS; }
        const int error = fog_make(&t->fog, fog, &t->camera);
        if (error) { return error; }
    }
    if (coloured && t->span_kind != SPAN_IDS && (!TUILE_HAS(LIGHTS) || !frame_deferred(t))) {
        return t->scene->light_count > TRANSFORM_LIGHTS_MAX ? TUILE_ERROR_ARGUMENT : TUILE_ERROR_EFFECTS;
    }
    return TUILE_HAS(LIGHTS) && (frame_deferred(t) || t->span_kind == SPAN_IDS) ? frame_lights_begin(t, coloured, arena) : TUILE_OK;
}

/* Gouraud: one ramp is always there; the others may take an eighth of the arena. Flat: all may take an eighth of what the block has
 * beyond the least, where no method ever wants more than there is. Returns what is behind them. */
static uint8_t *ramps_lay_out(tuile_t *t, uint32_t materials) {
    const bool gouraud = t->span_kind == SPAN_GOURAUD,
               flat = t->span_kind == SPAN_FLAT && t->numbers == NULL && t->method->draw_now != NULL;
    const size_t bytes = gouraud ? RAMP_BYTES : RAMP_FLAT_BYTES, ramp = bytes + sizeof(int16_t);
    const size_t room = (gouraud ? (size_t)(t->arena_end - t->arena) : t->stats.size_bytes - t->stats.least_bytes) / 8;
    size_t ramps = gouraud || flat ? materials : 0;
    if (ramps > (gouraud ? 1 : 0) && ramps * ramp > room) { ramps = room / ramp > 1 || flat ? room / ramp : 1; }
    t->ramp_count = (uint16_t)ramps;
    t->ramps_few = ramps < (gouraud || flat ? materials : 0);
    t->ramps = (uint16_t *)(void *)t->arena;
    t->ramp_tags = (int16_t *)(void *)(t->arena + ramps * bytes);
    for (size_t i = 0; i < ramps; i++) {
        t->ramp_tags[i] = -1;
    }
    return t->arena + TUILE_ALIGN8(ramps * ramp);
}

int tuile_begin(tuile_t *t, const tuile_scene_t *scene) {
    uint32_t materials, faces;
    if (t == NULL || scene == NULL) { return TUILE_ERROR_ARGUMENT; }
    if (t->in_frame) { return TUILE_ERROR_SEQUENCE; }
    int error = check_scene(t, scene, &materials, &faces);
    if (error) { return error; }

    error = camera_sample(t, scene);
    if (error) { return error; }

    const uint32_t size = t->stats.size_bytes, least = t->stats.least_bytes;
    memset(&t->stats, 0, sizeof t->stats);
    t->stats.size_bytes = size;
    t->stats.least_bytes = least;
    t->stats.faces = faces;
    t->scene = scene;
    t->background =
        pixel_pack((pixel_kind_t)t->pixel_kind, PIXEL_RGB(scene->background[0], scene->background[1], scene->background[2]));

    uint8_t *start = ramps_lay_out(t, materials);
    t->keep = t->immediate_only = false;
    t->textured_any = false;
    t->textured_instance = UINT16_MAX;
    t->textured = t->numbers != NULL && t->config.edges != TUILE_EDGES_HIDDEN && t->config.method == TUILE_ZBUFFER &&
                  t->config.tie == TUILE_TIE_FIRST && t->pixel_kind <= PIXEL_RGB565_LE && scene->fog.kind == TUILE_FOG_NONE;
    if (t->method->begin && (error = t->method->begin(t, &start)) != TUILE_OK) { return error; }
    if ((error = begin_light(t, &start)) != TUILE_OK) { return error; }
    if (TUILE_HAS(MORPH) && (error = frame_morph_begin(t, &start)) != TUILE_OK) { return error; }
    t->vertices = (vertex_t *)(void *)start;
    const size_t slots = (size_t)(t->arena_end - (uint8_t *)t->vertices) / sizeof(vertex_t);
    t->vertex_limit = (uint32_t)(slots > 65535 ? 65535 : slots);
    t->pass_valid = t->narrow = t->immediate = t->shrunk = false;
    t->next_tile = t->config.tile_first;
    t->in_frame = true;
    return TUILE_OK;
}

/* ---- tiles ---- */

static void tile_place(tuile_t *t, uint32_t row, uint32_t column) {
    const tuile_config_t *c = &t->config;
    t->tile.left = (int32_t)(column * c->tile_width);
    t->tile.top = (int32_t)(row * c->tile_height);
    t->tile.right = t->tile.left + c->tile_width < c->width ? t->tile.left + c->tile_width : c->width;
    t->tile.bottom = t->tile.top + c->tile_height < c->height ? t->tile.top + c->tile_height : c->height;
    t->tile.stride_px = t->tile.right - t->tile.left;
    t->tile.depth = NULL;
    t->tile.colour = t->numbers ? t->numbers : t->working ? t->working : t->colours[t->next_buffer];
}

/* 1 when there is another, 0 when the frame is complete. */
static int tile_find(tuile_t *t, uint32_t *row, uint32_t *column) {
    for (;; t->next_tile += t->config.tile_step) {
        *row = t->next_tile / t->tile_columns;
        *column = t->next_tile % t->tile_columns;
        const uint32_t top = *row * t->config.tile_height;
        if (top >= t->config.row_end) { return 0; }
        if (top < t->config.row_first) { continue; }
        tile_place(t, *row, *column);
        return 1;
    }
}

int tuile_prepare(tuile_t *t) {
    uint32_t row, column;
    if (t == NULL) { return TUILE_ERROR_ARGUMENT; }
    if (!t->in_frame) { return TUILE_ERROR_SEQUENCE; }
    if (!tile_find(t, &row, &column)) { return 0; }
    const int error = pass_prepare(t, row, column);
    return error ? error : 1;
}

int tuile_next(tuile_t *t, tuile_tile_t *tile) {
    uint32_t row, column;
    if (t == NULL || tile == NULL) { return TUILE_ERROR_ARGUMENT; }
    if (!t->in_frame) { return TUILE_ERROR_SEQUENCE; }
    if (!tile_find(t, &row, &column)) { return 0; }

    const int error = pass_draw(t, row, column);
    if (error) { return error; }
    tile->x = (uint16_t)(t->tile.left >> t->samples);
    tile->y = (uint16_t)(t->tile.top >> t->samples);
    tile->width = (uint16_t)((t->tile.right - t->tile.left) >> t->samples);
    tile->height = (uint16_t)((t->tile.bottom - t->tile.top) >> t->samples);
    tile->bytes = t->colours[t->next_buffer];
    tile->size_bytes = (uint32_t)wire_bytes(t->config.format, tile->width, tile->height);
    if (TUILE_HAS(OVERLAY) && t->given.overlay) { overlay_tile(t); }
    if (TUILE_HAS(RESOLVE) && t->working) { resolve_tile(t); }
    t->next_buffer = (uint8_t)((t->next_buffer + 1) % t->config.buffers);
    t->next_tile += t->config.tile_step;
    t->stats.tiles++;
    return 1;
}

int tuile_seek(tuile_t *t, uint32_t tile_index) {
    if (t == NULL) { return TUILE_ERROR_ARGUMENT; }
    if (!t->in_frame) { return TUILE_ERROR_SEQUENCE; }
    if (tile_index >= (uint32_t)t->tile_columns * t->tile_rows) { return TUILE_ERROR_ARGUMENT; }
    t->next_tile = tile_index;
    return TUILE_OK;
}

int tuile_end(tuile_t *t, tuile_stats_t *stats) {
    if (t == NULL) { return TUILE_ERROR_ARGUMENT; }
    if (!t->in_frame) { return TUILE_ERROR_SEQUENCE; }
    t->in_frame = false;
    if (stats) { *stats = t->stats; }
    return TUILE_OK;
}
