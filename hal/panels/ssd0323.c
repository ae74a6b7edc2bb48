/* SSD0323 as data, for the OSRAM Pictiva glass of 128 x 64 (OS128064), whose makers' settings these are.
 *
 * Of what they send, B0h, B4h (compensation) and 23h (drawing) are left out: the first two are what a reset leaves, the third is of
 * no use here, and the SSD0323 that QEMU has on its lm3s6965evb does not know them. */
#include "ssd0323.h"

/* A line is a command. */
/* clang-format off */
static const TUILE_FLASH uint8_t init[] = {
    1, 0xAE,                                                 /* off: without a reset line the memory might be seen */
    2, 0xB3, 0x91,                                           /* clock: divided by 2 */
    2, 0xA8, 0x3F,                                           /* 64 commons */
    2, 0xA1, 0x00,                                           /* start line 0 */
    2, 0xAD, 0x02,                                           /* external voltage for the glass */
    1, 0x86,                                                 /* all of the current */
    9, 0xB8, 0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x76, /* greys: nearly linear */
    2, 0x81, 0x70,                                           /* contrast */
    2, 0xB2, 0x51,                                           /* clocks of a row */
    2, 0xB1, 0x55,                                           /* phases */
    2, 0xBC, 0x10,                                           /* pre-charge voltage */
    2, 0xBE, 0x1C,                                           /* VCOMH */
    2, 0xBF, 0x0F,                                           /* low voltage of the segments */
};
/* clang-format on */

/* A0h: 40h even commons from one side and odd ones from the other, 10h the scan runs from COM79 towards COM0, 01h columns from the
 * other end. Within a byte the upper half comes first with either 02h or 01h, as column remap leaves the order within a byte alone.
 * The reversed scan begins 16 commons beyond the glass, which a display offset (A2h) of 64 of the 80 makes good. */
static const TUILE_FLASH uint8_t turn_0[] = {2, 0xA0, 0x52, 2, 0xA2, 0x40};
static const TUILE_FLASH uint8_t turn_1[] = {2, 0xA0, 0x51, 2, 0xA2, 0x40};
static const TUILE_FLASH uint8_t turn_2[] = {2, 0xA0, 0x41, 2, 0xA2, 0x00};
static const TUILE_FLASH uint8_t turn_3[] = {2, 0xA0, 0x42, 2, 0xA2, 0x00};

static const TUILE_FLASH uint8_t on[] = {1, 0xAF};
static const TUILE_FLASH uint8_t sleep_sequence[] = {1, 0xAE};

const TUILE_FLASH tuile_panel_t tuile_ssd0323 = {
    .name = "ssd0323",
    .ram_width = 128,
    .ram_height = 64, /* of 80: the display offset goes with the scan direction, see above */
    .view_width = 128,
    .view_height = 64,
    .align_x = 2,
    .unit_x = 2,
    .parameters_low = 1,
    .addressing = TUILE_ADDRESS_8,
    .column_command = 0x15,
    .row_command = 0x75,
    .brightness_command = 0x81,
    .brightness_most = 0x70,
    .invert_command = {0xA4, 0xA7},
    .turn = {TUILE_SEQUENCE(turn_0), TUILE_SEQUENCE(turn_1), TUILE_SEQUENCE(turn_2), TUILE_SEQUENCE(turn_3)},
    .mode = {0, TUILE_EXCHANGE | TUILE_MIRROR_X, TUILE_MIRROR_X | TUILE_MIRROR_Y, TUILE_EXCHANGE | TUILE_MIRROR_Y},
    .fixed_axes = 1,
    .format_count = 1,
    .formats = {{TUILE_WIRE_GREY4, 0, TUILE_WIRE_GREY4_TURNED}},
    .reset_low_ms = 1,
    .reset_wait_ms = 10, /* time for the module's voltages */
    .init = TUILE_SEQUENCE(init),
    .on = TUILE_SEQUENCE(on),
    .sleep = TUILE_SEQUENCE(sleep_sequence),
    .command_clock_hz = 4000000,
    .pixel_clock_hz = 4000000,
    .rated_pixel_clock_hz = 4000000, /* a cycle of 250 ns */
};
