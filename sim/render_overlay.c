#include "render_overlay.h"

#include "commands.h"
#include "font.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PLACE_MOST 32767 /* pixels */

const char render_overlay_usage[] =
    "  --overlay-text X,Y,TEXT  text over the model, its top left corner at a pixel; \\n begins a new line; may be repeated\n"
    "  --overlay-fps            frames a second, as far as the bus allows, in the top right corner\n"
    "  --gauge X,Y,R,VALUE      a dial of radius R round a pixel, VALUE from 0 to 100; may be repeated\n"
    "  --overlay-image FILE@X,Y a PNG or JPEG image over the model, with its alpha; may be repeated\n"
    "  --font FILE              their font, .bdf or .tuilefont; by default one of 6x10 dots\n";

static bool refuse(options_t *options, const char *value, const char *wants) {
    (void)command_fail("%s %.200s: wants %s", options->name, value, wants);
    options->failed = true;
    return false;
}

/* `count` whole numbers with commas between, and a comma behind them unless the text ends there; where it goes on. NULL: wrong. */
static const char *parse_numbers(const char *text, int32_t *values, unsigned count) {
    for (unsigned i = 0; i < count; i++) {
        char *end;
        errno = 0;
        const long value = strtol(text, &end, 10);
        if (end == text || errno || value < -PLACE_MOST || value > PLACE_MOST || (*end != ',' && *end != '\0')) { return NULL; }
        if (*end == '\0' && i + 1 < count) { return NULL; }
        values[i] = (int32_t)value;
        text = *end == ',' ? end + 1 : end;
    }
    return text;
}

static bool full(options_t *options, unsigned count, unsigned most) {
    if (count < most) { return false; }
    (void)command_fail("%s: at most %u of them", options->name, most);
    options->failed = true;
    return true;
}

static bool add_text(render_overlay_t *part, options_t *options, const char *value) {
    int32_t at[2];
    if (full(options, part->text_count, RENDER_TEXTS_MAX)) { return false; }
    const char *text = parse_numbers(value, at, 2);
    if (!text || text[-1] != ',' || *text == '\0') { return refuse(options, value, "X,Y,TEXT, like 8,8,Hello"); }
    char *own = strdup(text), *to = own;
    if (!own) { return refuse(options, value, "more memory"); }
    for (const char *from = own; *from; from++) {
        const bool is_newline = from[0] == '\\' && from[1] == 'n';
        *to++ = is_newline ? '\n' : *from;
        from += is_newline;
    }
    *to = '\0';
    part->texts[part->text_count++] = (render_text_t){at[0], at[1], own};
    return true;
}

static bool add_gauge(render_overlay_t *part, options_t *options, const char *value) {
    int32_t v[4];
    if (full(options, part->gauge_count, RENDER_GAUGES_MAX)) { return false; }
    const char *rest = parse_numbers(value, v, 4);
    if (!rest || *rest != '\0' || rest[-1] == ',') {
        return refuse(options, value, "X,Y,R,VALUE in whole numbers, like 60,60,50,75");
    }
    if (v[2] < 4 || v[2] > 1024) { return refuse(options, value, "a radius of 4 to 1024"); }
    part->gauges[part->gauge_count++] = (tuile_gauge_t){.x = v[0],
                                                        .y = v[1],
                                                        .radius = v[2],
                                                        .value = v[3],
                                                        .high = 100,
                                                        .face = TUILE_ARGB(160, 8, 12, 20),
                                                        .track = TUILE_COLOUR(96, 104, 120),
                                                        .fill = TUILE_COLOUR(80, 200, 120),
                                                        .needle = TUILE_COLOUR(255, 255, 255)};
    return true;
}

static bool add_image(render_overlay_t *part, options_t *options, const char *value) {
    int32_t at[2] = {0, 0};
    if (full(options, part->image_count, RENDER_IMAGES_MAX)) { return false; }
    render_placed_image_t *placed = &part->images[part->image_count];
    const char *numbers = render_image_name(&placed->image, value), *rest = numbers ? parse_numbers(numbers, at, 2) : NULL;
    if (!rest || *rest != '\0' || rest[-1] == ',') { return refuse(options, value, "FILE@X,Y, like logo.png@8,8"); }
    placed->x = at[0];
    placed->y = at[1];
    part->image_count++;
    return true;
}

bool render_overlay_option(render_overlay_t *part, options_t *options, const char *argument) {
    static const struct {
        const char *name;
        bool (*add)(render_overlay_t *part, options_t *options, const char *value);
    } lists[] = {{"--overlay-text", add_text}, {"--gauge", add_gauge}, {"--overlay-image", add_image}};
    for (unsigned i = 0; i < sizeof lists / sizeof *lists; i++) {
        if (strcmp(argument, lists[i].name) != 0) { continue; }
        const char *value = options_value(options);
        if (value) { (void)lists[i].add(part, options, value); }
        return true;
    }
    if (strcmp(argument, "--overlay-fps") == 0) {
        part->has_fps = true;
    } else if (strcmp(argument, "--font") == 0) {
        part->font_path = options_value(options);
    } else {
        return false;
    }
    return true;
}

/* ---- drawing ---- */

static void draw_fps(const render_overlay_t *part, tuile_canvas_t *canvas) {
    const int32_t width = tuile_text_width(&part->font, "0000.0 fps") + 4, height = part->font.height + 3;
    tuile_draw_rectangle(canvas, canvas->width - width, 0, width, height, TUILE_ARGB(128, 0, 0, 0));
    tuile_text_fps(canvas, &part->font, canvas->width - width + 2, 2, TUILE_COLOUR(255, 220, 80), &part->fps);
}

static void draw(void *context, tuile_canvas_t *canvas) {
    const render_overlay_t *part = context;
    for (unsigned i = 0; i < part->image_count; i++) {
        const render_placed_image_t *placed = &part->images[i];
        (void)tuile_draw_image(canvas, &placed->image.texture, placed->x, placed->y, 1, 255);
    }
    for (unsigned i = 0; i < part->gauge_count; i++) {
        (void)tuile_draw_gauge(canvas, &part->gauges[i]);
    }
    for (unsigned i = 0; i < part->text_count; i++) {
        tuile_text(canvas, &part->font, part->texts[i].x, part->texts[i].y, part->texts[i].text, TUILE_COLOUR(255, 255, 255));
    }
    if (part->has_fps) { draw_fps(part, canvas); }
}

/* ---- loading ---- */

static int load_font(render_overlay_t *part) {
    sim_error_t error = {""};
    size_t size_bytes;
    if (font_load(part->font_path, &part->font_bytes, &size_bytes, &error) != 0) { return command_fail("--font: %s", error.text); }
    const int result = tuile_font_open(&part->font, part->font_bytes, size_bytes);
    return result ? command_fail("--font: %s", tuile_error_text(result)) : 0;
}

int render_overlay_apply(render_overlay_t *part, tuile_config_t *config) {
    const bool has_any = part->text_count || part->gauge_count || part->image_count || part->has_fps;
    if (!has_any && !part->font_path) { return 0; }
    int code = load_font(part);
    for (unsigned i = 0; code == 0 && i < part->image_count; i++) {
        code = render_image_load(&part->images[i].image, "--overlay-image");
    }
    if (code) { return code; }
    for (unsigned i = 0; i < part->gauge_count; i++) {
        part->gauges[i].font = &part->font;
    }
    if (has_any) {
        config->overlay = draw;
        config->overlay_context = part;
    }
    return 0;
}

void render_overlay_frame(render_overlay_t *part, uint64_t frame_ns) {
    if (frame_ns) { tuile_fps_frame(&part->fps, (uint32_t)(frame_ns / 1000 > UINT32_MAX ? UINT32_MAX : frame_ns / 1000)); }
}

void render_overlay_tell(const tuile_stats_t *stats) {
    if (stats->glyphs_missing) {
        (void)printf("characters that the font has no glyph for, drawn as boxes: %u\n", stats->glyphs_missing);
    }
}

void render_overlay_free(render_overlay_t *part) {
    for (unsigned i = 0; i < part->text_count; i++) {
        free(part->texts[i].text);
    }
    for (unsigned i = 0; i < part->image_count; i++) {
        render_image_free(&part->images[i].image);
    }
    free(part->font_bytes);
    memset(part, 0, sizeof *part);
}
