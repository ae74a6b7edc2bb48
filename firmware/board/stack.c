#include "stack.h"

#include "board.h"

size_t board_stack_room(void) { return (uintptr_t)stack_top - (uintptr_t)stack_bottom - STACK_GUARD_BYTES; }

size_t board_stack_used(void) {
    const uint32_t *at = stack_bottom;

    for (; at < stack_bottom + STACK_GUARD_BYTES / 4; at++) {
        if (*at != STACK_PAINT) { board_park(BOARD_STACK_GUARD); }
    }
    while ((uintptr_t)at < (uintptr_t)stack_top && *at == STACK_PAINT) {
        at++;
    }
    return (uintptr_t)stack_top - (uintptr_t)at;
}
