/* From reset to main on RV32, and what happens when something goes wrong: machine mode, no interrupts. Privileged
 * Architecture 1.12, chapter 3.1. */
#include "../board/board.h"
#include "../board/semihosting.h"
#include "../board/stack.h"

#include <stdint.h>

extern uint32_t data_from_flash[], data_start[], data_end[], bss_start[], bss_end[];

int main(void);
_Noreturn void reset(void);
_Noreturn void trap(void);

/* The first instructions: a stack, and where traps go (mtvec, 3.1.7: 4-byte aligned, mode 0). */
__asm__(".section .start, \"ax\"\n"
        ".globl start\n"
        "start:\n"
        ".option push\n"
        ".option norelax\n"
        ".option arch, +zicsr\n"
        "la sp, stack_top\n"
        "la t0, trap\n"
        "csrw mtvec, t0\n"
        "j reset\n"
        ".option pop\n"
        ".text\n");

void reset(void) {
    const uint32_t *from = data_from_flash;

    stack_paint();
    for (uint32_t *to = data_start; (uintptr_t)to < (uintptr_t)data_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = bss_start; (uintptr_t)to < (uintptr_t)bss_end; to++) {
        *to = 0;
    }
    (void)main();
    board_park(BOARD_DONE);
}

/* A request that nobody answers is a trap too, and ends here for good. */
__attribute__((aligned(4))) void trap(void) {
    while (semihosting_asking()) {}
    board_park(BOARD_HARD_FAULT);
}

void board_break(board_code_t code) {
    if (code == BOARD_STACK_GUARD) {
        /* Pushes until the whole room is used, guard and all, and takes it back. */
        __asm__ volatile("mv t0, sp\n"
                         "1: addi sp, sp, -4\n"
                         "sw zero, 0(sp)\n"
                         "bne sp, %0, 1b\n"
                         "mv sp, t0\n"
                         :
                         : "r"(stack_bottom)
                         : "t0", "memory");
    } else {
        __asm__ volatile("unimp");
    }
}
