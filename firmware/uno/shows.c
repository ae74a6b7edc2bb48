#include "shows.h"

#include "../../hal/display.h"
#include "../../hal/panels/ssd1306.h"
#include "atmega328p.h"
#include "spi.h"

#define FAILED 1

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

void uno_tell(uno_event_t event, uint8_t a, uint8_t b) {
    GPIOR1 = a;
    GPIOR2 = b;
    GPIOR0 = (uint8_t)event;
}

_Noreturn void uno_park(uint8_t code) {
    uno_tell(UNO_PARKED, code, 0);
    SMCR = SMCR_POWER_DOWN;
    for (;;) {
        __asm__ volatile("cli\n\tsleep");
    }
}

static void check(int result) {
    if (result < 0) { uno_park(FAILED); }
}

void uno_open(void) {
    const tuile_display_config_t config = {.bus = &bus, .panel = &tuile_ssd1306_128x64};

    uno_spi_open(&bus, &spi);
    check(tuile_display_init(&display, &config));
}

void uno_choose(uint8_t number) {
    const TUILE_FLASH show_t *show = &shows[number];
    const tuile_compact_config_t config = {
        .width = display.width, .height = display.height, .tile_width = show->tile_width, .tile_height = 8, .method = show->method};

    check(tuile_compact_open(&compact, &config, show->model, block, sizeof block));
}

void uno_frame(uint8_t number, uint8_t frame, void (*over)(const tuile_tile_t *tile)) {
    tuile_tile_t tile;
    int result;

    uno_tell(UNO_BEGINS, number, (uint8_t)(frame * UNO_STEP));
    tuile_compact_begin(&compact, &shows[number].views[frame]);
    while ((result = tuile_compact_next(&compact, &tile)) > 0) {
        if (over) { over(&tile); }
        check(tuile_display_window(&display, tile.x, tile.y, tile.width, tile.height));
        check(tuile_display_write(&display, tile.bytes, (size_t)tile.size_bytes));
    }
    check(result);
    check(tuile_display_present(&display));
    uno_tell(UNO_SHOWN, number, (uint8_t)(frame * UNO_STEP));
}
