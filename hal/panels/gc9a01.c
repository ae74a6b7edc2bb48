/* GC9A01 as data. Commands by their names in chapter 6 of the data sheet of the GC9A01A, V1.0.
 *
 * More than half of the first block is in no edition of it: the values are the modules' makers', and every driver repeats them. */
#include "gc9a01.h"

/* A line is a command. */
/* clang-format off */
static const TUILE_FLASH uint8_t init[] = {
    1, 0xFE,                       /* inner registers: enabled by these two, one right after the other, until a reset */
    1, 0xEF,
    2, 0xEB, 0x14,                 /* undocumented, to 90h */
    2, 0x84, 0x40,
    2, 0x85, 0xFF,
    2, 0x86, 0xFF,
    2, 0x87, 0xFF,
    2, 0x88, 0x0A,
    2, 0x89, 0x21,
    2, 0x8A, 0x00,
    2, 0x8B, 0x80,
    2, 0x8C, 0x01,
    2, 0x8D, 0x01,
    2, 0x8E, 0xFF,
    2, 0x8F, 0xFF,
    5, 0x90, 0x08, 0x08, 0x08, 0x08,
    3, 0xB6, 0x00, 0x00,           /* display function: scanned from S1 and G1 on; MADCTL says the rest */
    2, 0xBD, 0x06,                 /* undocumented, to FFh */
    2, 0xBC, 0x00,
    4, 0xFF, 0x60, 0x01, 0x04,
    2, 0xC3, 0x13,                 /* VREG1A */
    2, 0xC4, 0x13,                 /* VREG1B */
    2, 0xC9, 0x22,                 /* VREG2A */
    2, 0xBE, 0x11,                 /* undocumented, to DFh */
    3, 0xE1, 0x10, 0x0E,
    4, 0xDF, 0x21, 0x0C, 0x02,
    7, 0xF0, 0x45, 0x09, 0x08, 0x08, 0x26, 0x2A, /* gamma 1 to 4 */
    7, 0xF1, 0x43, 0x70, 0x72, 0x36, 0x37, 0x6F,
    7, 0xF2, 0x45, 0x09, 0x08, 0x08, 0x26, 0x2A,
    7, 0xF3, 0x43, 0x70, 0x72, 0x36, 0x37, 0x6F,
    3, 0xED, 0x1B, 0x0B,           /* undocumented, to 70h */
    2, 0xAE, 0x77,
    2, 0xCD, 0x63,
    10, 0x70, 0x07, 0x07, 0x04, 0x0E, 0x0F, 0x09, 0x07, 0x08, 0x03,
    2, 0xE8, 0x34,                 /* frame rate: dot inversion over 4 lines */
    13, 0x62, 0x18, 0x0D, 0x71, 0xED, 0x70, 0x70, 0x18, 0x0F, 0x71, 0xEF, 0x70, 0x70, /* undocumented, to 98h */
    13, 0x63, 0x18, 0x11, 0x71, 0xF1, 0x70, 0x70, 0x18, 0x13, 0x71, 0xF3, 0x70, 0x70,
    8, 0x64, 0x28, 0x29, 0xF1, 0x01, 0xF1, 0x00, 0x07,
    11, 0x66, 0x3C, 0x00, 0xCD, 0x67, 0x45, 0x45, 0x10, 0x00, 0x00, 0x00,
    11, 0x67, 0x00, 0x3C, 0x00, 0x00, 0x00, 0x01, 0x54, 0x10, 0x32, 0x98,
    8, 0x74, 0x10, 0x85, 0x80, 0x00, 0x00, 0x4E, 0x00,
    3, 0x98, 0x3E, 0x07,
    1, 0x11, TUILE_SEQUENCE_DELAY_MS(120), /* sleep out; 5 ms would do for a command, 120 for the picture */
};
/* clang-format on */

static const TUILE_FLASH uint8_t on[] = {1, 0x29};                                                    /* display on */
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0x28, 1, 0x10, TUILE_SEQUENCE_DELAY_MS(120)}; /* display off, sleep in */
static const TUILE_FLASH uint8_t tearing[] = {2, 0x35, 0x00};                                         /* vertical blank only */

/* The first column is at the right. */
#define MODES \
    { TUILE_MIRROR_X, TUILE_EXCHANGE, TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_X | TUILE_MIRROR_Y }

const TUILE_FLASH tuile_panel_t tuile_gc9a01 = {
    .name = "gc9a01",
    .ram_width = 240,
    .ram_height = 240,
    .view_width = 240,
    .view_height = 240,
    .round = 1,
    .software_reset = 0x01,
    .format_command = 0x3A,
    .rotation_command = 0x36,
    .column_command = 0x2A,
    .row_command = 0x2B,
    .write_command = 0x2C,
    .row_first = 1, /* found by drivers, not in the data sheet; nor that a NOP (00h) upsets the chip */
    .inverted = 1,  /* IPS */
    .invert_command = {0x20, 0x21},
    .rotation_base = TUILE_MADCTL_BGR,
    .order_bit = TUILE_MADCTL_BGR,
    .rotation = MODES,
    .mode = MODES,
    .format_count = 3,
    .formats = {{TUILE_WIRE_RGB565, 0x55, 0}, {TUILE_WIRE_RGB444, 0x53, 0}, {TUILE_WIRE_RGB666, 0x66, 0}},
    .id_command = 0x04,
    .id_count = 3,
    .id = {0x00, 0x9A, 0x01},
    .reset_low_ms = 1,    /* 10 us are asked for */
    .reset_wait_ms = 120, /* 5 ms, but 120 before sleep out if it was awake, which nobody can know */
    .init = TUILE_SEQUENCE(init),
    .on = TUILE_SEQUENCE(on),
    .sleep = TUILE_SEQUENCE(sleep_sequence),
    .tearing = TUILE_SEQUENCE(tearing),
    .command_clock_hz = 10000000,
    .pixel_clock_hz = 40000000,
    .rated_pixel_clock_hz = 100000000, /* write cycle 10 ns; modules with level shifters do not come near it */
};
