/* A picture that is drawn on a display of any USB wire format, and looked at in the model of the device. */
#ifndef TESTS_SUPPORT_USB_CARD_H
#define TESTS_SUPPORT_USB_CARD_H

#include <stdint.h>

#include "../../hal/display.h"
#include "../../sim/usb/usb_model.h"

typedef enum usb_card_kind { USB_CARD_NOISE, USB_CARD_FLAT } usb_card_kind_t;

/* How it is drawn. Zero = default. */
typedef struct usb_card_way {
    usb_card_kind_t kind;
    uint32_t seed;                    /* another picture for each */
    uint32_t tile_width, tile_height; /* of the windows; 0: the whole display */
    uint32_t piece_pixels;            /* each window is written in pieces of so many; 0: at once. Whole bytes */
} usb_card_way_t;

/* A pixel's number in the wire format, of as many bits as tell colours there. */
uint32_t usb_card_value(uint8_t wire, const usb_card_way_t *way, uint32_t x, uint32_t y);

/* What 8 bits of red, green, blue that is. */
void usb_card_colour(uint8_t wire, uint32_t value, uint8_t rgb[3]);

/* Puts a row of pixels beginning at (x, y). */
void usb_card_row(uint8_t wire, const usb_card_way_t *way, uint32_t x, uint32_t y, uint32_t width, uint8_t *to);

/* Draws it from two buffers by turns, each spoilt as soon as it may be, and presents it; ends at the first error, and returns it.
 */
int usb_card_draw(tuile_display_t *display, const usb_card_way_t *way);

/* Fails the test when the glass does not show it, turned clockwise by as many quarters as rotation says. */
void usb_card_check(const sim_usb_t *model, uint8_t wire, const usb_card_way_t *way, unsigned rotation);

/* Fails the test when the glass shows anything but black. */
void usb_card_check_dark(const sim_usb_t *model);

#endif
