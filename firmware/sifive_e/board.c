/* SiFive E: an RV32IMAC with 16 KB of RAM, as QEMU has it. It has no panel: the wire of an ILI9341 goes to a file;
 * see board/wire/wire_board.c. */
#include "../board/board.h"
#include "../board/wire_file.h"
#include "../../hal/panels/ili9341.h"

#define MTIME_LOW (*(volatile uint32_t *)0x0200bff8u)
#define MTIME_HIGH (*(volatile uint32_t *)0x0200bffcu)

#define BLOCK_BYTES (10u * 1024u)

static _Alignas(8) uint8_t block[BLOCK_BYTES];

void *board_block(size_t *size_bytes) {
    *size_bytes = sizeof block;
    return block;
}

/* mtime counts the periods of a crystal of 32 768 Hz (FE310-G000 manual, CLINT): 512 of them are 15 625 us. It is two words, and
 * the upper one may move between looks at the two. */
uint32_t board_clock_us(void) {
    uint32_t high, low;

    do {
        high = MTIME_HIGH;
        low = MTIME_LOW;
    } while (high != MTIME_HIGH);
    return (uint32_t)((((uint64_t)high << 32 | low) * 15625u) >> 9);
}

const tuile_display_config_t *board_display(void) {
    static tuile_bus_t bus;
    static const tuile_display_config_t config = {
        .bus = &bus, .panel = &tuile_ili9341, .pixel_clock_hz = 10000000}; /* as promised */

    if (wire_file_open(&bus, "wire.trace")) { board_park(BOARD_FAILED); }
    return &config;
}
