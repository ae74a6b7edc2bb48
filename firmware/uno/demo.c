/* The program to put on an Arduino Uno: the shows by turns, with the frames a second over them. A button between pin 2 and ground
 * shows the next one, which then stays; without it they change by themselves. */
#include "atmega328p.h"
#include "shows.h"

#define PIN_BUTTON 0x04 /* PD2 */

/* 3 columns by 5 dots each, the uppermost one in bit 1. */
static const TUILE_FLASH uint8_t digits[10][3] = {{0x3e, 0x22, 0x3e}, {0x24, 0x3e, 0x20}, {0x3a, 0x2a, 0x2e}, {0x2a, 0x2a, 0x3e},
                                                  {0x0e, 0x08, 0x3e}, {0x2e, 0x2a, 0x3a}, {0x3e, 0x2a, 0x3a}, {0x02, 0x02, 0x3e},
                                                  {0x3e, 0x2a, 0x3e}, {0x2e, 0x2a, 0x3e}};

/* Frames of each show: some five seconds. */
static const TUILE_FLASH uint8_t lasts[UNO_SHOWS] = {[UNO_CUBE_ZBUFFER] = 16, [UNO_ROOM_TREE] = 8, [UNO_CUBE_TREE] = 64};

static uint8_t rate; /* of the last frame, tenths a second */
static bool pressed; /* the button, since it was looked at */

/* Puts a digit, and returns the column behind its gap. */
static uint8_t *put(uint8_t *to, uint8_t digit) {
    const TUILE_FLASH uint8_t *from = digits[digit];

    for (uint8_t column = 3; column > 0; column--) {
        *to++ = *from++;
    }
    return to + 1;
}

/* The upper right corner is black, with "04.1" or "16.1" in it. Tiles come more often than frames, so the button is looked at here.
 * Division by loops: those of libgcc are longer. */
static void over(const tuile_tile_t *tile) {
    uint8_t *to = (uint8_t *)(uintptr_t)tile->bytes + tile->width;
    uint8_t tenths = rate, ones = 0, tens = 0;

    if (!(PIND & PIN_BUTTON)) { pressed = true; }
    if (tile->y || (uint8_t)(tile->x + tile->width) != 128) { return; }
    for (uint8_t column = 15; column > 0; column--) {
        *--to = 0;
    }
    for (; tenths >= 10; tenths = (uint8_t)(tenths - 10)) {
        if (++ones == 10) {
            ones = 0;
            tens++;
        }
    }
    to = put(put(to + 1, tens), ones);
    *to = 0x20; /* the point */
    (void)put(to + 2, tenths);
}

int main(void) {
    bool by_hand = false, held = false;

    uno_open();
    PORTD = PIN_BUTTON; /* pulled up */
    TCCR1B = TCCR1B_CLK_1024;
    for (uint8_t number = 0;; number = number + 1 < UNO_SHOWS ? (uint8_t)(number + 1) : 0) {
        bool next = false;

        uno_choose(number);
        for (uint8_t frame = 0; !next && (by_hand || frame < lasts[number]); frame++) {
            const uint16_t begins = TCNT1;

            pressed = false;
            uno_frame(number, frame % UNO_FRAMES, over);
            /* 15625 ticks a second, of which a frame takes 900 at least: 156250 / ticks, each a fourth. */
            rate = (uint8_t)(39062u / ((uint16_t)(TCNT1 - begins) >> 2));
            next = pressed && !held;
            held = pressed;
            by_hand |= next;
        }
    }
}
