/* The painted stack: from the linker script's stack_bottom up to stack_top. */
#ifndef TUILE_FIRMWARE_STACK_H
#define TUILE_FIRMWARE_STACK_H

#include <stdint.h>

#define STACK_PAINT 0xc5c5c5c5u
#define STACK_GUARD_BYTES 32u /* the lowest ones must stay painted */

/* The linker script's. Where one ends and another begins only their addresses tell, so those are compared as numbers. */
extern uint32_t stack_bottom[], stack_top[];

/* Called by start-up code at the top of the empty stack: paints all that lies well below its caller's frame. */
static inline void stack_paint(void) {
    const uintptr_t end = (uintptr_t)__builtin_frame_address(0) - 64u;

    for (volatile uint32_t *at = stack_bottom; (uintptr_t)at < end; at++) {
        *at = STACK_PAINT;
    }
}

#endif
