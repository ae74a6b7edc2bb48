/* tuile scene: the scenes that boards draw, on a simulated panel: what a board's frames are held against. */
#include "../firmware/caption.h"
#include "../firmware/player.h"
#include "commands.h"
#include "font.h"
#include "mesh/mesh.h"
#include "render_display.h"
#include "render_format.h"
#include "render_predict.h"
#include "render_update.h"
#include "render_value.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "Usage: tuile scene [NAME] [options]\n"
    "\n"
    "Draws a scene of the list that boards draw (firmware/scenes.c); without a name it lists them.\n"
    "\n"
    "  --models FOLDER          where the compiled models are, build/firmware/models by default (`make firmware-models`)\n"
    "  --model FILE             another model in the place of the scene's own: a .tuile file or anything Assimp reads\n"
    "  --method M               hidden-surface method: zbuffer (default), scanline, warnock, painter, tree\n"
    "  --frames N               number of frames, 1 by default\n"
    "  --first N                number of the first one, 0 by default\n"
    "  --phase N                one frame between those: of 65536 until the scene comes round\n"
    "  --show-rate R            writes it over the frame as the demo of a board does: frames a second, or 0 for not known\n"
    "  --show-method            likewise the method\n"
    "  --memory 16K             the renderer's memory, 256K by default\n"
    "  --tile WxH               tile size in pixels; by default whole rows, as many as suit the memory\n"
    "  --format F               format on the wire, of those that the display takes\n"
    "  --out frame-%02d.png     pictures of the panel; PPM when the name ends so\n"
    "  --hash                   prints a hash of the panel's picture for each frame\n";

typedef struct scene_command {
    const char *name, *models, *model, *out;
    long frames, first, phase; /* phase -1: that of the frame */
    size_t memory_bytes;
    uint16_t tile_width, tile_height;
    bool hash;
    uint8_t method;
    render_display_t where;
    render_format_t format;
    render_update_t update;
    uint64_t wire_bytes; /* of all frames but the first */
    render_predict_t predict;

    const scene_script_t *script;
    uint8_t *bytes, *font;
    void *block;
    caption_t caption;
    target_t target;
    player_t player;
} scene_command_t;

/* "12.3", in tenths. */
static void parse_rate(caption_t *caption, options_t *options) {
    double rate;
    if (!options_number(options, &rate, 0, CAPTION_RATE_MOST / 10.0)) { return; }
    caption->rate = (uint16_t)lround(10 * rate);
    caption->show_rate = true;
}

static int parse(scene_command_t *c, int count, char **arguments) {
    options_t options;
    const char *argument;
    int choice;
    c->frames = 1;
    c->phase = -1;
    c->memory_bytes = 256u * 1024u;
    options_open(&options, count, arguments);
    while ((argument = options_next(&options)) != NULL) {
        if (!options.name) {
            if (c->name) { return command_fail("scene: one at a time, but got %s and %s", c->name, argument), EXIT_USAGE; }
            c->name = argument;
        } else if (strcmp(argument, "--models") == 0) {
            c->models = options_value(&options);
        } else if (strcmp(argument, "--model") == 0) {
            c->model = options_value(&options);
        } else if (strcmp(argument, "--method") == 0) {
            if (options_choice(&options, &choice, options_methods)) { c->method = (uint8_t)choice; }
        } else if (strcmp(argument, "--frames") == 0) {
            (void)options_integer(&options, &c->frames, 1, 100000);
        } else if (strcmp(argument, "--first") == 0) {
            (void)options_integer(&options, &c->first, 0, 100000);
        } else if (strcmp(argument, "--phase") == 0) {
            (void)options_integer(&options, &c->phase, 0, 65535);
        } else if (strcmp(argument, "--show-rate") == 0) {
            parse_rate(&c->caption, &options);
        } else if (strcmp(argument, "--show-method") == 0) {
            c->caption.show_method = true;
        } else if (strcmp(argument, "--memory") == 0) {
            (void)options_size(&options, &c->memory_bytes);
        } else if (strcmp(argument, "--tile") == 0) {
            (void)options_tile(&options, &c->tile_width, &c->tile_height);
        } else if (strcmp(argument, "--out") == 0) {
            c->out = options_value(&options);
        } else if (strcmp(argument, "--hash") == 0) {
            c->hash = true;
        } else if (strcmp(argument, "--help") == 0) {
            (void)fputs(usage, stdout);
            (void)fputs(render_update_usage, stdout);
            (void)fputs(render_display_usage, stdout);
            (void)fputs(render_predict_usage, stdout);
            return -1;
        } else if (!render_display_option(&c->where, &options, argument) && !render_update_option(&c->update, &options, argument) &&
                   !render_predict_option(&c->predict, &options, argument) &&
                   (strcmp(argument, "--format") != 0 || !render_format_option(&c->format, &options, argument))) {
            options_unknown(&options);
        }
    }
    if (options.failed) { return EXIT_USAGE; }
    if (c->phase >= 0 && c->frames > 1) { return command_fail("--phase: is one frame, not %ld", c->frames), EXIT_USAGE; }
    return render_value_pattern("--out", c->out, c->frames) ? 0 : EXIT_USAGE;
}

static int list(void) {
    for (unsigned i = 0; i < scene_count; i++) {
        const char *separator = "";
        (void)printf("%-8s %s; ", scenes[i]->name, scenes[i]->about);
        for (unsigned m = 0; options_methods[m]; m++) {
            if (!(scenes[i]->methods >> m & 1u)) { continue; }
            (void)printf("%s%s", separator, options_methods[m]);
            separator = ", ";
        }
        (void)printf("\n");
    }
    return command_finish();
}

static int load(scene_command_t *c, player_config_t *config) {
    const bool any = strcmp(c->script->model, "model") == 0; /* that one has a tree only when it is drawn by it */
    const mesh_options_t options = {.tree = any ? c->method == TUILE_TREE : (c->script->methods >> TUILE_TREE & 1u) != 0};
    char path[4096];
    mesh_report_t report;
    sim_error_t error = {""};
    if (any && !c->model && !c->models) { return command_fail("scene %s: --model FILE tells which", c->name); }
    (void)snprintf(path, sizeof path, "%s/%s.tuile", c->models ? c->models : "build/firmware/models", c->script->model);
    if (mesh_load(c->model ? c->model : path, 0, &options, &c->bytes, &config->model_bytes, &report, &error) != 0) {
        return command_fail("%s%s", error.text, c->model ? "" : " (`make firmware-models` compiles the models of the scenes)");
    }
    config->model = c->bytes;
    return 0;
}

/* What goes over the frames, if it was asked for. */
static int open_caption(scene_command_t *c, player_config_t *config) {
    size_t size_bytes;
    sim_error_t error = {""};
    if (!c->caption.show_rate && !c->caption.show_method) { return 0; }
    if (font_load(NULL, &c->font, &size_bytes, &error) != 0) { return command_fail("%s", error.text); }
    if (tuile_font_open(&c->caption.font, c->font, size_bytes) != TUILE_OK) { return command_fail("the font is damaged"); }
    c->caption.method = c->method;
    config->overlay = caption_draw;
    config->overlay_context = &c->caption;
    return 0;
}

/* The same renderer once more, with what a prediction wants of it: boards' players know nothing of that. */
static int predict(scene_command_t *c) {
    tuile_config_t config = *tuile_config(c->player.renderer);
    render_predict_apply(&c->predict, &c->target, &config);
    const int result = tuile_init(&c->player.renderer, &config, c->block, c->memory_bytes, NULL);
    if (result) { return command_fail("scene %s: %s", c->name, tuile_error_text(result)); }
    render_predict_start(&c->predict, c->player.renderer, &c->update.update.summing, &c->target);
    return 0;
}

static int set_up(scene_command_t *c) {
    const uint8_t wire = c->format.named ? (uint8_t)(c->format.format + 1) : TUILE_WIRE_DEFAULT;
    player_config_t config = {
        .display = &c->target.display,
        .block_bytes = c->memory_bytes,
        .method = c->method,
        .tile_width = c->tile_width,
        .tile_height = c->tile_height,
        .update = c->update.cell_width ? &c->update.update : NULL,
    };
    c->script = scene_find(c->name);
    if (!c->script) { return command_fail("scene %s: there is none; `tuile scene` lists them", c->name); }
    if (!(c->script->methods >> c->method & 1u)) {
        return command_fail("--method %s: not for the scene %s; `tuile scene` lists which are", options_methods[c->method],
                            c->name);
    }
    if (load(c, &config) != 0 || open_caption(c, &config) != 0 || render_display_open(&c->where, &c->target, wire) != 0) {
        return EXIT_FAILURE;
    }
    if (!target_is_simulated(&c->target) && (c->out || c->hash)) {
        return command_fail("%s: a real display cannot be looked at; leave out --out and --hash", c->target.config.text);
    }
    c->block = config.block = malloc(c->memory_bytes);
    if (!c->block) { return command_fail("out of memory"); }
    const int result = player_open(&c->player, c->script, &config);
    if (result == TUILE_ERROR_MEMORY) {
        return command_fail("--memory: %zu bytes are too few; at least %zu are wanted", c->memory_bytes, c->player.wanted_bytes);
    }
    if (result) { return command_fail("scene %s: %s", c->name, tuile_stream_error_text(result)); }
    const int code = predict(c);
    return code ? code : render_update_open(&c->update, tuile_config(c->player.renderer), 1);
}

/* FNV-1a, 64 bits, over rows of red, green, blue. */
static uint64_t picture_hash(const sim_picture_t *picture) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < (size_t)picture->width * picture->height * 3; i++) {
        hash = (hash ^ picture->rgb[i]) * 0x100000001b3u;
    }
    return hash;
}

static int draw(scene_command_t *c, unsigned number) {
    sim_picture_t seen = {0}, glass = {0};
    sim_error_t error = {""};
    char name[4096];
    uint64_t bytes, frame_ns;
    target_begin_frame(&c->target);
    render_predict_frame_begin(&c->predict, &c->target);
    int result = c->phase < 0 ? scene_frame(&c->player.stage, number) : scene_phase(&c->player.stage, (bam16_t)c->phase);
    if (!result) { result = player_show(&c->player); }
    render_predict_frame_end(&c->predict, &c->target);
    if (result == TUILE_ERROR_MEMORY) {
        return command_fail("frame %u: --memory: %zu bytes are too few for this method; %zu would do", number, c->memory_bytes,
                            c->player.wanted_bytes);
    }
    if (result) {
        return command_fail("frame %u: %s%s%s", number, tuile_stream_error_text(result), target_detail(&c->target)[0] ? ": " : "",
                            target_detail(&c->target));
    }
    render_update_count(&c->update);
    target_frame_figures(&c->target, &bytes, &frame_ns);
    if (number != (unsigned)c->first) { c->wire_bytes += bytes; }
    if (!target_is_simulated(&c->target)) { return 0; }
    int code = target_picture(&c->target, &seen, &glass, &error) ? command_fail("%s", error.text) : 0;
    if (code == 0 && c->hash) { (void)printf("frame %u %016llx\n", number, (unsigned long long)picture_hash(&glass)); }
    if (code == 0 && c->out) {
        render_value_frame_name(name, sizeof name, c->out, number);
        if (sim_picture_write(&seen, name, &error) != 0) { code = command_fail("%s", error.text); }
    }
    sim_picture_free(&seen);
    sim_picture_free(&glass);
    return code;
}

static int run(scene_command_t *c) {
    int code = set_up(c);
    for (long i = 0; code == 0 && i < c->frames; i++) {
        code = draw(c, (unsigned)(c->first + i));
    }
    if (code) { return code; }
    if (!c->hash) {
        const tuile_stats_t *s = &c->player.stats;
        (void)printf("%s: %u faces; memory given %u, least %u, used %u bytes, %u pass%s; %u tiles\n", c->name, s->faces,
                     s->size_bytes, s->least_bytes, s->peak_bytes, s->passes, s->passes == 1 ? "" : "es", s->tiles);
        render_update_tell(&c->update);
        if (c->frames > 1 && c->wire_bytes) {
            (void)printf("wire: after the first frame %llu bytes, commands and all\n", (unsigned long long)c->wire_bytes);
        }
        render_predict_tell(&c->predict, tuile_config(c->player.renderer));
    }
    return command_finish();
}

int command_scene(int count, char **arguments) {
    scene_command_t c;
    memset(&c, 0, sizeof c);
    int code = parse(&c, count, arguments);
    if (code < 0) { return command_finish(); }
    if (code > 0) { return code; }
    if (!c.name) { return list(); }
    code = run(&c);
    target_close(&c.target);
    render_update_close(&c.update);
    free(c.block);
    free(c.font);
    free(c.bytes);
    return code;
}
