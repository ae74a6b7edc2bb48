/* tuile render: a model, drawn through tiles, streamed to a simulated panel, and what the panel shows written as pictures. */
#include "../firmware/stream.h"
#include "commands.h"
#include "ids.h"
#include "interrupt.h"
#include "mesh/mesh.h"
#include "options.h"
#include "output.h"
#include "render_display.h"
#include "render_format.h"
#include "render_layer.h"
#include "render_light.h"
#include "render_mesh.h"
#include "render_overlay.h"
#include "render_predict.h"
#include "render_report.h"
#include "render_surface.h"
#include "render_update.h"
#include "render_value.h"
#include "render_world.h"
#include "sheet.h"
#include "show.h"
#include "view.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "Usage: tuile render MODEL [options]\n"
    "\n"
    "MODEL is a .tuile file or anything Assimp reads (OBJ, glTF, PLY, STL, 3DS, Collada ...).\n"
    "\n"
    "  --method M               hidden-surface method: zbuffer (default), scanline, warnock, painter, tree\n"
    "  --warnock V,V,...        how warnock divides: quarters alone, or any of single, box, sorted, pixels; by default "
    "single,box,pixels\n"
    "  --shade flat|gouraud     flat by default\n"
    "  --memory 16K|auto        the renderer's memory; auto is enough for one pass\n"
    "  --tile WxH               tile size in pixels; by default whole rows, as many as suit the memory\n"
    "  --max-faces N            simplify the model first\n"
    "  --triangles              cut polygons into triangles, which keep the polygon's number\n"
    "  --frames N               number of frames, 1 by default\n"
    "  --spin DEG               degrees per frame about --up through --at; by default a full turn in all frames\n"
    "  --eye X,Y,Z --at X,Y,Z --up X,Y,Z   camera, in model units; by default the model is framed\n"
    "  --orbit YAW,PITCH,DIST   the camera round --at, in degrees from +z by way of +x, and upwards; DIST 0 frames all\n"
    "  --fov DEG                vertical field of view, 45 by default\n"
    "  --near N --far F         distances that are drawn, in model units\n"
    "  --ortho SIZE             orthographic: SIZE model units high\n"
    "  --pitch RX,RY            size of a pixel, for panels whose pixels are not square\n"
    "  --centre I,J             principal point in pixels\n"
    "  --background RRGGBB\n"
    "  --out frame-%03d.png     pictures of the panel; PPM when the name ends so\n"
    "  --show METHOD-VIEW       draws by METHOD and makes --out show how: zbuffer-overdraw, scanline-edges, warnock-windows,\n"
    "                           painter-order, tree-order; METHOD-tiles and -overdraw for any\n"
    "  --sheet FILE.png         all frames on one picture\n"
    "  --ids FILE               the visible face of each pixel, as rows of text: the importer's number of the face + 1, 0 = "
    "background\n"
    "  --pick I,J               prints the face seen at a pixel and the point on it in model units\n"
    "  --hash                   prints a hash of the panel's memory for each frame\n"
    "  --report FILE.json       every figure of every frame\n";

static void print_usage(FILE *file) {
    (void)fputs(usage, file);
    (void)fputs(render_display_usage, file);
    (void)fputs(render_update_usage, file);
    (void)fputs(render_predict_usage, file);
    (void)fputs(render_light_usage, file);
    (void)fputs(render_mesh_usage, file);
    (void)fputs(render_format_usage, file);
    (void)fputs(render_surface_usage, file);
    (void)fputs(render_world_usage, file);
    (void)fputs(render_overlay_usage, file);
    (void)fputs(render_layer_usage, file);
}

typedef struct render {
    const char *model_path, *out, *sheet, *ids, *report;
    long frames, max_faces;
    size_t memory_bytes;
    bool hash, pick, has_show;
    show_view_t show;
    double pick_at[2];
    tuile_config_t config;
    render_display_t where;
    render_format_t format;
    render_surface_t surface;
    render_light_t light;
    render_world_t world;
    render_overlay_t overlay;
    render_layer_t layer;
    render_update_t update;
    render_predict_t predict;
    mesh_options_t mesh_options;
    view_options_t view_options;

    uint8_t *bytes;
    tuile_model_t model, sizes; /* sizes: of all models together */
    view_t view;
    target_t target;
    bool on_display; /* else frames are decoded without one */
    void *block;
    tuile_t *renderer;
    sim_picture_t *pictures; /* of all frames, for the sheet */
    output_t report_file;
    uint64_t frame_ns; /* on the wire, of the last frame */
    tuile_stats_t stats;
    unsigned passes_max;
    uint32_t peak_bytes;
    uint64_t wire_bytes;
    sim_error_t error;
} render_t;

static int parse(render_t *r, int count, char **arguments) {
    static const char *const shades[] = {"flat", "gouraud", NULL};
    view_options_t *v = &r->view_options;
    options_t options;
    const char *argument;
    int choice;

    r->frames = 1;
    *v = VIEW_OPTIONS_DEFAULT;
    options_open(&options, count, arguments);
    while ((argument = options_next(&options)) != NULL) {
        const double far = 1e12;
        if (!options.name) {
            if (r->model_path) {
                return command_fail("render: one model at a time, but got %s and %s", r->model_path, argument), EXIT_USAGE;
            }
            r->model_path = argument;
        } else if (strcmp(argument, "--method") == 0) {
            if (options_choice(&options, &choice, options_methods)) { r->config.method = (uint8_t)choice; }
        } else if (strcmp(argument, "--warnock") == 0) {
            (void)render_value_warnock(&options, &r->config.warnock);
        } else if (strcmp(argument, "--shade") == 0) {
            if (options_choice(&options, &choice, shades)) { r->config.shade = (uint8_t)choice; }
        } else if (strcmp(argument, "--memory") == 0) {
            const char *value = options.inlined ? options.inlined : options.at < count ? arguments[options.at] : "";
            if (strcmp(value, "auto") == 0) {
                (void)options_value(&options);
                r->memory_bytes = 0;
            } else {
                (void)options_size(&options, &r->memory_bytes);
                if (r->memory_bytes == 0) { r->memory_bytes = 1; }
            }
        } else if (strcmp(argument, "--tile") == 0) {
            (void)options_tile(&options, &r->config.tile_width, &r->config.tile_height);
        } else if (strcmp(argument, "--max-faces") == 0) {
            (void)options_integer(&options, &r->max_faces, 1, 100000000);
        } else if (strcmp(argument, "--triangles") == 0) {
            r->mesh_options.triangles = true;
        } else if (strcmp(argument, "--frames") == 0) {
            (void)options_integer(&options, &r->frames, 1, 100000);
        } else if (strcmp(argument, "--spin") == 0) {
            v->has_spin = options_number(&options, &v->spin, -1e6, 1e6);
        } else if (strcmp(argument, "--eye") == 0) {
            v->has_eye = options_numbers(&options, v->eye, 3, -far, far);
        } else if (strcmp(argument, "--at") == 0) {
            v->has_at = options_numbers(&options, v->at, 3, -far, far);
        } else if (strcmp(argument, "--up") == 0) {
            (void)options_numbers(&options, v->up, 3, -far, far);
        } else if (strcmp(argument, "--fov") == 0) {
            (void)options_number(&options, &v->fov, 0.5, 175.0);
        } else if (strcmp(argument, "--near") == 0) {
            v->has_near = options_number(&options, &v->near, -far, far);
        } else if (strcmp(argument, "--far") == 0) {
            v->has_far = options_number(&options, &v->far, -far, far);
        } else if (strcmp(argument, "--ortho") == 0) {
            v->has_ortho = options_number(&options, &v->ortho, 1e-9, far);
        } else if (strcmp(argument, "--pitch") == 0) {
            (void)options_numbers(&options, v->pitch, 2, 0.01, 100.0);
        } else if (strcmp(argument, "--centre") == 0) {
            v->has_centre = options_numbers(&options, v->centre, 2, -16000.0, 16000.0);
        } else if (strcmp(argument, "--orbit") == 0) {
            v->has_orbit = options_numbers(&options, v->orbit, 3, -1e6, far);
        } else if (strcmp(argument, "--background") == 0) {
            (void)render_value_background(&options, v->background);
        } else if (strcmp(argument, "--out") == 0) {
            r->out = options_value(&options);
        } else if (strcmp(argument, "--show") == 0) {
            const char *value = options_value(&options);
            r->has_show = value != NULL;
            if (value && show_parse(value, &r->show, &r->error) != 0) {
                (void)command_fail("%s", r->error.text);
                options.failed = true;
            }
            r->config.method = (uint8_t)r->show.method;
        } else if (strcmp(argument, "--sheet") == 0) {
            r->sheet = options_value(&options);
        } else if (strcmp(argument, "--ids") == 0) {
            r->ids = options_value(&options);
        } else if (strcmp(argument, "--report") == 0) {
            r->report = options_value(&options);
        } else if (strcmp(argument, "--pick") == 0) {
            r->pick = options_numbers(&options, r->pick_at, 2, 0.0, 1023.0);
        } else if (strcmp(argument, "--hash") == 0) {
            r->hash = true;
        } else if (strcmp(argument, "--help") == 0) {
            print_usage(stdout);
            return -1;
        } else if (!render_display_option(&r->where, &options, argument) && !render_format_option(&r->format, &options, argument) &&
                   !render_mesh_option(&r->mesh_options, &options, argument) &&
                   !render_surface_option(&r->surface, &options, argument) && !render_world_option(&r->world, &options, argument) &&
                   !render_light_option(&r->light, &options, argument) && !render_overlay_option(&r->overlay, &options, argument) &&
                   !render_layer_option(&r->layer, &options, argument) && !render_update_option(&r->update, &options, argument) &&
                   !render_predict_option(&r->predict, &options, argument)) {
            options_unknown(&options);
        }
    }
    if (options.failed) { return EXIT_USAGE; }
    if (!r->model_path) {
        print_usage(stderr);
        return EXIT_USAGE;
    }
    if (r->has_show && render_world_has_more(&r->world)) {
        return command_fail("--show: draws one model; leave out --add and --lod"), EXIT_USAGE;
    }
    if (v->has_orbit && (v->has_eye || v->orbit[2] < 0)) {
        return command_fail("--orbit: %s",
                            v->has_eye ? "says where the eye is; leave out --eye" : "the distance must not be negative"),
               EXIT_USAGE;
    }
    if (r->has_show && !r->out) { return command_fail("--show: where to? Add --out FILE.png"), EXIT_USAGE; }
    if (!render_value_pattern("--out", r->out, r->frames) || !render_value_pattern("--ids", r->ids, r->frames)) {
        return EXIT_USAGE;
    }
    return 0;
}

/* A block that holds all faces of all clusters at once. */
static size_t one_pass_bytes(const tuile_model_t *model, const tuile_config_t *config) {
    const size_t tile_width = config->tile_width ? config->tile_width : config->width;
    const size_t tile_height = config->tile_height ? config->tile_height : 24;
    return TUILE_BLOCK_BYTES((size_t)config->height, tile_width, tile_height, config->format, 2u, 255u, config->effects, config->aa,
                             config->dither) +
           16u * (size_t)model->vertex_count + 130u * (size_t)model->material_count + TUILE_CORNERS_BYTES(model->corners_max) +
           32u * (size_t)model->face_count + 65536u;
}

/* align_y: where tiles may begin. */
static int open_renderer(tuile_t **renderer, void **block, const tuile_config_t *config, const tuile_model_t *model,
                         unsigned align_y, size_t *memory_bytes) {
    size_t wanted = 0;
    tuile_config_t c = *config;
    c.cluster_vertices = model->cluster_vertices_max;
    c.corners = model->corners_max;
    c.tree_depth = model->tree_depth;
    if (*memory_bytes == 0) {
        *memory_bytes = one_pass_bytes(model, &c);
        if (c.tile_height == 0) { c.tile_height = 16; }
    }
    *block = malloc(*memory_bytes);
    if (!*block) { return command_fail("out of memory"); }
    int result = tuile_init(renderer, &c, *block, *memory_bytes, &wanted);
    const unsigned rest = result ? 0 : tuile_config(*renderer)->tile_height % align_y;
    if (rest && tuile_config(*renderer)->tile_height < config->height) {
        c.tile_height = (uint16_t)(tuile_config(*renderer)->tile_height - rest);
        if (c.tile_height == 0) { c.tile_height = (uint16_t)align_y; }
        result = tuile_init(renderer, &c, *block, *memory_bytes, &wanted);
    }
    if (result == TUILE_ERROR_MEMORY) {
        return command_fail("--memory: %zu bytes are too few; this model wants at least %zu (smaller tiles want less, see --tile)",
                            *memory_bytes, wanted);
    }
    return result ? command_fail("%s", tuile_error_text(result)) : 0;
}

static bool has_translucent(const render_t *r) {
    bool found = render_layer_translucent(&r->model, r->surface.plain);
    for (unsigned i = 0; i < r->world.model_count; i++) {
        found = found || render_layer_translucent(&r->world.models[i].model, r->surface.plain);
    }
    return found;
}

static int set_up(render_t *r) {
    size_t size_bytes;
    mesh_report_t report;
    r->mesh_options.tree = r->config.method == TUILE_TREE;
    if (mesh_load(r->model_path, (size_t)r->max_faces, &r->mesh_options, &r->bytes, &size_bytes, &report, &r->error) != 0) {
        return command_fail("%s", r->error.text);
    }
    render_mesh_warn(&report);
    int result = tuile_model_open(&r->model, r->bytes, size_bytes);
    if (result) { return command_fail("%s: %s", r->model_path, tuile_error_text(result)); }

    if (render_world_load(&r->world, &r->model, &r->mesh_options, &r->view_options, &r->error) != 0) {
        return command_fail("%s", r->error.text);
    }
    r->sizes = r->model;
    render_world_sizes(&r->world, &r->sizes);
    r->on_display = r->where.named || !render_format_is_decoded(&r->format);
    const uint8_t wire = r->on_display && r->format.named ? (uint8_t)(r->format.format + 1) : TUILE_WIRE_DEFAULT;
    if (!r->on_display && r->where.mcu) {
        return command_fail("--mcu %s: no simulated panel takes this --format; name one that does by --panel", r->where.mcu->name);
    }
    if (render_display_open(&r->where, &r->target, wire) != 0) { return EXIT_FAILURE; }
    render_display_apply(&r->target, &r->config);
    if (r->on_display && !target_is_simulated(&r->target)) {
        if (r->out || r->sheet || r->hash) {
            return command_fail("%s: a real display cannot be looked at; leave out --out, --sheet and --hash",
                                r->target.config.text);
        }
        interrupt_catch();
    }
    if (r->on_display && render_display_check_tile(&r->target, &r->config) != 0) { return EXIT_FAILURE; }
    if (render_layer_apply(&r->layer, &r->config) != 0) { return EXIT_FAILURE; }
    if (has_translucent(r)) { r->config.effects |= TUILE_LAYERS; }
    if (render_format_apply(&r->format, r->on_display, r->where.rotation, &r->config) != 0) { return EXIT_FAILURE; }
    render_light_apply(&r->light, &r->config);
    if (render_overlay_apply(&r->overlay, &r->config) != 0) { return EXIT_FAILURE; }
    render_surface_apply(&r->surface, &r->sizes, &r->config);
    render_predict_apply(&r->predict, r->on_display ? &r->target : NULL, &r->config);
    if (open_renderer(&r->renderer, &r->block, &r->config, &r->sizes, r->on_display ? r->target.display.align_y : 1,
                      &r->memory_bytes) != 0) {
        return EXIT_FAILURE;
    }
    render_predict_start(&r->predict, r->renderer, &r->update.update.summing, &r->target);
    if (view_make(&r->view, &r->view_options, &r->model, r->config.width, r->config.height, (unsigned)r->frames, &r->error) != 0) {
        return command_fail("%s", r->error.text);
    }
    if (render_world_place(&r->world, &r->view, (unsigned)r->frames, &r->error) != 0) { return command_fail("%s", r->error.text); }
    if (render_light_place(&r->light, &r->view, &r->error) != 0) { return command_fail("%s", r->error.text); }
    if (render_update_open(&r->update, tuile_config(r->renderer), r->view.scene.instance_count) != 0) { return EXIT_FAILURE; }
    if (r->sheet) {
        r->pictures = sim_pictures_create((size_t)r->frames);
        if (!r->pictures) { return command_fail("out of memory"); }
    }
    return 0;
}

/* FNV-1a, 64 bits, over the panel's memory as it lies: rows of red, green, blue at rotation 0. */
static uint64_t panel_hash(const sim_picture_t *glass) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < (size_t)glass->width * glass->height * 3; i++) {
        hash = (hash ^ glass->rgb[i]) * 0x100000001b3u;
    }
    return hash;
}

static int write_ids(render_t *r, unsigned frame) {
    char name[4096];
    output_t out;
    void *block = NULL;
    tuile_t *renderer = NULL;
    tuile_config_t config = r->config;
    tuile_scene_t scene = r->view.scene;
    size_t memory_bytes = 0;
    const size_t width = config.width, pixels = width * config.height;

    if (!strchr(r->ids, '%') && frame > 0) { return 0; }
    render_value_frame_name(name, sizeof name, r->ids, frame);
    config.format = TUILE_FACE_IDS;
    config.aa = TUILE_AA_NONE;
    config.dither = false;
    config.overlay = NULL;
    config.trace = NULL;
    config.effects = 0;
    config.edges = TUILE_EDGES_NONE;
    scene.line_count = scene.sprite_count = 0; /* which have no number */
    uint32_t *ids = calloc(pixels, sizeof *ids);
    if (!ids) { return command_fail("out of memory"); }
    int code = open_renderer(&renderer, &block, &config, &r->sizes, 1, &memory_bytes);
    const int result = code ? 0 : ids_draw(renderer, &scene, ids);
    if (result < 0) { code = command_fail("--ids: %s", tuile_error_text(result)); }
    if (code == 0 && output_open(&out, name, &r->error) == 0) {
        for (size_t i = 0; i < pixels; i++) {
            const uint32_t id = ids[i];
            (void)fprintf(out.file, "%u%c", id ? render_world_source(&r->view.scene, id - 1) + 1 : 0, (i + 1) % width ? ' ' : '\n');
        }
        if (output_close(&out, &r->error) != 0) { code = command_fail("%s", r->error.text); }
    } else if (code == 0) {
        code = command_fail("%s", r->error.text);
    }
    free(ids);
    free(block);
    return code;
}

static int print_pick(render_t *r) {
    tuile_hit_t hit;
    tuile_config_t config = r->config;
    config.cluster_vertices = r->sizes.cluster_vertices_max;
    config.corners = r->sizes.corners_max;
    const size_t size =
        TUILE_PICK_BYTES((size_t)config.height, (size_t)config.cluster_vertices) + TUILE_CORNERS_BYTES(config.corners);
    if (r->pick_at[0] != floor(r->pick_at[0]) || r->pick_at[1] != floor(r->pick_at[1]) || r->pick_at[0] >= config.width ||
        r->pick_at[1] >= config.height) {
        return command_fail("--pick %g,%g: wants whole pixels within %ux%u", r->pick_at[0], r->pick_at[1], config.width,
                            config.height);
    }
    void *block = malloc(size);
    if (!block) { return command_fail("out of memory"); }
    const int result = tuile_pick(&r->view.scene, &config, (uint16_t)r->pick_at[0], (uint16_t)r->pick_at[1], block, size, &hit);
    free(block);
    if (result < 0) { return command_fail("--pick: %s", tuile_error_text(result)); }
    if (result == 0) {
        (void)printf("pick %g,%g: background\n", r->pick_at[0], r->pick_at[1]);
        return 0;
    }
    const tuile_model_t *model = r->view.scene.instances[hit.instance].model;
    const double step = ldexp((double)model->step.mantissa, model->step.exponent);
    double point[3];
    for (int i = 0; i < 3; i++) {
        point[i] = step * (model->offset[i] + hit.point[i] / 65536.0);
    }
    uint32_t source = hit.face;
    for (unsigned i = 0; i < hit.instance; i++) {
        source += r->view.scene.instances[i].model->face_count;
    }
    source = render_world_source(&r->view.scene, source);
    (void)printf("pick %g,%g: face %u at %.6g,%.6g,%.6g\n", r->pick_at[0], r->pick_at[1], source + 1, point[0], point[1], point[2]);
    return 0;
}

#define SHOW_ZOOM 3u

static int write_show(render_t *r, const char *name) {
    char summary[200] = "";
    sim_picture_t picture = {0};
    if (show_draw(&r->show, tuile_config(r->renderer), &r->view.scene, &r->model, SHOW_ZOOM, &picture, summary, sizeof summary,
                  &r->error) != 0 ||
        sim_picture_write(&picture, name, &r->error) != 0) {
        sim_picture_free(&picture);
        return command_fail("%s", r->error.text);
    }
    sim_picture_free(&picture);
    (void)printf("%s\n", summary);
    return 0;
}

/* The frame by way of the display: what is seen, and the panel's memory as it lies, where that is simulated. */
static int draw_displayed(render_t *r, sim_picture_t *picture, sim_picture_t *glass) {
    target_begin_frame(&r->target);
    render_predict_frame_begin(&r->predict, &r->target);
    const int result = render_update_frame(&r->update, r->renderer, &r->view.scene, &r->target.display, &r->stats);
    if (result) { return result; }
    render_predict_frame_end(&r->predict, &r->target);
    target_frame_figures(&r->target, &r->wire_bytes, &r->frame_ns);
    return target_is_simulated(&r->target) ? target_picture(&r->target, picture, glass, &r->error) != 0 : 0;
}

/* The frame in a format that the panel does not take. */
static int draw_decoded(render_t *r, sim_picture_t *picture, sim_picture_t *glass) {
    const int result = render_format_draw(r->renderer, &r->view.scene, picture, &r->stats, &r->wire_bytes, &r->error);
    return result ? result : sim_picture_turn(picture, r->where.rotation, glass, &r->error) != 0;
}

static int draw_frame(render_t *r, unsigned frame) {
    sim_picture_t picture = {0}, glass = {0};
    char name[4096], hash[24] = "";
    view_frame(&r->view, frame);
    if (render_world_frame(&r->world, &r->view, frame, &r->error) != 0 ||
        render_layer_frame(&r->layer, &r->view.scene, r->view.unit, &r->error) != 0) {
        return command_fail("%s", r->error.text);
    }
    const int result = (r->on_display ? draw_displayed : draw_decoded)(r, &picture, &glass);
    if (result > 0) { return command_fail("%s", r->error.text); }
    if (result) {
        if (result == TUILE_ERROR_MEMORY) {
            return command_fail("frame %u: --memory: %u bytes are too few for this method; %zu would do", frame,
                                r->stats.size_bytes, tuile_wanted(r->renderer));
        }
        const char *detail = r->error.text[0] ? r->error.text : target_detail(&r->target);
        return command_fail("frame %u: %s%s%s", frame, tuile_stream_error_text(result), detail[0] ? ": " : "", detail);
    }
    render_overlay_frame(&r->overlay, r->frame_ns);
    r->passes_max = r->stats.passes > r->passes_max ? r->stats.passes : r->passes_max;
    r->peak_bytes = r->stats.peak_bytes > r->peak_bytes ? r->stats.peak_bytes : r->peak_bytes;
    (void)snprintf(hash, sizeof hash, "%016llx", (unsigned long long)panel_hash(&glass));
    sim_picture_free(&glass);
    if (r->hash) { (void)printf("frame %u %s\n", frame, hash); }
    int code = 0;
    if (r->out) {
        render_value_frame_name(name, sizeof name, r->out, frame);
        if (r->has_show) {
            code = write_show(r, name);
        } else if (sim_picture_write(&picture, name, &r->error) != 0) {
            code = command_fail("%s", r->error.text);
        }
    }
    if (code == 0 && r->ids) { code = write_ids(r, frame); }
    if (code == 0 && r->report) {
        const render_report_t figures = {frame,       hash,       tuile_config(r->renderer), &r->stats, r->wire_bytes,
                                         r->frame_ns, &r->predict};
        render_report_frame(&figures, r->report_file.file);
    }
    if (r->pictures) {
        r->pictures[frame] = picture;
    } else {
        sim_picture_free(&picture);
    }
    return code;
}

static int run(render_t *r) {
    int code = set_up(r);
    if (code) { return code; }
    if (r->report) {
        if (output_open(&r->report_file, r->report, &r->error) != 0) { return command_fail("%s", r->error.text); }
        (void)fprintf(r->report_file.file, "{\"frames\": [");
    }
    for (unsigned frame = 0; code == 0 && frame < (unsigned)r->frames; frame++) {
        code = interrupt_seen() ? interrupt_code() : draw_frame(r, frame);
        if (code == 0 && r->frames > 1) { command_progress(frame + 1, (unsigned)r->frames); }
    }
    if (code == 0 && r->pick) { code = print_pick(r); }
    if (code == 0 && r->sheet) {
        const sim_sheet_config_t sheet = {.margin_px = 4, .half_size = true, .background = {32, 32, 32}};
        sim_picture_t picture = {0};
        if (sim_sheet(r->pictures, (uint32_t)r->frames, &sheet, &picture, &r->error) != 0 ||
            sim_picture_write(&picture, r->sheet, &r->error) != 0) {
            code = command_fail("%s", r->error.text);
        }
        sim_picture_free(&picture);
    }
    if (r->report) {
        if (code) {
            output_discard(&r->report_file);
        } else {
            (void)fprintf(r->report_file.file, "\n]}\n");
            if (output_close(&r->report_file, &r->error) != 0) { code = command_fail("%s", r->error.text); }
        }
    }
    if (code) { return code; }
    if (r->out || r->sheet || r->report || !(r->hash || r->pick || r->ids)) {
        char bus[64] = "";

        if (r->frame_ns) {
            (void)snprintf(bus, sizeof bus, "; %s %.1f fps",
                           r->on_display && !target_is_simulated(&r->target) ? "the last frame came at" : "the bus allows",
                           1e9 / (double)r->frame_ns);
        }
        (void)printf("%s: %u faces; memory given %u, least %u, used %u bytes, %u pass%s; %u tiles, %llu bytes on the wire%s\n",
                     r->model_path, r->stats.faces, r->stats.size_bytes, r->stats.least_bytes, r->peak_bytes, r->passes_max,
                     r->passes_max == 1 ? "" : "es", r->stats.tiles, (unsigned long long)r->wire_bytes, bus);
        render_predict_tell(&r->predict, tuile_config(r->renderer));
    }
    render_update_tell(&r->update);
    render_overlay_tell(&r->stats);
    return command_finish();
}

int command_render(int count, char **arguments) {
    render_t r;
    memset(&r, 0, sizeof r);
    int code = parse(&r, count, arguments);
    if (code < 0) {
        code = command_finish();
    } else if (code == 0) {
        code = run(&r);
        sim_pictures_free(r.pictures, (size_t)r.frames);
        target_close(&r.target);
        free(r.block);
        free(r.bytes);
        render_world_free(&r.world);
        render_layer_free(&r.layer);
        render_update_close(&r.update);
        render_light_free(&r.light);
    }
    render_overlay_free(&r.overlay);
    return code;
}
