/* ST7735R as data; the ST7735S takes the same. Commands by their names in chapter 10 of the data sheets.
 *
 * Frame rate, power and gamma are the values that the makers of modules ship and that nearly every driver repeats. */
#include "st7735.h"

/* A line is a command. */
/* clang-format off */
static const TUILE_FLASH uint8_t init[] = {
    4, 0xB1, 0x01, 0x2C, 0x2D,     /* FRMCTR1: normal mode, about 80 Hz */
    4, 0xB2, 0x01, 0x2C, 0x2D,     /* FRMCTR2: idle mode */
    7, 0xB3, 0x01, 0x2C, 0x2D, 0x01, 0x2C, 0x2D, /* FRMCTR3: partial mode, dot and line inversion */
    2, 0xB4, 0x07,                 /* INVCTR: the voltage changes sign with the column */
    4, 0xC0, 0xA2, 0x02, 0x84,     /* PWCTR1: GVDD 4.6 V, GVCL -4.6 V */
    2, 0xC1, 0xC5,                 /* PWCTR2: VGH, VGL from 3 x AVDD */
    3, 0xC2, 0x0A, 0x00,           /* PWCTR3: amplifiers in normal mode */
    3, 0xC3, 0x8A, 0x2A,           /* PWCTR4: in idle mode */
    3, 0xC4, 0x8A, 0xEE,           /* PWCTR5: in partial mode */
    2, 0xC5, 0x0E,                 /* VMCTR1: VCOM -0.775 V */
    17, 0xE0, 0x02, 0x1C, 0x07, 0x12, 0x37, 0x32, 0x29, 0x2D, 0x29, 0x25, 0x2B, 0x39, 0x00, 0x01, 0x03, 0x10, /* GMCTRP1 */
    17, 0xE1, 0x03, 0x1D, 0x07, 0x06, 0x2E, 0x2C, 0x29, 0x2D, 0x2E, 0x2E, 0x37, 0x3F, 0x00, 0x00, 0x02, 0x10, /* GMCTRN1 */
    1, 0x11, TUILE_SEQUENCE_DELAY_MS(120), /* SLPOUT: no command before 120 ms */
    1, 0x13,                       /* NORON */
};
/* clang-format on */

static const TUILE_FLASH uint8_t on[] = {1, 0x29};                                                    /* DISPON */
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0x28, 1, 0x10, TUILE_SEQUENCE_DELAY_MS(120)}; /* DISPOFF, SLPIN */
static const TUILE_FLASH uint8_t tearing[] = {2, 0x35, 0x00}; /* TEON, vertical blank only */

/* The glass lies with the first column and row at its lower right. */
#define MODES \
    { TUILE_MIRROR_X | TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_Y, 0, TUILE_EXCHANGE | TUILE_MIRROR_X }

/* One initialiser. */
/* clang-format off */
#define ST7735(columns, rows, width, height, x, y)                                                              \
    .ram_width = (columns), .ram_height = (rows),                                                               \
    .view_width = (width), .view_height = (height), .offset_x = (x), .offset_y = (y),                           \
    .software_reset = 0x01,                                                                                     \
    .format_command = 0x3A,   /* COLMOD */                                                                      \
    .rotation_command = 0x36, /* MADCTL */                                                                      \
    .column_command = 0x2A, .row_command = 0x2B, .write_command = 0x2C,                                         \
    .invert_command = {0x20, 0x21},                                                                             \
    .order_bit = TUILE_MADCTL_BGR, .rotation = MODES, .mode = MODES,                                            \
    .format_count = 3,                                                                                          \
    .formats = {{TUILE_WIRE_RGB565, 0x05, 0}, {TUILE_WIRE_RGB444, 0x03, 0}, {TUILE_WIRE_RGB666, 0x06, 0}},      \
    .id_command = 0,      /* R and S answer differently to RDDID, and modules leave the line open */            \
    .reset_low_ms = 1,    /* 10 us are asked for */                                                             \
    .reset_wait_ms = 120, /* before any command */                                                              \
    .init = TUILE_SEQUENCE(init), .on = TUILE_SEQUENCE(on),                                                     \
    .sleep = TUILE_SEQUENCE(sleep_sequence), .tearing = TUILE_SEQUENCE(tearing),                                \
    .command_clock_hz = 10000000, .pixel_clock_hz = 27000000,                                                   \
    .rated_pixel_clock_hz = 15151515 /* write cycle 66 ns; modules run at up to 59 MHz */
/* clang-format on */

const TUILE_FLASH tuile_panel_t tuile_st7735_128x160 = {
    .name = "st7735-128x160", .rotation_base = TUILE_MADCTL_BGR, ST7735(128, 160, 128, 160, 0, 0)};
const TUILE_FLASH tuile_panel_t tuile_st7735_128x160_green = {
    .name = "st7735-128x160-green", .rotation_base = TUILE_MADCTL_BGR, ST7735(132, 162, 128, 160, 2, 1)};
const TUILE_FLASH tuile_panel_t tuile_st7735_128x128 = {
    .name = "st7735-128x128", .rotation_base = TUILE_MADCTL_BGR, ST7735(132, 132, 128, 128, 2, 1)};
const TUILE_FLASH tuile_panel_t tuile_st7735_80x160 = {
    .name = "st7735-80x160", .rotation_base = TUILE_MADCTL_BGR, .inverted = 1, ST7735(132, 162, 80, 160, 26, 1)};
const TUILE_FLASH tuile_panel_t tuile_st7735_80x160_0 = {.name = "st7735-80x160-0", ST7735(128, 160, 80, 160, 24, 0)};
