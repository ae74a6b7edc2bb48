/* ILI9341 as data. Numbers in brackets are sections of its data sheet, V1.11.
 *
 * The first block tunes the charge pumps and the gate timing; the values are the ones that the makers of modules ship and that
 * nearly every driver repeats. EFh is in no edition of the data sheet, but the modules' own programs begin with it. */
#include "ili9341.h"

/* A line is a command. */
/* clang-format off */
static const TUILE_FLASH uint8_t init[] = {
    4, 0xEF, 0x03, 0x80, 0x02,     /* undocumented */
    4, 0xCF, 0x00, 0xC1, 0x30,     /* power control B: ESD path on (8.4.2) */
    5, 0xED, 0x64, 0x03, 0x12, 0x81, /* power on sequence: soft start, order, DDVDH enhanced (8.4.5) */
    4, 0xE8, 0x85, 0x00, 0x78,     /* driver timing A: non-overlap + 1, EQ and pre-charge short (8.4.3) */
    6, 0xCB, 0x39, 0x2C, 0x00, 0x34, 0x02, /* power control A: Vcore 1.6 V, DDVDH 5.8 V, the defaults (8.4.1) */
    2, 0xF7, 0x20,                 /* pump ratio: DDVDH = 2 x VCI (8.4.7) */
    3, 0xEA, 0x00, 0x00,           /* driver timing B: gate driver without EQ time (8.4.4) */
    2, 0xC0, 0x23,                 /* power control 1: GVDD 4.60 V (8.3.16) */
    2, 0xC1, 0x10,                 /* power control 2: step-up factors (8.3.17) */
    3, 0xC5, 0x3E, 0x28,           /* VCOM control 1: VCOMH, VCOML (8.3.18) */
    2, 0xC7, 0x86,                 /* VCOM control 2: offset (8.3.19) */
    3, 0xB1, 0x00, 0x13,           /* frame rate: 19 clocks a line, about 100 Hz (8.3.2) */
    2, 0xF2, 0x00,                 /* no 3-gamma control (8.4.6) */
    2, 0x26, 0x01,                 /* gamma curve 1 (8.2.17) */
    /* positive gamma (8.3.24) */
    16, 0xE0, 0x0F, 0x31, 0x2B, 0x0C, 0x0E, 0x08, 0x4E, 0xF1, 0x37, 0x07, 0x10, 0x03, 0x0E, 0x09, 0x00,
    /* negative gamma (8.3.25) */
    16, 0xE1, 0x00, 0x0E, 0x14, 0x03, 0x11, 0x07, 0x31, 0xC1, 0x48, 0x08, 0x0F, 0x0C, 0x31, 0x36, 0x0F,
    4, 0xB6, 0x08, 0xC2, 0x27,     /* normally white, gates from G320, 320 lines (8.3.7), see below */
    1, 0x11, TUILE_SEQUENCE_DELAY_MS(120), /* sleep out; 5 ms would do for a command, 120 for the picture (8.2.12) */
};
/* clang-format on */

static const TUILE_FLASH uint8_t on[] = {1, 0x29}; /* (8.2.19) */
/* Display off (8.2.18), sleep in and the time until it is reached (8.2.11). */
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0x28, 1, 0x10, TUILE_SEQUENCE_DELAY_MS(120)};
static const TUILE_FLASH uint8_t tearing[] = {2, 0x35, 0x00}; /* vertical blank only (8.2.28) */

#define MODES \
    { 0, TUILE_EXCHANGE | TUILE_MIRROR_X, TUILE_MIRROR_X | TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_Y }

const TUILE_FLASH tuile_panel_t tuile_ili9341 = {
    .name = "ili9341",
    .ram_width = 240,
    .ram_height = 320,
    .view_width = 240,
    .view_height = 320,
    .software_reset = 0x01,   /* (8.2.2) */
    .format_command = 0x3A,   /* (8.2.33) */
    .rotation_command = 0x36, /* (8.2.29) */
    .column_command = 0x2A,   /* (8.2.20) */
    .row_command = 0x2B,      /* (8.2.21) */
    .write_command = 0x2C,    /* (8.2.22) */
    /* 51h drives a pin that modules leave open: the backlight is the board's. */
    .brightness_command = 0,
    /* The glass is wired in reverse along one axis. Either MX is set in each rotation (and B6h is 82h), or the gates are scanned
     * from the other end: C2h, as here, and then the RAM is as the picture is. Mixing the two gives a mirrored picture. */
    .rotation_base = TUILE_MADCTL_BGR,
    .order_bit = TUILE_MADCTL_BGR,
    .rotation = MODES,
    .mode = MODES,
    .format_count = 2,
    .formats = {{TUILE_WIRE_RGB565, 0x55, 0}, {TUILE_WIRE_RGB666, 0x66, 0}},
    .id_command = 0xD3, /* (8.3.23) */
    .id_count = 3,
    .id = {0x00, 0x93, 0x41},
    .reset_low_ms = 1,    /* 10 us are asked for (12.2) */
    .reset_wait_ms = 120, /* 5 ms, but 120 before sleep out if it was awake, which nobody can know (8.2.2) */
    .init = TUILE_SEQUENCE(init),
    .on = TUILE_SEQUENCE(on),
    .sleep = TUILE_SEQUENCE(sleep_sequence),
    .tearing = TUILE_SEQUENCE(tearing),
    .command_clock_hz = 10000000,
    .pixel_clock_hz = 40000000,
    .rated_pixel_clock_hz = 10000000, /* write cycle 100 ns (18.3.4); modules run at 27 to 80 MHz */
};
