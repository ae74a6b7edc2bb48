#include "render_format.h"

#include "commands.h"
#include "wire.h"

#include <stdio.h>
#include <string.h>

const char render_format_usage[] =
    "  --format F               rgb565be, rgb565le, rgb444, rgb666, rgb332, rgb111, xrgb1111, bgr888, xrgb8888, grey8, grey4,\n"
    "                           mono-pages, mono-rows, mono-pages-turned, grey4-turned: one that the display takes, by default\n"
    "                           its first; without --panel and --display those that the ILI9341 does not take are decoded\n"
    "                           without a panel\n"
    "  --dither                 ordered dithering; mono is always dithered\n"
    "  --aa none|2x2|4x4        samples of each pixel\n"
    "  --size WxH               size at --rotate 0 where no panel takes part; 240x320 by default\n";

static const char *const names[] = {
    "rgb565be",  "rgb565le",          "rgb444",       "rgb666", "rgb332",   "grey8",  "grey4",    "mono-pages",
    "mono-rows", "mono-pages-turned", "grey4-turned", "rgb111", "xrgb1111", "bgr888", "xrgb8888", NULL};
static const uint8_t formats[] = {TUILE_RGB565_BE,    TUILE_RGB565_LE, TUILE_RGB444,     TUILE_RGB666,    TUILE_RGB332,
                                  TUILE_GREY8,        TUILE_GREY4,     TUILE_MONO_PAGES, TUILE_MONO_ROWS, TUILE_MONO_PAGES_TURNED,
                                  TUILE_GREY4_TURNED, TUILE_RGB111,    TUILE_XRGB1111,   TUILE_BGR888,    TUILE_XRGB8888};
_Static_assert(sizeof formats / sizeof *formats == sizeof names / sizeof *names - 1, "a name for each format");
static const char *const samples[] = {"none", "2x2", "4x4", NULL};

const char *render_format_name(uint8_t format) {
    unsigned i = 0;
    while (names[i + 1] && formats[i] != format) {
        i++;
    }
    return names[i];
}

bool render_format_option(render_format_t *part, options_t *options, const char *argument) {
    int choice;
    if (strcmp(argument, "--format") == 0) {
        if (options_choice(options, &choice, names)) { part->format = formats[choice]; }
        part->named = true;
    } else if (strcmp(argument, "--dither") == 0) {
        part->dither = true;
    } else if (strcmp(argument, "--aa") == 0) {
        if (options_choice(options, &choice, samples)) { part->aa = (uint8_t)choice; }
    } else if (strcmp(argument, "--size") == 0) {
        (void)options_tile(options, &part->width, &part->height);
    } else {
        return false;
    }
    return true;
}

bool render_format_is_decoded(const render_format_t *part) { return part->format != TUILE_RGB565_BE; }

/* What a tile's size must be a multiple of, so that no byte belongs to two tiles. */
static int check_tile(const tuile_config_t *c) {
    unsigned columns, rows;
    wire_unit(c->format, &columns, &rows);
    if (c->tile_width < c->width && c->tile_width % columns != 0) {
        return command_fail("--tile %ux%u: the width of a tile of %s is a multiple of %u, or the window's", c->tile_width,
                            c->tile_height, render_format_name(c->format), columns);
    }
    if (c->tile_height < c->height && c->tile_height % rows != 0) {
        return command_fail("--tile %ux%u: the height of a tile of %s is a multiple of %u, or the window's", c->tile_width,
                            c->tile_height, render_format_name(c->format), rows);
    }
    return 0;
}

int render_format_apply(const render_format_t *part, bool on_display, long quarter_turns, tuile_config_t *config) {
    if (part->width && on_display) {
        return command_fail("--size: %s goes to a display, which has a size of its own; name another --format and no display",
                            render_format_name(config->format));
    }
    if (part->width) {
        const bool turned = quarter_turns % 2 != 0;
        config->width = turned ? part->height : part->width;
        config->height = turned ? part->width : part->height;
    }
    if (!on_display) { config->format = part->format; }
    config->dither = part->dither;
    config->aa = part->aa;
    if (config->width << part->aa > TUILE_SAMPLES_MAX || config->height << part->aa > TUILE_SAMPLES_MAX) {
        return command_fail("--aa %s: a window of at most %u pixels each way, but it is %ux%u", samples[part->aa],
                            TUILE_SAMPLES_MAX >> part->aa, config->width, config->height);
    }
    return check_tile(config);
}

int render_format_draw(tuile_t *renderer, const tuile_scene_t *scene, sim_picture_t *picture, tuile_stats_t *stats,
                       uint64_t *wire_bytes, sim_error_t *error) {
    const tuile_config_t *config = tuile_config(renderer);
    tuile_tile_t tile;
    *wire_bytes = 0;
    if (sim_picture_create(picture, config->width, config->height, error) != 0) { return TUILE_ERROR_MEMORY; }
    int result = tuile_begin(renderer, scene);
    if (result) { return result; }
    while ((result = tuile_next(renderer, &tile)) == 1) {
        *wire_bytes += tile.size_bytes;
        if (wire_paste(picture, config->format, &tile, error) != 0) {
            result = TUILE_ERROR_ARGUMENT;
            break;
        }
    }
    (void)tuile_end(renderer, stats);
    return result;
}

void render_format_text(const tuile_config_t *config, char *text, size_t size) {
    (void)snprintf(text, size, "%s%s%s%s%s", render_format_name(config->format), config->dither ? ", dithered" : "",
                   config->aa ? ", " : "", config->aa ? samples[config->aa] : "", config->aa ? " samples" : "");
}
