/* Of tuile render: formats, dithering, anti-aliasing, and frames in formats that the simulated panel does not take. */
#ifndef SIM_RENDER_FORMAT_H
#define SIM_RENDER_FORMAT_H

#include "options.h"
#include "picture.h"

#include "../raster/tuile.h"

/* Zero = default. */
typedef struct render_format {
    bool named;     /* --format was given */
    uint8_t format; /* tuile_format_t */
    uint8_t aa;     /* tuile_aa_t */
    bool dither;
    uint16_t width, height; /* of the panel, at rotation 0; 0 = the simulated one's */
} render_format_t;

extern const char render_format_usage[];

/* An option of this part: takes its value. False when it is another's. */
bool render_format_option(render_format_t *part, options_t *options, const char *argument);

/* Completes a configuration that has the window and the format of the display, held at so many quarter turns, and the tiles asked
 * for; on_display: what is drawn goes to it. 0, or an exit code and a message when they do not go together. */
int render_format_apply(const render_format_t *part, bool on_display, long quarter_turns, tuile_config_t *config);

/* A format that no display was named for and that the default one does not take is decoded by sim/wire.h. */
bool render_format_is_decoded(const render_format_t *part);

/* "rgb565be", of a tuile_format_t. */
const char *render_format_name(uint8_t format);

/* Draws a frame and decodes it; wire_bytes receives the size of its tiles. 0, or a tuile_error_t; TUILE_ERROR_MEMORY also when
 * there is none for the picture, TUILE_ERROR_ARGUMENT with a line in error when a tile is not what its format says. */
int render_format_draw(tuile_t *renderer, const tuile_scene_t *scene, sim_picture_t *picture, tuile_stats_t *stats,
                       uint64_t *wire_bytes, sim_error_t *error);

/* "mono-pages, dithered, 2x2 samples", in `text`. */
void render_format_text(const tuile_config_t *config, char *text, size_t size);

#endif
