/* SH1106 as data, by its data sheet V2.3. Like an SSD1306 that has pages only and four columns more, of which the glass leaves out
 * two at either end. */
#include "sh1106.h"

/* A line is a command. */
/* clang-format off */
static const TUILE_FLASH uint8_t init[] = {
    1, 0xAE,       /* off: without a reset line the memory might be seen */
    2, 0xD5, 0x80, /* clock: not divided */
    2, 0xA8, 0x3F, /* 64 commons */
    2, 0xD3, 0x00, /* no display offset */
    1, 0x40,       /* start line 0 */
    2, 0xAD, 0x8B, /* charge pump on while the display is */
    1, 0x32,       /* at 8 V, the default */
    2, 0xDA, 0x12, /* even commons from one side, odd ones from the other */
    2, 0x81, 0xCF, /* contrast */
    2, 0xD9, 0x22, /* discharge and pre-charge 2 clocks each, the default */
    2, 0xDB, 0x35, /* VCOM 0.77 of the voltage, the default */
    1, 0xA4,       /* what the memory holds, not all on */
};
/* clang-format on */

/* Upright on the usual modules is column 0 at segment 131 and the scan towards COM0. */
static const TUILE_FLASH uint8_t turn_0[] = {1, 0xA1, 1, 0xC8};
static const TUILE_FLASH uint8_t turn_1[] = {1, 0xA0, 1, 0xC8};
static const TUILE_FLASH uint8_t turn_2[] = {1, 0xA0, 1, 0xC0};
static const TUILE_FLASH uint8_t turn_3[] = {1, 0xA1, 1, 0xC0};

static const TUILE_FLASH uint8_t on[] = {1, 0xAF};
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0xAE}; /* the pump stops with it */

const TUILE_FLASH tuile_panel_t tuile_sh1106 = {
    .name = "sh1106",
    .ram_width = 132,
    .ram_height = 64,
    .view_width = 128,
    .view_height = 64,
    .offset_x = 2,
    .align_y = 8,
    .parameters_low = 1,
    .addressing = TUILE_ADDRESS_PAGE,
    .brightness_command = 0x81,
    .brightness_most = 0xCF,
    .invert_command = {0xA6, 0xA7},
    .turn = {TUILE_SEQUENCE(turn_0), TUILE_SEQUENCE(turn_1), TUILE_SEQUENCE(turn_2), TUILE_SEQUENCE(turn_3)},
    .mode = {0, TUILE_EXCHANGE | TUILE_MIRROR_X, TUILE_MIRROR_X | TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_Y},
    .fixed_axes = 1,
    .format_count = 1,
    .formats = {{TUILE_WIRE_MONO_PAGES, 0, TUILE_WIRE_MONO_PAGES_TURNED}},
    .reset_low_ms = 1,   /* 10 us are asked for */
    .reset_wait_ms = 10, /* 2 us, and time for the module's voltages */
    .init = TUILE_SEQUENCE(init),
    .on = TUILE_SEQUENCE(on),
    .sleep = TUILE_SEQUENCE(sleep_sequence),
    .command_clock_hz = 4000000,
    .pixel_clock_hz = 4000000,
    .rated_pixel_clock_hz = 4000000, /* a cycle of 250 ns */
};
