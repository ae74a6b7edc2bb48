/* SSD1306 as data. Numbers in brackets are sections of its data sheet, Rev 1.1; the charge pump is in the application note at the
 * end of it.
 *
 * A byte is 8 rows of a column, and the chip cannot exchange rows and columns: at a quarter turn the bytes are those of the window
 * as the chip has it. Segment remap moves what is written after it and not what is there (10.1.8), the scan direction all of the
 * picture at once (10.1.14); both are set before the first pixel. */
#include "ssd1306.h"

/* A line is a command. */
/* clang-format off */
#define INIT(rows, wiring)                                                                                          \
    1, 0xAE,             /* off (10.1.12): without a reset line the memory might be seen */                         \
    2, 0xD5, 0x80,       /* clock: oscillator in the middle, not divided (10.1.16) */                               \
    2, 0xA8, (rows) - 1, /* multiplex ratio (10.1.11) */                                                            \
    2, 0xD3, 0x00,       /* no display offset (10.1.15) */                                                          \
    1, 0x40,             /* start line 0 (10.1.6) */                                                                \
    2, 0x8D, 0x14,       /* charge pump on: modules have no voltage of their own for the glass */                   \
    2, 0x20, 0x00,       /* horizontal addressing: columns, then pages (10.1.3) */                                  \
    2, 0xDA, (wiring),   /* 12h: even commons from one side, odd ones from the other; 02h: in sequence (10.1.18) */ \
    2, 0x81, 0xCF,       /* contrast (10.1.7) */                                                                    \
    2, 0xD9, 0xF1,       /* pre-charge: 1 clock and 15, what the pump wants (10.1.17) */                            \
    2, 0xDB, 0x40,       /* VCOMH: beyond the table of 10.1.19, as makers of modules have it */                     \
    1, 0xA4              /* what the memory holds, not all on (10.1.9) */
/* clang-format on */

static const TUILE_FLASH uint8_t init_64[] = {INIT(64, 0x12)};
static const TUILE_FLASH uint8_t init_32[] = {INIT(32, 0x02)};

/* Upright on the usual modules is column 0 at segment 127 and the scan towards COM0. */
#define LEFT_TO_RIGHT 1, 0xA1 /* (10.1.8) */
#define RIGHT_TO_LEFT 1, 0xA0
#define DOWN 1, 0xC8 /* (10.1.14) */
#define UP 1, 0xC0

static const TUILE_FLASH uint8_t turn_0[] = {LEFT_TO_RIGHT, DOWN};
static const TUILE_FLASH uint8_t turn_1[] = {RIGHT_TO_LEFT, DOWN};
static const TUILE_FLASH uint8_t turn_2[] = {RIGHT_TO_LEFT, UP};
static const TUILE_FLASH uint8_t turn_3[] = {LEFT_TO_RIGHT, UP};

static const TUILE_FLASH uint8_t on[] = {1, 0xAF};                            /* (10.1.12) */
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0xAE, 2, 0x8D, 0x10}; /* and the charge pump off */

/* The scan is reversed within the multiplex ratio, so the rows that mirroring goes by are those of the glass. */
/* clang-format off */
#define COMMON(rows, sequence)                                                                                              \
    .ram_width = 128,                                                                                                       \
    .ram_height = (rows),                                                                                                   \
    .view_width = 128,                                                                                                      \
    .view_height = (rows),                                                                                                  \
    .align_y = 8,                                                                                                           \
    .unit_y = 8,                                                                                                            \
    .parameters_low = 1,                                                                                                    \
    .addressing = TUILE_ADDRESS_8,                                                                                          \
    .column_command = 0x21, /* (10.1.4) */                                                                                  \
    .row_command = 0x22,    /* (10.1.5) */                                                                                  \
    .brightness_command = 0x81,                                                                                             \
    .brightness_most = 0xCF,                                                                                                \
    .invert_command = {0xA6, 0xA7}, /* (10.1.10) */                                                                         \
    .turn = {TUILE_SEQUENCE(turn_0), TUILE_SEQUENCE(turn_1), TUILE_SEQUENCE(turn_2), TUILE_SEQUENCE(turn_3)},               \
    .mode = {0, TUILE_EXCHANGE | TUILE_MIRROR_X, TUILE_MIRROR_X | TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_Y},         \
    .fixed_axes = 1,                                                                                                        \
    .format_count = 1,                                                                                                      \
    .formats = {{TUILE_WIRE_MONO_PAGES, 0, TUILE_WIRE_MONO_PAGES_TURNED}},                                                  \
    .reset_low_ms = 1,   /* 3 us are asked for (8.9) */                                                                     \
    .reset_wait_ms = 10, /* 3 us, and time for the module's voltages */                                                     \
    .init = TUILE_SEQUENCE(sequence),                                                                                       \
    .on = TUILE_SEQUENCE(on),                                                                                               \
    .sleep = TUILE_SEQUENCE(sleep_sequence),                                                                                \
    .command_clock_hz = 4000000,                                                                                            \
    .pixel_clock_hz = 8000000,                                                                                              \
    .rated_pixel_clock_hz = 10000000 /* a cycle of 100 ns (table 13-4) */
/* clang-format on */

const TUILE_FLASH tuile_panel_t tuile_ssd1306_128x64 = {.name = "ssd1306-128x64", COMMON(64, init_64)};
const TUILE_FLASH tuile_panel_t tuile_ssd1306_128x32 = {.name = "ssd1306-128x32", COMMON(32, init_32)};
