#include "render_update.h"

#include "commands.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char render_update_usage[] =
    "  --update N               sends only what has changed, in cells N pixels wide (a multiple of 8), and draws only tiles that\n"
    "                           something has moved in\n"
    "  --update-full N          every N frames all of it, as against what may have gone wrong on the wire\n";

bool render_update_option(render_update_t *part, options_t *options, const char *argument) {
    if (strcmp(argument, "--update") == 0) {
        if (options_integer(options, &part->cell_width, 8, 1024) && part->cell_width % 8 != 0) {
            (void)command_fail("--update %ld: wants a multiple of 8", part->cell_width);
            options->failed = true;
        }
    } else if (strcmp(argument, "--update-full") == 0) {
        (void)options_integer(options, &part->full_every, 1, 65535);
    } else {
        return false;
    }
    return true;
}

int render_update_open(render_update_t *part, const tuile_config_t *config, unsigned instances) {
    if (!part->cell_width) { return part->full_every ? command_fail("--update-full: goes with --update") : 0; }
    const uint32_t cell = part->cell_width < config->tile_width ? (uint32_t)part->cell_width : config->tile_width;
    const uint32_t count = TUILE_UPDATE_CELLS((uint32_t)config->width, (uint32_t)config->height, (uint32_t)config->tile_width,
                                              (uint32_t)config->tile_height, cell);
    part->update = (tuile_update_t){.sums = calloc(count, sizeof *part->update.sums),
                                    .sum_count = count,
                                    .cell_width = (uint16_t)part->cell_width,
                                    .full_every = (uint16_t)part->full_every,
                                    .changes = &part->changes};
    part->changes =
        (tuile_changes_t){.instances = calloc(instances, sizeof *part->changes.instances), .capacity = (uint16_t)instances};
    return part->update.sums && part->changes.instances ? 0 : command_fail("out of memory");
}

void render_update_close(render_update_t *part) {
    free(part->update.sums);
    free(part->changes.instances);
    part->update.sums = NULL;
    part->changes.instances = NULL;
}

void render_update_count(render_update_t *part) {
    if (!part->cell_width || part->frames++ == 0) { return; }
    part->bytes_whole += part->update.bytes_whole;
    part->bytes_sent += part->update.bytes_sent;
    part->tiles_skipped += part->update.tiles_skipped;
}

int render_update_frame(render_update_t *part, tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display,
                        tuile_stats_t *stats) {
    if (!part->cell_width) { return tuile_stream_frame(renderer, scene, display, stats); }
    const int result = tuile_update_frame(&part->update, renderer, scene, display, stats);
    render_update_count(part);
    return result;
}

void render_update_tell(const render_update_t *part) {
    if (!part->cell_width || part->frames < 2) { return; }
    (void)printf("update: after the first frame %llu of %llu bytes of pixels were sent (1/%.2f), %llu tiles not even drawn\n",
                 (unsigned long long)part->bytes_sent, (unsigned long long)part->bytes_whole,
                 part->bytes_sent ? (double)part->bytes_whole / (double)part->bytes_sent : 0.0,
                 (unsigned long long)part->tiles_skipped);
}
