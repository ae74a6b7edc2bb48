/* Of tuile render: the figures of a frame as JSON, for --report. */
#ifndef SIM_RENDER_REPORT_H
#define SIM_RENDER_REPORT_H

#include <stdio.h>

#include "../raster/tuile.h"
#include "render_predict.h"

typedef struct render_report {
    unsigned frame;
    const char *hash;
    const tuile_config_t *config;
    const tuile_stats_t *stats;
    uint64_t wire_bytes, wire_ns;
    const render_predict_t *predict;
} render_report_t;

/* One object of the list of frames, with a comma before it but for frame 0. */
void render_report_frame(const render_report_t *report, FILE *file);

#endif
