/* ILI9488 as data. Commands by their names in chapter 5 of the data sheet, V1.00.
 *
 * Gamma and voltages are the values that the makers of modules ship and that nearly every driver repeats. */
#include "ili9488.h"

/* A line is a command. */
/* clang-format off */
static const TUILE_FLASH uint8_t init[] = {
    16, 0xE0, 0x00, 0x03, 0x09, 0x08, 0x16, 0x0A, 0x3F, 0x78, 0x4C, 0x09, 0x0A, 0x08, 0x16, 0x1A, 0x0F, /* positive gamma */
    16, 0xE1, 0x00, 0x16, 0x19, 0x03, 0x0F, 0x05, 0x32, 0x45, 0x46, 0x04, 0x0E, 0x0D, 0x35, 0x37, 0x0F, /* negative gamma */
    3, 0xC0, 0x17, 0x15,           /* power control 1: VREG1OUT 5.0 V, VREG2OUT -4.75 V */
    2, 0xC1, 0x41,                 /* power control 2: VGH 6 x VCI, VGL -4 x VCI */
    4, 0xC5, 0x00, 0x12, 0x80,     /* VCOM control: by register, -1.71 V */
    2, 0xB0, 0x00,                 /* interface mode: answers on a line of their own */
    3, 0xB1, 0xA0, 0x11,           /* frame rate: 60 Hz, 17 clocks a line */
    2, 0xB4, 0x02,                 /* display inversion: 2 dots */
    4, 0xB6, 0x02, 0x02, 0x3B,     /* display function: memory by serial interface, scanned from S1 and G1 on, 480 lines */
    2, 0xB7, 0xC6,                 /* entry mode: normal display */
    5, 0xF7, 0xA9, 0x51, 0x2C, 0x82, /* adjust control 3, as it says it has to be */
    1, 0x11, TUILE_SEQUENCE_DELAY_MS(120), /* sleep out; 5 ms would do for a command, 120 for the picture */
};
/* clang-format on */

static const TUILE_FLASH uint8_t on[] = {1, 0x29};                                                    /* display on */
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0x28, 1, 0x10, TUILE_SEQUENCE_DELAY_MS(120)}; /* display off, sleep in */
static const TUILE_FLASH uint8_t tearing[] = {2, 0x35, 0x00};                                         /* vertical blank only */

/* The first column is at the right. */
#define MODES \
    { TUILE_MIRROR_X, TUILE_EXCHANGE, TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_X | TUILE_MIRROR_Y }

const TUILE_FLASH tuile_panel_t tuile_ili9488 = {
    .name = "ili9488",
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
    .formats = {{TUILE_WIRE_RGB666, 0x66, 0}, {TUILE_WIRE_RGB111, 0x61, 0}},
    .id_command = 0xD3,
    .id_count = 3,
    .id = {0x00, 0x94, 0x88},
    .reset_low_ms = 1,    /* 10 us are asked for */
    .reset_wait_ms = 120, /* 5 ms, but 120 before sleep out if it was awake, which nobody can know */
    .init = TUILE_SEQUENCE(init),
    .on = TUILE_SEQUENCE(on),
    .sleep = TUILE_SEQUENCE(sleep_sequence),
    .tearing = TUILE_SEQUENCE(tearing),
    .command_clock_hz = 10000000,
    .pixel_clock_hz = 27000000,
    .rated_pixel_clock_hz = 20000000, /* write cycle 50 ns (17.4.3); modules run at up to 40 MHz */
};
