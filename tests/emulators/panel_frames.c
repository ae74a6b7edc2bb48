/* Holds the frames of a board's panel against the simulator's, bit for bit.
 *
 * Usage: panel_frames TRACE PANEL MODELS COUNT [PICTURES]
 *
 * TRACE is what an emulator wrote (trace.h) while the board ran firmware/frames.c. A chip of PANEL takes the bytes of the trace,
 * and at each line "frame SCENE METHOD NUMBER ..." it must have been reset, and its glass must be lit and equal that of the
 * simulator, which draws the same frame for the same panel in a block of its own size. A line "demo SCENE METHOD PHASE RATE"
 * (firmware/demo/demo.c) is held likewise, with its text over the frame. MODELS is the folder of the compiled models.
 * Just COUNT frames ("any": how ever many) must come, and no error. PICTURES, the beginning of names, receives the glass as
 * PICTURES-SCENE-METHOD-NUMBER.png.
 *
 * The board's lines go to stdout, those of frames with " wire N" behind them, the bytes since the frame before, commands and all;
 * then one line about all frames. An error ends it with one line on stderr and the code 1. */
#include "trace.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../firmware/caption.h"
#include "../../firmware/player.h"
#include "../../sim/bus.h"
#include "../../sim/font.h"
#include "../../sim/options.h"
#include "../../sim/panels.h"

#define BLOCK_BYTES (512u * 1024u)

/* The simulator, with what it draws last. */
typedef struct drawn {
    sim_chip_t *chip;
    sim_bus_t bus;
    tuile_display_t display;
    player_t player;
    caption_t caption; /* shows nothing over frames of frames.c */
    uint8_t *font;
    const scene_script_t *script; /* NULL: nothing yet */
    uint8_t method;
    uint8_t *model;
    size_t model_bytes;
    uint64_t *block;
} drawn_t;

typedef struct frames {
    const char *models, *pictures;
    sim_chip_t *chip; /* the board's */
    drawn_t drawn;
    uint8_t light;
    bool reset; /* its line has been low */
    unsigned count;
    uint64_t wire_bytes; /* since the last frame */
} frames_t;

static int read_model(drawn_t *drawn, const char *folder, sim_error_t *error) {
    char path[4096];
    FILE *file;
    long size;

    free(drawn->model);
    drawn->model = NULL;
    (void)snprintf(path, sizeof path, "%s/%s.tuile", folder, drawn->script->model);
    file = fopen(path, "rb");
    if (!file) { return sim_fail(error, "%s cannot be read", path); }
    (void)fseek(file, 0, SEEK_END);
    size = ftell(file);
    rewind(file);
    drawn->model = size > 0 ? malloc((size_t)size) : NULL;
    drawn->model_bytes = drawn->model ? fread(drawn->model, 1, (size_t)size, file) : 0;
    (void)fclose(file);
    return size > 0 && drawn->model_bytes == (size_t)size ? 0 : sim_fail(error, "%s cannot be read", path);
}

static int choose(drawn_t *drawn, const char *folder, const scene_script_t *script, uint8_t method, sim_error_t *error) {
    player_config_t config = {
        .display = &drawn->display,
        .block = drawn->block,
        .block_bytes = BLOCK_BYTES,
        .method = method,
        .overlay = caption_draw,
        .overlay_context = &drawn->caption,
    };
    int result;

    if (drawn->script == script && drawn->method == method) { return 0; }
    drawn->script = script;
    drawn->method = method;
    if (read_model(drawn, folder, error)) { return -1; }
    config.model = drawn->model;
    config.model_bytes = drawn->model_bytes;
    result = player_open(&drawn->player, script, &config);
    return result ? sim_fail(error, "simulator: %s", tuile_stream_error_text(result)) : 0;
}

static int open_drawn(drawn_t *drawn, const sim_panel_t *panel, sim_error_t *error) {
    size_t font_bytes;
    int result;

    drawn->block = malloc(BLOCK_BYTES);
    drawn->chip = panel->create(error);
    if (!drawn->block || !drawn->chip) { return sim_fail(error, "out of memory"); }
    if (font_load(NULL, &drawn->font, &font_bytes, error)) { return -1; }
    if (tuile_font_open(&drawn->caption.font, drawn->font, font_bytes)) { return sim_fail(error, "the font is damaged"); }
    sim_bus_open(&drawn->bus, NULL, drawn->chip);
    result = tuile_display_init(&drawn->display, &(tuile_display_config_t){.bus = &drawn->bus.bus, .panel = panel->panel});
    return result ? sim_fail(error, "simulator: %s", tuile_stream_error_text(result)) : 0;
}

static int find_method(const char *name) {
    for (int i = 0; options_methods[i]; i++) {
        if (strcmp(options_methods[i], name) == 0) { return i; }
    }
    return -1;
}

static int same(const sim_picture_t *board, const sim_picture_t *simulator, const char *line, sim_error_t *error) {
    uint32_t differ = 0, first = 0;

    if (board->width != simulator->width || board->height != simulator->height) {
        return sim_fail(error, "the glasses differ in size");
    }
    for (uint32_t i = board->width * board->height; i-- > 0;) {
        if (memcmp(board->rgb + 3u * i, simulator->rgb + 3u * i, 3) == 0) { continue; }
        differ++;
        first = i;
    }
    return differ ? sim_fail(error, "%s: %u pixels differ from the simulator's, the first at %u,%u", line, differ,
                             first % board->width, first / board->width)
                  : 0;
}

static int write_picture(const frames_t *frames, const sim_picture_t *picture, const char *scene, const char *method,
                         unsigned number, sim_error_t *error) {
    char path[4096];

    if (!frames->pictures) { return 0; }
    (void)snprintf(path, sizeof path, "%s-%s-%s-%02u.png", frames->pictures, scene, method, number);
    return sim_picture_write(picture, path, error);
}

/* Sets the simulator to the moment that a line tells. */
static int set_moment(drawn_t *drawn, bool demo, unsigned number, double rate) {
    drawn->caption.show_rate = drawn->caption.show_method = demo;
    drawn->caption.rate = (uint16_t)lround(10 * rate);
    drawn->caption.method = drawn->method;
    return demo ? scene_phase(&drawn->player.stage, (bam16_t)number) : scene_frame(&drawn->player.stage, number);
}

static int compare(frames_t *frames, const char *line, sim_error_t *error) {
    const bool demo = line[0] == 'd';
    char scene[32], method_name[32];
    unsigned number;
    double rate = 0;
    sim_picture_t board = {0}, simulator = {0};
    const scene_script_t *script;
    int method, result;

    if (sscanf(line, "%*s %31s %31s %u %lf", scene, method_name, &number, &rate) < 3 + demo) {
        return sim_fail(error, "what frame is \"%s\"?", line);
    }
    script = scene_find(scene);
    method = find_method(method_name);
    if (!script || method < 0) { return sim_fail(error, "%s: no such scene or method", line); }
    if (!frames->reset) { return sim_fail(error, "%s: the panel's reset line was never low", line); }
    if (frames->light == 0) { return sim_fail(error, "%s: the panel is dark", line); }
    if (choose(&frames->drawn, frames->models, script, (uint8_t)method, error)) { return -1; }
    if ((result = set_moment(&frames->drawn, demo, number, rate)) || (result = player_show(&frames->drawn.player))) {
        return sim_fail(error, "%s: simulator: %s", line, tuile_stream_error_text(result));
    }
    result = frames->chip->glass(frames->chip, &board, error);
    result = result ? result : frames->drawn.chip->glass(frames->drawn.chip, &simulator, error);
    result = result ? result : write_picture(frames, &board, scene, method_name, number, error);
    result = result ? result : same(&board, &simulator, line, error);
    sim_picture_free(&board);
    sim_picture_free(&simulator);
    frames->count++;
    return result;
}

static int text(frames_t *frames, const char *line, sim_error_t *error) {
    const bool frame = strncmp(line, "frame ", 6) == 0 || strncmp(line, "demo ", 5) == 0;

    if (strncmp(line, "error ", 6) == 0) { return sim_fail(error, "the board says: %s", line); }
    (void)(frame ? printf("%s wire %" PRIu64 "\n", line, frames->wire_bytes) : printf("%s\n", line));
    if (!frame) { return 0; }
    frames->wire_bytes = 0;
    return compare(frames, line, error);
}

static int run(frames_t *frames, FILE *file, const sim_panel_t *panel, sim_error_t *error) {
    trace_t trace = {.file = file};
    trace_event_t event;
    int result;

    if (open_drawn(&frames->drawn, panel, error) || !(frames->chip = panel->create(error))) { return -1; }
    while ((result = trace_next(&trace, &event, error)) > 0) {
        if (event.kind == TRACE_LIGHT) { frames->light = event.flag; }
        if (event.kind == TRACE_BYTES) { frames->wire_bytes += event.size_bytes; }
        if (event.kind == TRACE_RESET && event.flag == 0) { frames->reset = true; }
        result =
            event.kind == TRACE_TEXT ? text(frames, (const char *)event.bytes, error) : trace_feed(frames->chip, &event, error);
        if (result) { break; }
    }
    trace_close(&trace);
    return result;
}

static void close_all(frames_t *frames) {
    if (frames->chip) { frames->chip->destroy(frames->chip); }
    if (frames->drawn.chip) { frames->drawn.chip->destroy(frames->drawn.chip); }
    free(frames->drawn.model);
    free(frames->drawn.font);
    free(frames->drawn.block);
}

int main(int count, char **arguments) {
    static frames_t frames;
    sim_error_t error = {""};
    const sim_panel_t *panel = count >= 5 ? sim_panel_find(arguments[2]) : NULL;
    FILE *file = panel ? fopen(arguments[1], "rb") : NULL;
    int result;

    if (!file) {
        (void)fputs("Usage: panel_frames TRACE PANEL MODELS COUNT [PICTURES]\n", stderr);
        return 2;
    }
    frames.models = arguments[3];
    frames.pictures = count > 5 ? arguments[5] : NULL;
    result = run(&frames, file, panel, &error);
    if (!result && strcmp(arguments[4], "any") != 0 && frames.count != strtoul(arguments[4], NULL, 10)) {
        result = sim_fail(&error, "%u frames, but %s are expected", frames.count, arguments[4]);
    }
    (void)fflush(stdout);
    if (result) {
        (void)fprintf(stderr, "panel_frames: %s\n", error.text);
    } else {
        (void)printf("%s: %u frames equal the simulator's; warnings of its chip: %u%s%s\n", arguments[2], frames.count,
                     frames.chip->warnings, frames.chip->warnings ? ", the first: " : "", frames.chip->warning.text);
    }
    close_all(&frames);
    (void)fclose(file);
    return result ? 1 : 0;
}
