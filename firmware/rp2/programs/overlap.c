/* What the DMA saves: the time to draw a frame, the time of its tiles on the wire, and the time of both at once. For each of some
 * frames it tells three lines, each after what it is about, and then one of all of them in a row:
 *
 *     render bunny 3    the stage is set and the frame drawn, and nothing sent
 *     wire bunny 3      as many bytes are sent in the same windows, and nothing drawn
 *     both bunny 3      the stage is set, the frame drawn and shown, as by any program
 *     flow bunny 8      the same for all, the last tile of each going out while the next frame begins
 *
 * An emulator appends the times (tests/emulators/rp2040.mjs); on a real board a logic analyser finds them at the chip select. */
#include "../../board/board.h"
#include "../../board/line.h"
#include "../../player.h"

#define FRAMES 8u
/* High tiles are drawn faster, and alike enough that few wait for the wire; the block still has room for one pass. */
#define TILE_ROWS 40u

void frame_begins(void);
void frame_ends(void);
__attribute__((noinline)) void frame_begins(void) { __asm__ volatile("" ::: "memory"); }
__attribute__((noinline)) void frame_ends(void) { __asm__ volatile("" ::: "memory"); }

static tuile_display_t display;
static player_t player;

static void check(int error) {
    if (!error) { return; }
    board_tell(tuile_stream_error_text(error));
    board_park(BOARD_FAILED);
}

static void tell(const char *what, const scene_script_t *script, uint32_t frame) {
    line_t line = {.used = 0};

    line_word(&line, what);
    line_word(&line, script->name);
    line_number(&line, frame);
    board_tell(line.text);
}

static int render(uint32_t frame) {
    tuile_tile_t tile;
    int result = scene_frame(&player.stage, frame), ended;

    if (result || (result = tuile_begin(player.renderer, &player.stage.scene))) { return result; }
    while (result >= 0 && (result = tuile_next(player.renderer, &tile)) > 0) {}
    ended = tuile_end(player.renderer, NULL);
    return result ? result : ended;
}

static int send(void) {
    const tuile_config_t *config = tuile_config(player.renderer);
    size_t block_bytes;
    const uint8_t *block = board_block(&block_bytes);
    int error = 0;

    for (uint32_t y = 0; y < config->height && !error; y += config->tile_height) {
        const uint32_t rows = config->height - y < config->tile_height ? config->height - y : config->tile_height;

        error = tuile_display_window(&display, 0, y, config->width, rows);
        if (!error) { error = tuile_display_write(&display, block, (size_t)2 * config->width * rows); }
    }
    return error ? error : tuile_display_present(&display);
}

int main(void) {
    const scene_script_t *script = scene_find("bunny");
    player_config_t config = {.display = &display, .method = TUILE_ZBUFFER, .tile_height = TILE_ROWS};

    check(tuile_display_init(&display, board_display()));
    config.model = board_model(script, &config.model_bytes);
    config.block = board_block(&config.block_bytes);
    check(player_open(&player, script, &config));
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        int error;

        frame_begins();
        error = render(frame);
        frame_ends();
        check(error);
        tell("render", script, frame);
        frame_begins();
        error = send();
        frame_ends();
        check(error);
        tell("wire", script, frame);
        frame_begins();
        error = player_frame(&player, frame);
        frame_ends();
        check(error);
        tell("both", script, frame);
    }
    frame_begins();
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        check(scene_frame(&player.stage, frame));
        check(tuile_stream_flow(player.renderer, &player.stage.scene, &display, NULL));
    }
    check(tuile_stream_settle(&display));
    frame_ends();
    tell("flow", script, FRAMES);
    board_park(BOARD_DONE);
}
