/* Of tuile render and tuile scene: frames of which only what has changed is sent. */
#ifndef SIM_RENDER_UPDATE_H
#define SIM_RENDER_UPDATE_H

#include "../firmware/update.h"
#include "error.h"
#include "options.h"

/* Zero = default: every frame is sent whole. */
typedef struct render_update {
    long cell_width; /* 0: not asked for */
    long full_every;
    tuile_update_t update;
    tuile_changes_t changes;
    uint64_t bytes_whole, bytes_sent; /* of all frames but the first, which is always whole */
    uint64_t tiles_skipped;
    unsigned frames;
} render_update_t;

extern const char render_update_usage[];

/* An option of this part: takes its value. False when it is another's. */
bool render_update_option(render_update_t *part, options_t *options, const char *argument);

/* Makes room for the renderer's tiles and so many instances. 0, or an exit code and a message. */
int render_update_open(render_update_t *part, const tuile_config_t *config, unsigned instances);
void render_update_close(render_update_t *part);

/* Draws and sends a frame: tuile_stream_frame where nothing else was asked for. */
int render_update_frame(render_update_t *part, tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display,
                        tuile_stats_t *stats);

/* Adds the figures of a frame that another has drawn with `update`; nothing where it was not asked for. */
void render_update_count(render_update_t *part);

/* A line about all frames on stdout, if it was asked for. */
void render_update_tell(const render_update_t *part);

#endif
