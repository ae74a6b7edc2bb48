/* The program that tests run on an Arduino Uno: every show, each of its frames once, and again. */
#include "shows.h"
#include "stack.h"

#define STACK_GUARD 65

int main(void) {
    uno_open();
    for (;;) {
        for (uint8_t number = 0; number < UNO_SHOWS; number++) {
            uno_choose(number);
            for (uint8_t frame = 0; frame < UNO_FRAMES; frame++) {
                uno_frame(number, frame, NULL);
            }
        }
        const uint16_t unused = uno_stack_unused();
        if (unused == 0) { uno_park(STACK_GUARD); }
        uno_tell(UNO_STACK, (uint8_t)unused, (uint8_t)(unused >> 8));
        uno_tell(UNO_ROUND, 0, 0);
    }
}
