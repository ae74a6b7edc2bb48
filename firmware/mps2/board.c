/* The program of another board on Arm's MPS2 with the same core, as QEMU has it: AN386 with a Cortex-M4 (DAI 0386), AN505 with a
 * Cortex-M33 (DAI 0505). It takes the place of that board's own board.c, bus and registers; all else is that board's objects. It
 * has no panel: the wire of an ST7789 goes to a file; see board/wire/wire_board.c. */
#include "../board/board.h"
#include "../board/wire_file.h"
#include "../../hal/panels/st7789.h"

/* BLOCK_BYTES: as the board has it. */
static _Alignas(8) uint8_t block[BLOCK_BYTES];

void *board_block(size_t *size_bytes) {
    *size_bytes = sizeof block;
    return block;
}

uint32_t board_clock_us(void) { return 0; } /* nobody asks: the program that tests run does not look at time */

const tuile_display_config_t *board_display(void) {
    static tuile_bus_t bus;
    static const tuile_display_config_t config = {.bus = &bus, .panel = &tuile_st7789_240x240};

    if (wire_file_open(&bus, "wire.trace")) { board_park(BOARD_FAILED); }
    return &config;
}
