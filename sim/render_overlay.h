/* Of tuile render: what is drawn over the model. */
#ifndef SIM_RENDER_OVERLAY_H
#define SIM_RENDER_OVERLAY_H

#include "../raster/overlay/overlay.h"
#include "options.h"
#include "render_image.h"

#define RENDER_TEXTS_MAX 32
#define RENDER_GAUGES_MAX 8
#define RENDER_IMAGES_MAX 8

typedef struct render_text {
    int32_t x, y;
    char *text;
} render_text_t;

typedef struct render_placed_image {
    int32_t x, y;
    render_image_t image;
} render_placed_image_t;

/* Zero = nothing over the model. */
typedef struct render_overlay {
    const char *font_path;
    bool has_fps;
    render_text_t texts[RENDER_TEXTS_MAX];
    tuile_gauge_t gauges[RENDER_GAUGES_MAX];
    render_placed_image_t images[RENDER_IMAGES_MAX];
    unsigned text_count, gauge_count, image_count;
    uint8_t *font_bytes;
    tuile_font_t font;
    tuile_fps_t fps;
} render_overlay_t;

extern const char render_overlay_usage[];

/* An option of this part: takes its value. False when it is another's. */
bool render_overlay_option(render_overlay_t *part, options_t *options, const char *argument);

/* Loads the font and the images and sets the callback, which points to part. 0, or an exit code and a message. */
int render_overlay_apply(render_overlay_t *part, tuile_config_t *config);

/* After each frame: how long it took on the wire, 0 when that is not known. */
void render_overlay_frame(render_overlay_t *part, uint64_t frame_ns);

/* A line for people when characters had no glyphs. */
void render_overlay_tell(const tuile_stats_t *stats);

void render_overlay_free(render_overlay_t *part);

#endif
