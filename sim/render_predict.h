/* Of the commands that draw on a simulated panel: how fast a microcontroller would be (sim/predict.h). */
#ifndef SIM_RENDER_PREDICT_H
#define SIM_RENDER_PREDICT_H

#include <stdio.h>

#include "options.h"
#include "predict.h"
#include "target.h"

/* Zero = default: no prediction. Must not be moved once it is open. */
typedef struct render_predict {
    long buffers; /* of tiles; 0: as the renderer has it */
    predict_t predict;
} render_predict_t;

extern const char render_predict_usage[];

/* An option of this part: takes its value. False when it is another's. */
bool render_predict_option(render_predict_t *part, options_t *options, const char *argument);

/* Completes a configuration: tiles in flight, and what counts the renderer's work where the display is a simulated one with a
 * microcontroller. target: NULL where frames go to none. */
void render_predict_apply(render_predict_t *part, const target_t *target, tuile_config_t *config);

/* When there is a renderer for that configuration; summing: of an update, NULL where there is none. */
void render_predict_start(render_predict_t *part, const tuile_t *renderer, const bool *summing, target_t *target);

/* Around each frame, behind target_begin_frame. */
void render_predict_frame_begin(render_predict_t *part, const target_t *target);
void render_predict_frame_end(render_predict_t *part, const target_t *target);

/* Fields of the last frame, each with a comma before it, for --report. */
void render_predict_report(const render_predict_t *part, const tuile_config_t *config, FILE *file);

/* A line about all frames on stdout, where there is a microcontroller. */
void render_predict_tell(const render_predict_t *part, const tuile_config_t *config);

#endif
