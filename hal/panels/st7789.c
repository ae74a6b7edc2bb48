/* ST7789 as data. Commands by their names in the data sheet of the ST7789V, V1.0: chapter 9.1 (table 1) and 9.2 (table 2).
 *
 * Voltages and gamma are left as they are at reset: the makers of modules have burnt them in. */
#include "st7789.h"

/* A line is a command. */
/* clang-format off */
static const TUILE_FLASH uint8_t init[] = {
    1, 0x11, TUILE_SEQUENCE_DELAY_MS(120), /* SLPOUT; 5 ms would do for a command, 120 before it may sleep again */
    /* RAMCTRL: high byte first, and 12 and 16 bits become 18 by repeating the upper ones (EPF 0; 3 at reset) */
    3, 0xB0, 0x00, 0xC0,
    1, 0x13,                       /* NORON */
};
/* clang-format on */

static const TUILE_FLASH uint8_t on[] = {1, 0x29};                                                    /* DISPON */
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0x28, 1, 0x10, TUILE_SEQUENCE_DELAY_MS(120)}; /* DISPOFF, SLPIN */
static const TUILE_FLASH uint8_t tearing[] = {2, 0x35, 0x00}; /* TEON, vertical blank only */

#define MODES \
    { 0, TUILE_EXCHANGE | TUILE_MIRROR_X, TUILE_MIRROR_X | TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_Y }

/* One initialiser. */
/* clang-format off */
#define ST7789(width, height, x, y)                                                                             \
    .ram_width = 240, .ram_height = 320,                                                                        \
    .view_width = (width), .view_height = (height), .offset_x = (x), .offset_y = (y),                           \
    .software_reset = 0x01,                                                                                     \
    .format_command = 0x3A,   /* COLMOD */                                                                      \
    .rotation_command = 0x36, /* MADCTL */                                                                      \
    .column_command = 0x2A, .row_command = 0x2B, .write_command = 0x2C,                                         \
    .inverted = 1, .invert_command = {0x20, 0x21}, /* IPS */                                                    \
    .order_bit = TUILE_MADCTL_BGR, .rotation = MODES, .mode = MODES,                                            \
    .format_count = 3,                                                                                          \
    .formats = {{TUILE_WIRE_RGB565, 0x55, 0}, {TUILE_WIRE_RGB444, 0x53, 0}, {TUILE_WIRE_RGB666, 0x66, 0}},      \
    .id_command = 0x04, .id_count = 3, .id = {0x85, 0x85, 0x52}, /* RDDID */                                    \
    .reset_low_ms = 1,    /* 10 us are asked for */                                                             \
    .reset_wait_ms = 120, /* 5 ms, but 120 before sleep out if it was awake, which nobody can know */           \
    .init = TUILE_SEQUENCE(init), .on = TUILE_SEQUENCE(on),                                                     \
    .sleep = TUILE_SEQUENCE(sleep_sequence), .tearing = TUILE_SEQUENCE(tearing),                                \
    .command_clock_hz = 10000000, .pixel_clock_hz = 62500000,                                                   \
    .rated_pixel_clock_hz = 62500000 /* write cycle 16 ns; modules run at up to 85 MHz */
/* clang-format on */

const TUILE_FLASH tuile_panel_t tuile_st7789_240x320 = {.name = "st7789-240x320", ST7789(240, 320, 0, 0)};
const TUILE_FLASH tuile_panel_t tuile_st7789_240x240 = {.name = "st7789-240x240", ST7789(240, 240, 0, 0)};
const TUILE_FLASH tuile_panel_t tuile_st7789_135x240 = {.name = "st7789-135x240",
                                                        ST7789(135, 240, 52, 40)}; /* 53 from the other end */
const TUILE_FLASH tuile_panel_t tuile_st7789_170x320 = {.name = "st7789-170x320", ST7789(170, 320, 35, 0)};
const TUILE_FLASH tuile_panel_t tuile_st7789_172x320 = {.name = "st7789-172x320", ST7789(172, 320, 34, 0)};
const TUILE_FLASH tuile_panel_t tuile_st7789_240x280 = {.name = "st7789-240x280", ST7789(240, 280, 0, 20)};
