/* The program that tests run on a board: every scene that the board has, by every method, some frames each. After a frame it tells
 * which it was, and waits until it has been looked at:
 *
 *     board 128 64                    the display, in pixels
 *     frame spider zbuffer 3 passes 1
 *     skip spider painter wants 70000 the board's block is too small for this method, in bytes
 *     error spider zbuffer 3 TEXT
 *     stack 1234 of 4096              used at most, and the room that there is, in bytes
 *
 * Options: frames=N (8), scene=NAME and method=NAME (all), fault=hard, stack or assert: breaks on purpose. */
#include "board.h"
#include "line.h"
#include "../player.h"

static const char *const method_names[] = {"zbuffer", "scanline", "warnock", "painter", "tree"};

/* Where a counter of instructions begins and ends (tests/emulators/count.c). */
void frame_begins(void);
void frame_ends(void);
__attribute__((noinline)) void frame_begins(void) { __asm__ volatile("" ::: "memory"); }
__attribute__((noinline)) void frame_ends(void) { __asm__ volatile("" ::: "memory"); }

static tuile_display_t display;
static player_t player;

static void name_of(line_t *line, const char *kind, const scene_script_t *script, uint8_t method) {
    *line = (line_t){.used = 0};
    line_word(line, kind);
    line_word(line, script->name);
    line_word(line, method_names[method]);
}

static void fail(const scene_script_t *script, uint8_t method, uint32_t frame, int error) {
    line_t line;

    name_of(&line, "error", script, method);
    line_number(&line, frame);
    line_word(&line, tuile_stream_error_text(error));
    board_tell(line.text);
    board_park(BOARD_FAILED);
}

static void tell_shown(const scene_script_t *script, uint8_t method, uint32_t frame) {
    line_t line;

    name_of(&line, "frame", script, method);
    line_number(&line, frame);
    line_word(&line, "passes");
    line_number(&line, player.stats.passes);
    board_tell(line.text);
    (void)board_stack_used(); /* looks after the guard */
    board_shown();
}

static void tell_skipped(const scene_script_t *script, uint8_t method) {
    line_t line;

    name_of(&line, "skip", script, method);
    line_word(&line, "wants");
    line_number(&line, (uint32_t)player.wanted_bytes);
    board_tell(line.text);
}

static void show(const scene_script_t *script, uint8_t method, uint32_t count) {
    player_config_t config = {.display = &display, .method = method};
    int error;

    config.model = board_model(script, &config.model_bytes);
    config.block = board_block(&config.block_bytes);
    error = player_open(&player, script, &config);
    for (uint32_t frame = 0; frame < count && error != TUILE_ERROR_MEMORY; frame++) {
        if (error) { fail(script, method, frame, error); }
        frame_begins();
        error = player_frame(&player, frame);
        frame_ends();
        if (error == TUILE_ERROR_MEMORY) { break; }
        if (error) { fail(script, method, frame, error); }
        tell_shown(script, method, frame);
    }
    if (error == TUILE_ERROR_MEMORY) { tell_skipped(script, method); }
}

static bool wanted(const char *options, const char *option, const char *name) {
    const char *value = line_option(options, option);

    if (!value) { return true; }
    while (*name && *name == *value) {
        name++;
        value++;
    }
    return *name == 0 && (*value == 0 || *value == ' ');
}

static void break_if_asked(const char *options) {
    const char *fault = line_option(options, "fault");

    if (!fault) { return; }
    BOARD_CHECK(fault[0] != 'a');
    board_break(fault[0] == 'h' ? BOARD_HARD_FAULT : BOARD_STACK_GUARD);
    (void)board_stack_used();
    board_tell("error a fault was not noticed");
    board_park(BOARD_FAILED);
}

static void tell_display(void) {
    line_t line = {.used = 0};

    line_word(&line, "board");
    line_number(&line, display.width);
    line_number(&line, display.height);
    board_tell(line.text);
}

static void tell_stack(void) {
    line_t line = {.used = 0};

    line_word(&line, "stack");
    line_number(&line, (uint32_t)board_stack_used());
    line_word(&line, "of");
    line_number(&line, (uint32_t)board_stack_room());
    board_tell(line.text);
}

int main(void) {
    char options[80];
    const int error = tuile_display_init(&display, board_display());

    board_options(options, sizeof options);
    break_if_asked(options);
    if (error) {
        board_tell(tuile_stream_error_text(error));
        board_park(BOARD_FAILED);
    }
    tell_display();
    for (unsigned i = 0; i < scene_count; i++) {
        for (uint8_t method = 0; method <= TUILE_TREE; method++) {
            if ((scenes[i]->methods >> method & 1u) && wanted(options, "scene", scenes[i]->name) &&
                wanted(options, "method", method_names[method])) {
                show(scenes[i], method, line_value(line_option(options, "frames"), 8));
            }
        }
    }
    tell_stack();
    board_park(BOARD_DONE);
}
