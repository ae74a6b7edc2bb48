/* From reset to main on any Cortex-M, and what happens when something goes wrong. One source for v6-M, v7-M and v8-M: sections are
 * those of the Armv6-M Architecture Reference Manual (DDI 0419), whose registers the others have too.
 *
 * The linker script lays the stack out below all data, so that a stack that outgrows its room leaves RAM, which is a fault, before
 * it spoils anything; painted words at its end tell also where no fault comes. */
#include "../board/board.h"
#include "../board/semihosting.h"
#include "../board/stack.h"

#include <stdint.h>

extern uint32_t data_from_flash[], data_start[], data_end[], bss_start[], bss_end[];

int main(void);
void reset(void);
void hard_fault(void);
void fault_at(uint32_t *frame);
void unexpected(void);

typedef union vector {
    void *stack;
    void (*handler)(void);
} vector_t;

/* The vector table (B1.5.3): what a v6-M has no exception for stays free there. */
__attribute__((section(".vectors"), used)) static const vector_t vectors[16] = {
    {.stack = stack_top},           {.handler = reset}, {.handler = unexpected}, /* NMI */
    {.handler = hard_fault},                                                     /* all faults, as the others are not enabled */
    [11] = {.handler = unexpected},                                              /* SVCall */
    [14] = {.handler = unexpected},                                              /* PendSV */
    [15] = {.handler = unexpected},                                              /* SysTick, whose interrupt stays off */
};

static void copy_data(void) {
    const uint32_t *from = data_from_flash;

    for (uint32_t *to = data_start; (uintptr_t)to < (uintptr_t)data_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = bss_start; (uintptr_t)to < (uintptr_t)bss_end; to++) {
        *to = 0;
    }
}

void reset(void) {
#if defined(__ARM_FP)
    *(volatile uint32_t *)0xe000ed88u |= 0xf00000u; /* CPACR: full access to CP10 and CP11, the FPU (DDI 0403, B3.2.20) */
#endif
    stack_paint();
    copy_data();
    (void)main();
    board_park(BOARD_DONE);
}

/* Hands on where the registers r0 to r3, r12, lr, pc and psr were saved (B1.5.6). A jump, not a call: lr says how to return. */
__attribute__((naked)) void hard_fault(void) {
    __asm__ volatile("mov r0, sp\n"
                     "ldr r1, =fault_at\n"
                     "bx r1\n"
                     ".ltorg\n");
}

/* A request that nobody answers is a fault too: the program goes on behind its instruction, of two bytes, with the answer -1. After any
 * other fault the request is made from within this handler: unanswered, it locks the processor up, which stops it as well. */
__attribute__((used)) void fault_at(uint32_t *frame) {
    if (!semihosting_asking()) { board_park(BOARD_HARD_FAULT); }
    frame[0] = UINT32_MAX;
    frame[6] += 2u;
}

void unexpected(void) { board_park(BOARD_ASSERT); }
