#include "stack.h"

#define PAINT 0xA5u

extern const uint8_t stack_bottom[], stack_top[]; /* link.ld */

uint16_t uno_stack_unused(void) {
    uint16_t count = 0;

    while (stack_bottom + count < stack_top && stack_bottom[count] == PAINT) {
        count++;
    }
    return count;
}
