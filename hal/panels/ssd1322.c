/* SSD1322 as data. Numbers in brackets are sections of its data sheet, Rev 1.2.
 *
 * Columns are counted by four pixels. The glass is in the middle of the 480 segments: columns 1Ch to 5Bh from either end. */
#include "ssd1322.h"

/* A line is a command. */
/* clang-format off */
static const TUILE_FLASH uint8_t init[] = {
    2, 0xFD, 0x12,       /* unlock (10.1.26) */
    1, 0xAE,             /* off (10.1.12): without a reset line the memory might be seen */
    2, 0xB3, 0x91,       /* clock: 80 frames a second (10.1.14) */
    2, 0xCA, 0x3F,       /* 64 commons (10.1.24) */
    2, 0xA2, 0x00,       /* no display offset (10.1.8) */
    2, 0xA1, 0x00,       /* start line 0 (10.1.7) */
    2, 0xAB, 0x01,       /* internal regulator (10.1.11) */
    3, 0xB4, 0xA0, 0xFD, /* external low voltage, enhanced quality (10.1.15) */
    2, 0xC1, 0x9F,       /* contrast (10.1.22) */
    2, 0xC7, 0x0F,       /* all of the current (10.1.23) */
    1, 0xB9,             /* linear greys (10.1.19) */
    2, 0xB1, 0xE2,       /* phases: 5 clocks and 14 (10.1.13) */
    3, 0xD1, 0xA2, 0x20, /* enhancement B: as after a reset (10.1.25) */
    2, 0xBB, 0x1F,       /* pre-charge at 0.6 VCC (10.1.20) */
    2, 0xB6, 0x08,       /* second pre-charge 8 clocks (10.1.17) */
    2, 0xBE, 0x07,       /* VCOMH 0.86 VCC (10.1.21) */
    1, 0xA9,             /* all of the display (10.1.10) */
};
/* clang-format on */

/* (10.1.6) 04h: the upper half of the first byte comes first. 02h: columns from the other end. 10h: the scan runs towards COM0. The
 * second parameter drives each common from both sides. */
static const TUILE_FLASH uint8_t turn_0[] = {3, 0xA0, 0x06, 0x11};
static const TUILE_FLASH uint8_t turn_1[] = {3, 0xA0, 0x04, 0x11};
static const TUILE_FLASH uint8_t turn_2[] = {3, 0xA0, 0x14, 0x11};
static const TUILE_FLASH uint8_t turn_3[] = {3, 0xA0, 0x16, 0x11};

static const TUILE_FLASH uint8_t on[] = {1, 0xAF}; /* (10.1.12) */
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0xAE};

const TUILE_FLASH tuile_panel_t tuile_ssd1322 = {
    .name = "ssd1322",
    .ram_width = 480,
    .ram_height = 64, /* of 128: the scan is reversed within the multiplex ratio */
    .view_width = 256,
    .view_height = 64,
    .offset_x = 112,
    .align_x = 4,
    .unit_x = 4,
    .addressing = TUILE_ADDRESS_8,
    .column_command = 0x15, /* (10.1.2) */
    .row_command = 0x75,    /* (10.1.5) */
    .write_command = 0x5C,  /* (10.1.3) */
    .brightness_command = 0xC1,
    .brightness_most = 0x9F,
    .invert_command = {0xA6, 0xA7}, /* (10.1.9) */
    .turn = {TUILE_SEQUENCE(turn_0), TUILE_SEQUENCE(turn_1), TUILE_SEQUENCE(turn_2), TUILE_SEQUENCE(turn_3)},
    .mode = {0, TUILE_EXCHANGE | TUILE_MIRROR_X, TUILE_MIRROR_X | TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_Y},
    .fixed_axes = 1,
    .format_count = 1,
    .formats = {{TUILE_WIRE_GREY4, 0, TUILE_WIRE_GREY4_TURNED}},
    .reset_low_ms = 1,   /* 2 us are asked for */
    .reset_wait_ms = 10, /* 2 us, and time for the module's voltages */
    .init = TUILE_SEQUENCE(init),
    .on = TUILE_SEQUENCE(on),
    .sleep = TUILE_SEQUENCE(sleep_sequence),
    .command_clock_hz = 4000000,
    .pixel_clock_hz = 10000000,
    .rated_pixel_clock_hz = 10000000, /* a cycle of 100 ns */
};
