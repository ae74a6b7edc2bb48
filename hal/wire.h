/* How pixels lie on the wire: the formats that panels and USB displays take.
 *
 * A number is one more than the renderer's tuile_format_t of the same bytes, so that the frame loop needs no table: hal/ includes
 * nothing of raster/ but flash.h, which says where constants lie. Pixels of a window come row by row; where they are smaller than a byte, windows are aligned to whole bytes.
 */
#ifndef TUILE_HAL_WIRE_H
#define TUILE_HAL_WIRE_H

#include <stdint.h>

typedef enum tuile_wire {
    TUILE_WIRE_DEFAULT = 0,            /* the first that the panel or device names */
    TUILE_WIRE_RGB565 = 1,             /* 2 bytes, high byte first: RRRRRGGG GGGBBBBB */
    TUILE_WIRE_RGB565_LE = 2,          /* 2 bytes, low byte first */
    TUILE_WIRE_RGB444 = 4,             /* 2 pixels in 3 bytes: RRRRGGGG BBBBRRRR GGGGBBBB */
    TUILE_WIRE_RGB666 = 5,             /* 3 bytes: RRRRRR-- GGGGGG-- BBBBBB-- */
    TUILE_WIRE_RGB332 = 6,             /* 1 byte: RRRGGGBB */
    TUILE_WIRE_GREY8 = 7,              /* 1 byte */
    TUILE_WIRE_GREY4 = 8,              /* 2 pixels a byte, left one in the high half */
    TUILE_WIRE_MONO_PAGES = 9,         /* a byte is 8 pixels below one another, bit 0 on top; bytes run along the row */
    TUILE_WIRE_MONO_ROWS = 10,         /* a byte is 8 pixels beside one another, bit 7 left */
    TUILE_WIRE_MONO_PAGES_TURNED = 11, /* MONO_PAGES of the window with x and y exchanged */
    TUILE_WIRE_GREY4_TURNED = 12,      /* GREY4 of the window with x and y exchanged */
    TUILE_WIRE_RGB111 = 13,            /* 2 pixels a byte: --RGBRGB, left one in bits 5 to 3 */
    TUILE_WIRE_XRGB1111 = 14,          /* 2 pixels a byte: -RGB-RGB, left one in the high half */
    TUILE_WIRE_BGR888 = 15,            /* 3 bytes: blue, green, red */
    TUILE_WIRE_XRGB8888 = 16,          /* 4 bytes: blue, green, red, unused */
} tuile_wire_t;

#define TUILE_WIRE_COUNT 17

/* Bits of a pixel on the wire, filling included; 0 for numbers that name no format. */
unsigned tuile_wire_bits(unsigned wire);

#endif
