/* Faults on purpose. */
#include "../board/board.h"
#include "../board/stack.h"

void board_break(board_code_t code) {
    if (code == BOARD_STACK_GUARD) {
        /* Pushes until the whole room is used, guard and all, and takes it back. */
        __asm__ volatile("mov r4, sp\n"
                         "1: push {r0}\n"
                         "mov r1, sp\n"
                         "cmp r1, %0\n"
                         "bne 1b\n"
                         "mov sp, r4\n"
                         :
                         : "l"(stack_bottom)
                         : "r1", "r4", "memory", "cc");
    } else {
        __asm__ volatile("udf #0");
    }
}
