/* A panel as constant data: what its data sheet says, in a form that one driver can follow.
 *
 * GEOMETRY, the one formula for the four rotations. A controller has RAM for ram_width x ram_height pixels, the glass shows
 * view_width x view_height of them, and the first shown pixel is at (offset_x, offset_y) as the RAM is numbered without
 * mirroring. A mirrored axis numbers the RAM from its other end, hence
 *
 *     x = MX ? ram_width  - view_width  - offset_x : offset_x
 *     y = MY ? ram_height - view_height - offset_y : offset_y
 *
 * and under MV the column command takes rows: x and y, and width and height, change places. Everything that drivers hard-code
 * as tables of offsets per rotation follows from it.
 *
 * ROTATION r turns the picture by r quarter turns clockwise on the glass; turn the device the other way to read it upright.
 */
#ifndef TUILE_HAL_PANEL_H
#define TUILE_HAL_PANEL_H

#include <stddef.h>
#include <stdint.h>

/* Pixels as they are on the wire. */
typedef enum tuile_wire {
    TUILE_WIRE_RGB565 = 0, /* 2 bytes, high byte first: RRRRRGGG GGGBBBBB */
    TUILE_WIRE_RGB666 = 1, /* 3 bytes: RRRRRR-- GGGGGG-- BBBBBB-- */
} tuile_wire_t;

typedef struct tuile_panel_format {
    uint8_t wire;           /* tuile_wire_t */
    uint8_t bits_per_pixel; /* on the wire, filling bits included */
    uint8_t code;           /* parameter of format_command */
} tuile_panel_format_t;

#define TUILE_PANEL_FORMATS_MAX 4

/* A sequence of commands. Each record is a count n and then n bytes, of which the first is the command and the others are its
 * parameters. n = 0 is a pause: two more bytes, the milliseconds, high byte first. A command has at most 64 bytes. */
typedef struct tuile_sequence {
    const uint8_t *bytes;
    uint16_t size_bytes; /* 0: nothing to send */
} tuile_sequence_t;

#define TUILE_SEQUENCE_DELAY_MS(ms) 0, (uint8_t)((ms) >> 8), (uint8_t)((ms)&255)

/* Bits of an address mode (MADCTL), by their MIPI DCS values. */
#define TUILE_MADCTL_MY 0x80 /* rows are numbered from the other end */
#define TUILE_MADCTL_MX 0x40 /* columns are */
#define TUILE_MADCTL_MV 0x20 /* the column command takes rows and the other way round */
#define TUILE_MADCTL_BGR 0x08

typedef struct tuile_panel {
    const char *name;
    uint16_t ram_width, ram_height;   /* pixels the controller has memory for */
    uint16_t view_width, view_height; /* pixels the glass shows, at rotation 0 */
    uint16_t offset_x, offset_y;      /* of the first shown pixel in the RAM, unmirrored */

    uint8_t align_x, align_y;   /* windows begin and end at multiples of these along the RAM's x and y; 0 = 1 */
    uint8_t parameters_low;     /* 1: parameters go with D/C low like the command (SSD1306 ...); 0: high */
    uint8_t software_reset;     /* command that resets where no reset line is connected; 0 = there is none */
    uint8_t format_command;     /* sets the pixel format; 0 = there is only one */
    uint8_t rotation_command;   /* takes one byte: rotation_base | rotation[r] */
    uint8_t column_command;     /* first and last column, two bytes each, high byte first */
    uint8_t row_command;        /* first and last row, likewise */
    uint8_t write_command;      /* pixels follow */
    uint8_t brightness_command; /* takes one byte 0 ... 255; 0 = the panel has none, or its pin is not brought out */
    uint8_t rotation_base;      /* order of the colours: TUILE_MADCTL_BGR or 0 */
    uint8_t rotation[4];        /* TUILE_MADCTL_MY, _MX, _MV for a quarter turn each */
    uint8_t format_count;
    tuile_panel_format_t formats[TUILE_PANEL_FORMATS_MAX];

    uint16_t reset_low_ms;  /* the reset line is held this long */
    uint16_t reset_wait_ms; /* after either kind of reset, until the panel may be woken */

    tuile_sequence_t init;    /* from reset to awake; the display sends rotation and format after it */
    tuile_sequence_t on;      /* then: show the memory */
    tuile_sequence_t sleep;   /* stop showing, stop the voltages; left by a reset only */
    tuile_sequence_t tearing; /* switch the tearing-effect line on; sent only where it is wanted */

    uint32_t command_clock_hz;     /* for commands: slow enough for any wiring, since a glitch here spoils all that follows */
    uint32_t pixel_clock_hz;       /* for pixels, when the caller names none */
    uint32_t rated_pixel_clock_hz; /* what the data sheet promises */
} tuile_panel_t;

/* Where the view lies in the numbers that the column and row commands take. */
typedef struct tuile_panel_view {
    uint16_t x, y, width, height;
    uint8_t align_x, align_y; /* >= 1 */
} tuile_panel_view_t;

/* The formula above. rotation: 0 ... 3 (only the two low bits count). */
tuile_panel_view_t tuile_panel_view(const tuile_panel_t *panel, unsigned rotation);

#endif
