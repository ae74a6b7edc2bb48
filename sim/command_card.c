/* tuile card: a test card on one display or several. */
#include "../firmware/stream.h"
#include "card.h"
#include "commands.h"
#include "font.h"
#include "interrupt.h"
#include "render_display.h"
#include "render_format.h"
#include "render_value.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define DISPLAYS_MAX 8u
#define TICK_US 50000u /* between looks at whether the user ended it */

static const char usage[] =
    "Usage: tuile card [options]\n"
    "\n"
    "Shows a test card: a border of one pixel along the edge, the corners by name, an arrow up, bars in red, green and blue, a "
    "ramp\n"
    "of greys. docs/troubleshooting.md says what to change when it looks otherwise.\n"
    "\n"
    "  --panel NAME             a simulated panel, ili9341 by default; `tuile panels` lists them\n"
    "  --display WHERE          or any display; may be repeated, each shows the card\n"
    "  --rotate 0|90|180|270    how the panel is held\n"
    "  --clock HZ               clock of the bus for pixels, like 40M; 0 asks for the panel's usual one\n"
    "  --format F               format on the wire, of those that the display takes\n"
    "  --out FILE.png           a picture of the simulated panel; with a number like %d for several displays\n"
    "  --hold SECONDS           how long real displays show it, until Ctrl-C by default; then they are left dark\n"
    "\n"
    "WHERE is one of\n";

typedef struct card_command {
    render_display_t where[DISPLAYS_MAX];
    unsigned count;
    render_format_t format;
    const char *out;
    double hold;
    bool has_hold;
    uint8_t *font_bytes;
    tuile_font_t font;
} card_command_t;

typedef struct shown {
    target_t target;
    card_t card;
    char title[48];
    void *block;
} shown_t;

static int parse(card_command_t *c, int count, char **arguments) {
    options_t options;
    const char *argument;
    render_display_t common = {0}, last;
    options_open(&options, count, arguments);
    while ((argument = options_next(&options)) != NULL) {
        last = common;
        if (!options.name) {
            return command_fail("card: takes no plain arguments, but got %s", argument), EXIT_USAGE;
        } else if (render_display_option(&last, &options, argument)) {
            const bool names = strcmp(argument, "--panel") == 0 || strcmp(argument, "--display") == 0;
            if (names && c->count == DISPLAYS_MAX) {
                return command_fail("%s: at most %u displays", argument, DISPLAYS_MAX), EXIT_USAGE;
            }
            if (names) {
                c->where[c->count++] = last;
            } else {
                common = last;
            }
        } else if (strcmp(argument, "--out") == 0) {
            c->out = options_value(&options);
        } else if (strcmp(argument, "--hold") == 0) {
            c->has_hold = options_number(&options, &c->hold, 0, 1e6);
        } else if (strcmp(argument, "--help") == 0) {
            (void)fputs(usage, stdout);
            (void)fputs(target_usage, stdout);
            return -1;
        } else if (strcmp(argument, "--format") != 0 || !render_format_option(&c->format, &options, argument)) {
            options_unknown(&options);
        }
    }
    if (options.failed) { return EXIT_USAGE; }
    if (c->count == 0) { c->where[c->count++] = common; }
    for (unsigned i = 0; i < c->count; i++) {
        c->where[i].rotation = common.rotation;
        c->where[i].clock_hz = common.clock_hz;
    }
    return render_value_pattern("--out", c->out, c->count) ? 0 : EXIT_USAGE;
}

/* One frame of nothing but the card, in strips. */
static int draw(shown_t *shown) {
    static const tuile_scene_t nothing = {
        .camera = {.focal_x = TUILE_Q16(100),
                   .focal_y = TUILE_Q16(100),
                   .near = TUILE_Q16(1),
                   .far = TUILE_Q16(2),
                   .rotation = {{TUILE_ONE_Q30, 0, 0}, {0, TUILE_ONE_Q30, 0}, {0, 0, TUILE_ONE_Q30}}}};
    tuile_display_t *display = &shown->target.display;
    tuile_config_t config = {.tile_height = (uint16_t)(24 / display->align_y * display->align_y)};
    tuile_t *renderer;
    config.overlay = card_draw;
    config.overlay_context = &shown->card;
    render_display_apply(&shown->target, &config);
    if (config.tile_height == 0) { config.tile_height = display->align_y; }
    const size_t size_bytes = TUILE_BLOCK_BYTES((size_t)config.height, (size_t)config.width, (size_t)config.tile_height,
                                                config.format, 2u, 255u, config.effects, config.aa, config.dither);
    shown->block = malloc(size_bytes);
    if (!shown->block) { return command_fail("out of memory"); }
    int result = tuile_init(&renderer, &config, shown->block, size_bytes, NULL);
    if (result == 0) { result = tuile_stream_frame(renderer, &nothing, display, NULL); }
    if (result == 0) { return 0; }
    const char *detail = target_detail(&shown->target);
    return command_fail("%s: %s%s%s", shown->target.config.text, tuile_stream_error_text(result), detail[0] ? ": " : "", detail);
}

static int show(card_command_t *c, unsigned i, shown_t *shown) {
    const uint8_t wire = c->format.named ? (uint8_t)(c->format.format + 1) : TUILE_WIRE_DEFAULT;
    char name[4096];
    sim_picture_t picture = {0};
    sim_error_t error = {""};
    if (render_display_open(&c->where[i], &shown->target, wire) != 0) { return EXIT_FAILURE; }
    const tuile_display_t *display = &shown->target.display;
    const sim_panel_t *module = shown->target.config.module;
    (void)snprintf(shown->title, sizeof shown->title, "%.24s %u\u00b0", module ? module->panel->name : "usb",
                   90u * shown->target.rotation);
    shown->card = (card_t){&c->font, shown->title, module && module->panel->round};
    if (draw(shown) != 0) { return EXIT_FAILURE; }
    render_display_warn(&c->where[i], &shown->target);
    (void)printf("%s: %ux%u, %s\n", module ? module->panel->name : shown->target.config.text, display->width, display->height,
                 render_format_name((uint8_t)(display->wire - 1)));
    if (!c->out) { return 0; }
    render_value_frame_name(name, sizeof name, c->out, i);
    const int result = target_picture(&shown->target, &picture, NULL, &error) || sim_picture_write(&picture, name, &error);
    sim_picture_free(&picture);
    return result ? command_fail("%s", error.text) : 0;
}

/* Until time or the user ends it. */
static void hold(const card_command_t *c, const shown_t *shown) {
    bool real = false;
    for (unsigned i = 0; i < c->count; i++) {
        real = real || !target_is_simulated(&shown[i].target);
    }
    const double ticks = c->hold / (TICK_US / 1e6); /* <= 2e7 */
    for (uint32_t tick = 0; real && (!c->has_hold || tick < ticks) && !interrupt_seen(); tick++) {
        (void)usleep(TICK_US);
    }
}

static int run(card_command_t *c) {
    shown_t *shown = calloc(c->count, sizeof *shown);
    sim_error_t error = {""};
    size_t size_bytes;
    int code = 0;
    if (!shown || font_load(NULL, &c->font_bytes, &size_bytes, &error) != 0) {
        free(shown);
        return command_fail("%s", error.text[0] ? error.text : "out of memory");
    }
    (void)tuile_font_open(&c->font, c->font_bytes, size_bytes);
    interrupt_catch();
    for (unsigned i = 0; code == 0 && i < c->count; i++) {
        code = show(c, i, &shown[i]);
    }
    if (code == 0) {
        code = command_finish();
        hold(c, shown);
    }
    for (unsigned i = 0; i < c->count; i++) {
        target_close(&shown[i].target);
        free(shown[i].block);
    }
    free(shown);
    free(c->font_bytes);
    return code == 0 && interrupt_seen() ? interrupt_code() : code;
}

int command_card(int count, char **arguments) {
    card_command_t c;
    memset(&c, 0, sizeof c);
    const int code = parse(&c, count, arguments);
    if (code > 0) { return code; }
    return code < 0 ? command_finish() : run(&c);
}
