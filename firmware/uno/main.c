/* Arduino Uno with an SSD1306 of 128 x 64: a turning cube and a small room, by z-buffer and by display tree, in 2 KB of RAM.
 *
 * The views of the frames stand in flash beside the models (raster/compact/compact.h). Between a picture and the next one the
 * display keeps what it shows, so the program needs no frame buffer: a tile is drawn, sent and forgotten. */
#include "../../hal/display.h"
#include "../../hal/panels/ssd1306.h"
#include "../../raster/compact/compact.h"
#include "atmega328p.h"
#include "spi.h"
#include "stack.h"
#include "tell.h"

#define FAILED 1
#define STACK_GUARD 65

extern const TUILE_FLASH uint8_t model_cube[], model_room[];
extern const TUILE_FLASH tuile_compact_view_t views_cube[UNO_FRAMES], views_room[UNO_FRAMES];

typedef struct show {
    const TUILE_FLASH uint8_t *model;
    const TUILE_FLASH tuile_compact_view_t *views;
    uint8_t method;
    uint8_t tile_width; /* a depth of 16 bits for each pixel needs smaller tiles */
} show_t;

static const TUILE_FLASH show_t shows[UNO_SHOWS] = {
    [UNO_CUBE_ZBUFFER] = {model_cube, views_cube, TUILE_ZBUFFER, 16},
    [UNO_ROOM_TREE] = {model_room, views_room, TUILE_TREE, 128},
    [UNO_CUBE_TREE] = {model_cube, views_cube, TUILE_TREE, 128},
};

/* The largest of the shows' blocks: the models have 24 and 70 vertices, trees of 1 and 5 nodes. */
static _Alignas(4) uint8_t block[TUILE_COMPACT_BYTES(TUILE_ZBUFFER, 24u, 0u, 16u, 8u)];
static uno_spi_t spi;
static tuile_bus_t bus;
static tuile_display_t display;
static tuile_compact_t compact;

_Noreturn void uno_park(uint8_t code);

static void tell(uint8_t event, uint8_t a, uint8_t b) {
    GPIOR1 = a;
    GPIOR2 = b;
    GPIOR0 = event;
}

_Noreturn void uno_park(uint8_t code) {
    tell(UNO_PARKED, code, 0);
    SMCR = SMCR_POWER_DOWN;
    for (;;) {
        __asm__ volatile("cli\n\tsleep");
    }
}

static void check(int result) {
    if (result < 0) { uno_park(FAILED); }
}

static void show_frame(const TUILE_FLASH show_t *show, uint8_t number, uint8_t frame) {
    tuile_tile_t tile;
    int result;

    tell(UNO_BEGINS, number, (uint8_t)(frame * UNO_STEP));
    tuile_compact_begin(&compact, &show->views[frame]);
    while ((result = tuile_compact_next(&compact, &tile)) > 0) {
        check(tuile_display_window(&display, tile.x, tile.y, tile.width, tile.height));
        check(tuile_display_write(&display, tile.bytes, (size_t)tile.size_bytes));
    }
    check(result);
    check(tuile_display_present(&display));
    tell(UNO_SHOWN, number, (uint8_t)(frame * UNO_STEP));
}

static void show_all(const TUILE_FLASH show_t *show, uint8_t number) {
    const tuile_compact_config_t config = {
        .width = display.width, .height = display.height, .tile_width = show->tile_width, .tile_height = 8, .method = show->method};

    check(tuile_compact_open(&compact, &config, show->model, block, sizeof block));
    for (uint8_t frame = 0; frame < UNO_FRAMES; frame++) {
        show_frame(show, number, frame);
    }
}

int main(void) {
    uno_spi_open(&bus, &spi);
    {
        const tuile_display_config_t config = {.bus = &bus, .panel = &tuile_ssd1306_128x64};

        check(tuile_display_init(&display, &config));
    }
    for (;;) {
        for (uint8_t number = 0; number < UNO_SHOWS; number++) {
            show_all(&shows[number], number);
        }
        const uint16_t unused = uno_stack_unused();
        if (unused == 0) { uno_park(STACK_GUARD); }
        tell(UNO_STACK, (uint8_t)unused, (uint8_t)(unused >> 8));
        tell(UNO_ROUND, 0, 0);
    }
}
