/* The program that tests run on a board: every scene that the board has, by every method, some frames each. After a frame it tells
 * which it was, and waits until it has been looked at:
 *
 *     board 128 64                    the display, in pixels
 *     frame spider zbuffer 3 passes 1
 *     skip spider painter wants 70000 the board's block is too small for this method, in bytes
 *     error spider zbuffer 3 TEXT
 *     stack 1234 of 4096              used at most, and the room that there is, in bytes
 *
 * Options: frames=N (8), scene=NAME and method=NAME (all); columns=N and rows=N, of a tile, by
 * default all and as many as suit the block; update=N: sends only what has changed, in cells N pixels wide, of tiles of 16 rows if
 * not told otherwise, and the line of a frame ends with "sent 512 of 4096", bytes of pixels; fault=hard, stack or assert: breaks on
 * purpose. */
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

/* What update=N takes. The sums lie at the beginning of the block. */
static tuile_update_t update;
static tuile_changes_t changes;
static tuile_change_t change;

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
    if (player.update) {
        line_word(&line, "sent");
        line_number(&line, update.bytes_sent);
        line_word(&line, "of");
        line_number(&line, update.bytes_whole);
    }
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

/* Takes room for sums from the block; a block without that room is left with none at all. */
static void use_update(player_config_t *config, uint32_t cell_width) {
    const uint32_t width = display.width, height = display.height;
    const uint32_t tile_width = config->tile_width ? config->tile_width : width;
    size_t bytes;

    if (!config->tile_height) { config->tile_height = 16; }
    changes = (tuile_changes_t){.instances = &change, .capacity = 1};
    update = (tuile_update_t){.sums = config->block, .changes = &changes};
    if (cell_width < tile_width) { update.cell_width = (uint16_t)cell_width; }
    update.sum_count =
        TUILE_UPDATE_CELLS(width, height, tile_width, (uint32_t)config->tile_height, update.cell_width ? cell_width : tile_width);
    bytes = (update.sum_count * sizeof *update.sums + 7u) / 8u * 8u;
    config->update = &update;
    config->block = (uint8_t *)config->block + bytes;
    config->block_bytes = bytes < config->block_bytes ? config->block_bytes - bytes : 0;
}

static void show(const scene_script_t *script, uint8_t method, const char *options) {
    const uint32_t count = line_value(line_option(options, "frames"), 8);
    const uint32_t cell_width = line_value(line_option(options, "update"), 0);
    player_config_t config = {.display = &display, .method = method};
    int error;

    config.model = board_model(script, &config.model_bytes);
    config.block = board_block(&config.block_bytes);
    config.tile_width = (uint16_t)line_value(line_option(options, "columns"), 0);
    config.tile_height = (uint16_t)line_value(line_option(options, "rows"), 0);
    if (cell_width) { use_update(&config, cell_width); }
    error = player_open(&player, script, &config);
    if (error == TUILE_ERROR_TREE) { return; } /* a model of one's own, without one */
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
    char options[128];
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
                show(scenes[i], method, options);
            }
        }
    }
    tell_stack();
    board_park(BOARD_DONE);
}
