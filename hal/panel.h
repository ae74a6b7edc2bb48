/* A panel as constant data: what its data sheet says, in a form that one driver (panel.c) can follow. It stays in flash
 * (raster/flash.h).
 *
 * GEOMETRY, the one formula for the four rotations. A controller has RAM for ram_width x ram_height pixels, the glass shows
 * view_width x view_height of them, and the first shown pixel is at (offset_x, offset_y) as the RAM is numbered without
 * mirroring. A mirrored axis numbers the RAM from its other end, hence
 *
 *     x = mirror x ? ram_width  - view_width  - offset_x : offset_x
 *     y = mirror y ? ram_height - view_height - offset_y : offset_y
 *
 * and where rows and columns are exchanged, x and y, and width and height, change places. Everything that drivers hard-code as
 * tables of offsets per rotation follows from it.
 *
 * ROTATION r turns the picture by r quarter turns clockwise on the glass; turn the device the other way to read it upright.
 *
 * A module that differs from its data here (offsets, order of the colours, inversion) is served by a changed copy of the struct:
 * docs/troubleshooting.md says which field goes with which symptom.
 */
#ifndef TUILE_HAL_PANEL_H
#define TUILE_HAL_PANEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../raster/flash.h"
#include "bus.h"
#include "device.h"
#include "wire.h"

typedef struct tuile_panel_format {
    uint8_t wire;   /* tuile_wire_t */
    uint8_t code;   /* parameter of format_command */
    uint8_t turned; /* what the bytes are at a quarter turn, where the chip cannot exchange rows and columns; 0 = the same */
} tuile_panel_format_t;

#define TUILE_PANEL_FORMATS_MAX 4

/* A sequence of commands. Each record is a count n and then n bytes, of which the first is the command and the others are its
 * parameters. n = 0 is a pause: two more bytes, the milliseconds, high byte first. A command has at most 64 bytes. */
typedef struct tuile_sequence {
    const TUILE_FLASH uint8_t *bytes;
    uint16_t size_bytes; /* 0: nothing to send */
} tuile_sequence_t;

#define TUILE_SEQUENCE(array) \
    { (array), sizeof(array) }
#define TUILE_SEQUENCE_DELAY_MS(ms) 0, (uint8_t)((ms) >> 8), (uint8_t)((ms)&255)

/* How a rotation numbers the RAM; the values are MIPI DCS's bits of an address mode (MADCTL). */
#define TUILE_MIRROR_Y 0x80 /* rows are numbered from the other end */
#define TUILE_MIRROR_X 0x40 /* columns are */
#define TUILE_EXCHANGE 0x20 /* pixels run along columns */

#define TUILE_MADCTL_BGR 0x08

/* How a window is told. */
typedef enum tuile_addressing {
    TUILE_ADDRESS_16 = 0,   /* a command for columns and one for rows, each with first and last in two bytes, high byte first */
    TUILE_ADDRESS_8 = 1,    /* the same, in one byte each */
    TUILE_ADDRESS_PAGE = 2, /* no windows: for each page of 8 rows B0h | page, 10h | column / 16, column % 16 (SH1106) */
} tuile_addressing_t;

typedef struct tuile_panel {
    uint16_t ram_width, ram_height;   /* pixels the controller has memory for, or of these what it mirrors within (SSD13xx) */
    uint16_t view_width, view_height; /* pixels the glass shows, at rotation 0 */
    uint16_t offset_x, offset_y;      /* of the first shown pixel in the RAM, unmirrored */
    uint8_t round;                    /* 1: the glass is the circle in the view */

    uint8_t align_x, align_y;   /* windows begin and end at multiples of these along the RAM's x and y; 0 = 1 */
    uint8_t unit_x, unit_y;     /* pixels along x and y that one number of the column and row commands counts; 0 = 1 */
    uint8_t parameters_low;     /* 1: parameters go with D/C low like the command (SSD1306 ...); 0: high */
    uint8_t software_reset;     /* command that resets where no reset line is connected; 0 = there is none */
    uint8_t format_command;     /* sets the pixel format; 0 = there is only one */
    uint8_t addressing;         /* tuile_addressing_t */
    uint8_t column_command;     /* first and last column */
    uint8_t row_command;        /* first and last row */
    uint8_t write_command;      /* pixels follow; 0 = they follow the window without one */
    uint8_t row_first;          /* 1: an exchanged window wants a row command ahead of the other two (GC9A01) */
    uint8_t brightness_command; /* takes one byte; 0 = the panel has none, or its pin is not brought out */
    uint8_t brightness_most;    /* that byte at full brightness; 0 = 255 */
    uint8_t inverted;           /* 1: the glass wants inverted colours, as IPS panels do */
    uint8_t invert_command[2];  /* without parameters: colours as they are, inverted; 0 = there is none */

    uint8_t rotation_command; /* takes one byte: rotation_base | rotation[r]; 0 = there is none, see turn */
    uint8_t rotation_base;    /* that byte's other bits */
    uint8_t order_bit;        /* the one of them that exchanges red and blue: TUILE_MADCTL_BGR; 0 = there is none */
    uint8_t rotation[4];      /* the bits for a quarter turn each */
    tuile_sequence_t turn[4]; /* or commands */
    uint8_t mode[4];          /* what either does: TUILE_MIRROR_X, _Y, TUILE_EXCHANGE */
    uint8_t fixed_axes;       /* 1: the column command takes columns even where rows and columns are exchanged */

    uint8_t format_count;
    tuile_panel_format_t formats[TUILE_PANEL_FORMATS_MAX]; /* the first is the default */

    uint8_t id_command; /* whose answer is `id`; 0 = nothing can be read */
    uint8_t id_count;   /* bytes of it, at most 3 */
    uint8_t id[3];

    uint16_t reset_low_ms;  /* the reset line is held this long */
    uint16_t reset_wait_ms; /* after either kind of reset, until the panel may be woken */

    tuile_sequence_t init;    /* from reset to awake; inversion, rotation and format are sent after it */
    tuile_sequence_t on;      /* show the memory: sent when the first frame is whole, since the memory holds noise before */
    tuile_sequence_t sleep;   /* stop showing, stop the voltages; left by a reset only */
    tuile_sequence_t tearing; /* switch the tearing-effect line on; sent only where it is wanted */

    uint32_t command_clock_hz;     /* for commands: slow enough for any wiring, since a glitch here spoils all that follows */
    uint32_t pixel_clock_hz;       /* for pixels, when the caller names none */
    uint32_t rated_pixel_clock_hz; /* what the data sheet promises */

    char name[24]; /* as `--panel` takes it: "st7789-240x240". In the struct, hence in flash as all of it; last, since what the
                      driver reads is then near its beginning, which is shorter code on many machines */
} tuile_panel_t;

/* Where the view lies in the RAM as it is numbered in this rotation, in pixels: the formula above. */
typedef struct tuile_panel_view {
    uint16_t x, y, width, height;
    uint8_t align_x, align_y; /* >= 1 */
} tuile_panel_view_t;

/* rotation: 0 ... 3 (only the two low bits count). */
tuile_panel_view_t tuile_panel_view(const TUILE_FLASH tuile_panel_t *panel, unsigned rotation);

/* The driver's state of one panel on one bus. All of it is the driver's own; it is part of tuile_display_t. */
typedef struct tuile_panel_state {
    const TUILE_FLASH tuile_panel_t *panel;
    const tuile_bus_t *bus;
    tuile_panel_view_t view;
    uint32_t command_clock_hz, pixel_clock_hz, tearing_timeout_ms;
    uint32_t page_bytes, page_left_bytes; /* PAGE addressing: of a page's part of the window; what is left of this page */
    uint16_t page_column;                 /* where each of them begins */
    uint8_t page;                         /* the next one */
    uint8_t rotation;
    uint8_t format_code;
    uint8_t unit_bytes; /* chunks are multiples of it */
    bool identify;
    bool in_frame; /* a window has been set since the last frame */
} tuile_panel_state_t;

/* The driver, for hal/display.c; its context is a tuile_panel_state_t. */
extern const TUILE_FLASH tuile_device_t tuile_panel_device;

#endif
