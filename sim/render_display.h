/* Of the commands that show something: the display it is shown on, or the panel that is simulated. */
#ifndef SIM_RENDER_DISPLAY_H
#define SIM_RENDER_DISPLAY_H

#include "options.h"
#include "target.h"

#include "../raster/tuile.h"

/* Zero = default: the simulated ILI9341. */
typedef struct render_display {
    bool named; /* --display or --panel was given */
    uint8_t rotation;
    size_t clock_hz;      /* 0 = what the text says, or the panel's usual one */
    const sim_mcu_t *mcu; /* NULL = what the text says */
    target_config_t config;
} render_display_t;

extern const char render_display_usage[];

/* An option of this part: takes its value. False when it is another's. */
bool render_display_option(render_display_t *part, options_t *options, const char *argument);

/* Opens the display; wire: tuile_wire_t, DEFAULT for its own. 0, or an exit code and a message. */
int render_display_open(const render_display_t *part, target_t *target, uint8_t wire);

/* Says on stderr that a clock was asked for which the data sheet does not promise. */
void render_display_warn(const render_display_t *part, const target_t *target);

/* Completes a configuration for the display: its window and format. */
void render_display_apply(const target_t *target, tuile_config_t *config);

/* Tiles that were asked for must begin and end where the display's bytes do. 0, or an exit code and a message. */
int render_display_check_tile(const target_t *target, const tuile_config_t *config);

#endif
