/* The bunny by both cores, turning: after each frame a line with its time, and where the border between the cores is.
 *
 *     frame bunny zbuffer 3 us 61234 border 14 of 30
 */
#include "../../board/board.h"
#include "../../board/line.h"
#include "../../cores.h"
#include "../core1.h"

#define CORE_1_STACK_BYTES 8192u

static _Alignas(8) uint8_t core_1_stack[CORE_1_STACK_BYTES];
static tuile_display_t display;
static scene_stage_t stage;
static cores_t cores;

static void check(int error) {
    if (!error) { return; }
    board_tell(tuile_stream_error_text(error));
    board_park(BOARD_FAILED);
}

static void serve(void) {
    cores_serve(&cores);
    for (;;) {}
}

static void open_scene(void) {
    const scene_script_t *script = scene_find("bunny");
    size_t model_bytes;
    const void *model = board_model(script, &model_bytes);

    check(scene_open(&stage, script, model, model_bytes, display.width, display.height));
}

/* Each core has half of the board's block. */
static void open_cores(void) {
    tuile_config_t config = {
        .width = display.width, .height = display.height, .format = tuile_stream_format(&display), .tile_height = 8};
    size_t block_bytes;
    uint8_t *block = board_block(&block_bytes);
    const size_t half = block_bytes / 16u * 8u;

    scene_configure(&stage, &config);
    check(cores_open(&cores, &(cores_config_t){.renderer = &config,
                                               .display = &display,
                                               .port = &core1_port,
                                               .blocks = {block, block + half},
                                               .block_bytes = {half, half}}));
}

static void tell(uint32_t frame, uint32_t us, uint32_t border) {
    line_t line = {.used = 0};

    line_word(&line, "frame bunny zbuffer");
    line_number(&line, frame);
    line_word(&line, "us");
    line_number(&line, us);
    line_word(&line, "border");
    line_number(&line, border);
    line_word(&line, "of");
    line_number(&line, (display.height + 7u) / 8u);
    board_tell(line.text);
}

int main(void) {
    check(tuile_display_init(&display, board_display()));
    open_scene();
    open_cores();
    core1_start(serve, core_1_stack, sizeof core_1_stack);
    for (uint32_t frame = 0;; frame++) {
        const uint32_t start = core1_port.now(NULL), border = cores.border;

        check(scene_frame(&stage, frame));
        check(cores_frame(&cores, &stage.scene));
        (void)board_stack_used(); /* looks after the guard */
        tell(frame, core1_port.now(NULL) - start, border);
    }
}
