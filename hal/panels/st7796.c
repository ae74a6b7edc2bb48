/* ST7796S as data. Commands by their names in the data sheet, V1.0: chapter 9.2 (table 1) and 9.3 (table 2).
 *
 * Gamma and voltages are the values that the makers of modules ship and that nearly every driver repeats. */
#include "st7796.h"

/* A line is a command. */
/* clang-format off */
static const TUILE_FLASH uint8_t init[] = {
    2, 0xF0, 0xC3,                 /* CSCON: table 2 is closed until both its parts are opened */
    2, 0xF0, 0x96,
    2, 0xB4, 0x01,                 /* DIC: the voltage changes sign with each dot */
    4, 0xB6, 0x80, 0x02, 0x3B,     /* DFC: memory by serial interface, scanned from S1 and G1 on, 480 lines */
    9, 0xE8, 0x40, 0x8A, 0x00, 0x00, 0x29, 0x19, 0xA5, 0x33, /* DOCA: timing of sources and gates */
    2, 0xC1, 0x06,                 /* PWR2: GVDD 3.85 V above VCOM */
    2, 0xC2, 0xA7,                 /* PWR3: currents of source and gamma drivers */
    2, 0xC5, 0x18,                 /* VCMPCTL: VCOM 0.9 V */
    15, 0xE0, 0xF0, 0x09, 0x0B, 0x06, 0x04, 0x15, 0x2F, 0x54, 0x42, 0x3C, 0x17, 0x14, 0x18, 0x1B, /* PGC */
    15, 0xE1, 0xE0, 0x09, 0x0B, 0x06, 0x04, 0x03, 0x2B, 0x43, 0x42, 0x3B, 0x16, 0x14, 0x17, 0x1B, /* NGC */
    2, 0xF0, 0x3C,                 /* CSCON: closed again, lest a glitch reach them */
    2, 0xF0, 0x69,
    1, 0x11, TUILE_SEQUENCE_DELAY_MS(120), /* SLPOUT; 5 ms would do for a command, 120 for the picture */
};
/* clang-format on */

static const TUILE_FLASH uint8_t on[] = {1, 0x29};                                                    /* DISPON */
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0x28, 1, 0x10, TUILE_SEQUENCE_DELAY_MS(120)}; /* DISPOFF, SLPIN */
static const TUILE_FLASH uint8_t tearing[] = {2, 0x35, 0x00}; /* TEON, vertical blank only */

/* The first column is at the right. */
#define MODES \
    { TUILE_MIRROR_X, TUILE_EXCHANGE, TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_X | TUILE_MIRROR_Y }

const TUILE_FLASH tuile_panel_t tuile_st7796 = {
    .name = "st7796",
    .ram_width = 320,
    .ram_height = 480,
    .view_width = 320,
    .view_height = 480,
    .software_reset = 0x01,
    .format_command = 0x3A,
    .rotation_command = 0x36,
    .column_command = 0x2A,
    .row_command = 0x2B,
    .write_command = 0x2C,
    .invert_command = {0x20, 0x21},
    .rotation_base = TUILE_MADCTL_BGR,
    .order_bit = TUILE_MADCTL_BGR,
    .rotation = MODES,
    .mode = MODES,
    .format_count = 2,
    .formats = {{TUILE_WIRE_RGB565, 0x55, 0}, {TUILE_WIRE_RGB666, 0x66, 0}},
    .id_command = 0xD3,
    .id_count = 3,
    .id = {0x00, 0x77, 0x96},
    .reset_low_ms = 1,    /* 10 us are asked for */
    .reset_wait_ms = 120, /* 5 ms, but 120 before sleep out if it was awake, which nobody can know */
    .init = TUILE_SEQUENCE(init),
    .on = TUILE_SEQUENCE(on),
    .sleep = TUILE_SEQUENCE(sleep_sequence),
    .tearing = TUILE_SEQUENCE(tearing),
    .command_clock_hz = 10000000,
    .pixel_clock_hz = 40000000,
    .rated_pixel_clock_hz = 15151515, /* write cycle 66 ns; modules run at up to 80 MHz */
};
