/* SSD1351 as data. Numbers in brackets are sections of its data sheet, Rev 1.5; what has
 * none is in its table of commands (9).
 *
 * Its 262k colours come in three bytes with the six bits at the lower end, and are told by the command that also turns the picture:
 * they are left out. */
#include "ssd1351.h"

/* A line is a command. */
/* clang-format off */
#define INIT(rows)                                                                                  \
    2, 0xFD, 0x12,             /* unlock */                                                         \
    2, 0xFD, 0xB1,             /* and A2h, B1h, B3h, BBh, BEh, C1h, which a reset locks apart */   \
    1, 0xAE,                   /* off (10.1.10): without a reset line the memory might be seen */   \
    2, 0xB3, 0xF1,             /* clock: fastest, divided by 2 */                                   \
    2, 0xCA, (rows) - 1,       /* multiplex ratio */                                                \
    2, 0xA1, 0x00,             /* start line 0 (10.1.6) */                                          \
    2, 0xA2, 0x00,             /* no display offset: a reset leaves 96 (10.1.7) */                  \
    2, 0xB5, 0x00,             /* pins not used */                                                  \
    2, 0xAB, 0x01,             /* internal regulator (10.1.9) */                                    \
    2, 0xB1, 0x32,             /* phases: 5 clocks and 3 */                                         \
    4, 0xB4, 0xA0, 0xB5, 0x55, /* external low voltage of the segments */                           \
    2, 0xBB, 0x17,             /* pre-charge at 0.5 VCC */                                          \
    2, 0xBE, 0x05,             /* VCOMH 0.82 VCC */                                                 \
    4, 0xC1, 0xC8, 0x80, 0xC8, /* contrast of the three colours */                                  \
    2, 0xC7, 0x0F,             /* all of the current */                                             \
    2, 0xB6, 0x01              /* second pre-charge 1 clock */
/* clang-format on */

static const TUILE_FLASH uint8_t init_128[] = {INIT(128)};
static const TUILE_FLASH uint8_t init_96[] = {INIT(96)};

static const TUILE_FLASH uint8_t on[] = {1, 0xAF}; /* (10.1.10) */
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0xAE};

/* A0h (10.1.5): 65k colours, even commons from one side and odd ones from the other, red in the upper bits. */
#define REMAP_COLOURS 0x60
#define REMAP_SWAP 0x04
#define REMAP_DOWN 0x10    /* the scan runs towards COM0, which is at the bottom */
#define REMAP_LEFT 0x02    /* columns from the other end */
#define REMAP_COLUMNS 0x01 /* the pointer runs along the rows' numbers first: pixels come column by column */

/* The scan is reversed within the multiplex ratio, so the rows that mirroring goes by are those of the glass. */
/* clang-format off */
#define COMMON(rows, sequence)                                                                                              \
    .ram_width = 128,                                                                                                       \
    .ram_height = (rows),                                                                                                   \
    .view_width = 128,                                                                                                      \
    .view_height = (rows),                                                                                                  \
    .addressing = TUILE_ADDRESS_8,                                                                                          \
    .column_command = 0x15,     /* (10.1.1) */                                                                              \
    .row_command = 0x75,        /* (10.1.2) */                                                                              \
    .write_command = 0x5C,      /* (10.1.3) */                                                                              \
    .brightness_command = 0xC7, /* sixteenths of the current, one at least */                                               \
    .brightness_most = 0x0F,                                                                                                \
    .invert_command = {0xA6, 0xA7}, /* (10.1.8) */                                                                          \
    .rotation_command = 0xA0,                                                                                               \
    .rotation_base = REMAP_COLOURS | REMAP_SWAP,                                                                            \
    .order_bit = REMAP_SWAP,                                                                                                \
    .rotation = {REMAP_DOWN, REMAP_DOWN | REMAP_LEFT | REMAP_COLUMNS, REMAP_LEFT, REMAP_COLUMNS},                           \
    .mode = {0, TUILE_EXCHANGE | TUILE_MIRROR_X, TUILE_MIRROR_X | TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_Y},         \
    .fixed_axes = 1,                                                                                                        \
    .format_count = 1,                                                                                                      \
    .formats = {{TUILE_WIRE_RGB565, 0, 0}},                                                                                 \
    .reset_low_ms = 1,   /* 2 us are asked for (8.9) */                                                                     \
    .reset_wait_ms = 10, /* 2 us, and time for the module's voltages */                                                     \
    .init = TUILE_SEQUENCE(sequence),                                                                                       \
    .on = TUILE_SEQUENCE(on),                                                                                               \
    .sleep = TUILE_SEQUENCE(sleep_sequence),                                                                                \
    .command_clock_hz = 10000000,                                                                                           \
    .pixel_clock_hz = 20000000,                                                                                             \
    .rated_pixel_clock_hz = 20000000 /* a cycle of 50 ns (table 13-4) */
/* clang-format on */

const TUILE_FLASH tuile_panel_t tuile_ssd1351 = {.name = "ssd1351", COMMON(128, init_128)};
const TUILE_FLASH tuile_panel_t tuile_ssd1351_128x96 = {.name = "ssd1351-128x96", COMMON(96, init_96)};
