/* The interrupts of RP2040 and RP2350, behind the exceptions of the core (firmware/cortex_m/start.c). */
#include "chip.h"

void rp2_dma_0(void);
void rp2_timer_0(void);

typedef void (*handler_t)(void);

/* The others are not let in. */
__attribute__((section(".vectors.interrupts"), used)) static const handler_t interrupts[IRQ_COUNT] = {
    [IRQ_TIMER_0] = rp2_timer_0,
    [IRQ_DMA_0] = rp2_dma_0,
};
