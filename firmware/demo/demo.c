/* The program to put on a board: its scenes by the methods that can draw each, with the method and the frames a second over them. A
 * short press of the button shows the next method, a long one the next scene; without any they change by themselves.
 *
 * Options, for tests: every=MS from change to change; frames=N, then the end; tell=1: after each frame it tells a line,
 *
 *     demo spider zbuffer 8190 12.3   the phase of the scene, and the rate that stands over it, 0 when it is not known
 *
 * and waits until the frame has been looked at. A pair of scene and method that the board has no memory for, or whose model has no
 * tree, is left out; with tell=1 a line says so: skip spider warnock wants 70000, in bytes. */
#include "../board/board.h"
#include "../board/line.h"
#include "../caption.h"
#include "../player.h"
#include "../tour.h"
#include "../../raster/overlay/font.h"

extern const uint32_t demo_font[]; /* `tuile font` writes it at build time */

#define PHASE_US_BITS 7 /* a scene comes round in 2^(16 + 7) microseconds, and so, with it, the clock */

static tuile_display_t display;
static player_t player;
static caption_t caption;
static tour_t tour;
static button_t button;
static button_event_t event; /* that came while a frame was drawn */

/* Where a counter of instructions begins and ends (tests/emulators/count.c). */
void frame_begins(void);
void frame_ends(void);
__attribute__((noinline)) void frame_begins(void) { __asm__ volatile("" ::: "memory"); }
__attribute__((noinline)) void frame_ends(void) { __asm__ volatile("" ::: "memory"); }

static _Noreturn void fail(const char *text) {
    board_tell(text);
    board_park(BOARD_FAILED);
}

static void look_at_button(void) {
    const button_event_t now = button_look(&button, board_button(), board_clock_us());

    if (now) { event = now; }
}

/* Tiles come more often than frames, so that a short press is not missed. */
static void over_tile(void *context, tuile_canvas_t *canvas) {
    look_at_button();
    caption_draw(context, canvas);
}

static line_t line_of(const char *kind) {
    line_t line = {.used = 0};

    line_word(&line, kind);
    line_word(&line, scenes[tour.scene]->name);
    line_word(&line, caption_methods[tour.method]);
    return line;
}

static void tell_skipped(void) {
    line_t line = line_of("skip");

    line_word(&line, "wants");
    line_number(&line, (uint32_t)player.wanted_bytes);
    board_tell(line.text);
}

static void tell_shown(uint16_t phase) {
    line_t line = line_of("demo");
    char rate[TUILE_DECIMAL_BYTES];

    tuile_decimal(rate, caption.rate, caption.rate ? 1 : 0);
    line_number(&line, phase);
    line_word(&line, rate);
    board_tell(line.text);
    (void)board_stack_used(); /* looks after the guard */
    board_shown();
}

static int open_scene(void) {
    const scene_script_t *script = scenes[tour.scene];
    player_config_t config = {.display = &display, .method = tour.method, .overlay = over_tile, .overlay_context = &caption};

    config.model = board_model(script, &config.model_bytes);
    config.block = board_block(&config.block_bytes);
    return player_open(&player, script, &config);
}

static int show(uint16_t phase) {
    int error = scene_phase(&player.stage, phase);

    caption.rate = tour.rate;
    caption.method = tour.method;
    frame_begins();
    if (!error) { error = player_show(&player); }
    frame_ends();
    return error;
}

static void run(bool tells, uint32_t count) {
    int error = open_scene();

    for (uint32_t frame = 0; count == 0 || frame < count;) {
        const uint16_t phase = (uint16_t)(board_clock_us() >> PHASE_US_BITS);

        if (!error) { error = show(phase); }
        if (error == TUILE_ERROR_MEMORY || error == TUILE_ERROR_TREE) {
            if (tells) { tell_skipped(); }
            if (!tour_skip(&tour, board_clock_us())) { fail("no scene can be drawn in this memory"); }
            error = open_scene();
            continue;
        }
        if (error) { fail(tuile_stream_error_text(error)); }
        frame++;
        if (tells) { tell_shown(phase); }
        look_at_button();
        if (tour_frame(&tour, event, board_clock_us())) { error = open_scene(); }
        event = BUTTON_NOTHING;
    }
}

int main(void) {
    char options[80];
    const int error = tuile_display_init(&display, board_display());

    if (error) { fail(tuile_stream_error_text(error)); }
    board_options(options, sizeof options);
    if (tuile_font_open(&caption.font, demo_font, demo_font[FONT_AT_SIZE / 4])) { fail("the font is damaged"); }
    caption.show_rate = caption.show_method = true;
    tour_begin(&tour, 1000u * line_value(line_option(options, "every"), TOUR_EVERY_US / 1000u), board_clock_us());
    run(line_value(line_option(options, "tell"), 0) != 0, line_value(line_option(options, "frames"), 0));
    board_park(BOARD_DONE);
}
