#include "clocks.h"

#include "chip.h"

void rp2_timer_0(void);

static volatile uint32_t alarm_rang;

void clocks_reset(uint32_t subsystems) {
    SET_BITS(RESETS_RESET) = subsystems;
    CLEAR_BITS(RESETS_RESET) = subsystems;
    while ((RESETS_DONE & subsystems) != subsystems) {}
}

/* Nothing may be fed from a PLL while it is set, so the reference goes to the crystal first. A glitchless multiplexer tells by one
 * bit what it has switched to. */
void clocks_open(void) {
    XOSC_STARTUP = (XOSC_HZ / 1000u + 128u) / 256u; /* a millisecond, counted in 256 periods */
    XOSC_CTRL = XOSC_CTRL_ENABLE_1_15MHZ;
    while (!(XOSC_STATUS & XOSC_STATUS_STABLE)) {}
    CLEAR_BITS(CLK_SYS_CTRL) = CLK_SYS_SRC_AUX;
    while (CLK_SYS_SELECTED != 1u) {}
    CLK_REF_CTRL = CLK_REF_SRC_XOSC;
    while (CLK_REF_SELECTED != 1u << CLK_REF_SRC_XOSC) {}

    clocks_reset(RESET_PLL_SYS);
    PLL_SYS_CS = 1; /* the crystal undivided */
    PLL_SYS_FBDIV = PLL_SYS_MULTIPLIER;
    CLEAR_BITS(PLL_SYS_PWR) = PLL_PWR_PD | PLL_PWR_VCOPD;
    while (!(PLL_SYS_CS & PLL_CS_LOCK)) {}
    PLL_SYS_PRIM = PLL_SYS_DIVIDERS;
    CLEAR_BITS(PLL_SYS_PWR) = PLL_PWR_POSTDIVPD;

    CLK_SYS_CTRL = CLK_SYS_SRC_AUX;
    while (CLK_SYS_SELECTED != 1u << CLK_SYS_SRC_AUX) {}
    CLK_PERI_CTRL = CLK_PERI_ENABLE;

#if defined(TICK_CYCLES)
    TICK_CYCLES = XOSC_HZ / 1000000u;
    TICK = 1;
#else
    TICK = TICK_EVERY(XOSC_HZ / 1000000u);
#endif
    clocks_reset(RESET_TIMER);
    TIMER_INTE = 1;
    clocks_enable_irq(IRQ_TIMER_0);
}

void clocks_enable_irq(uint32_t irq) { NVIC_ISER = 1u << irq; }

void clocks_hold_irqs(void) { __asm__ volatile("cpsid i" ::: "memory"); }

void clocks_release_irqs(void) { __asm__ volatile("cpsie i" ::: "memory"); }

#if TUILE_CORES > 1
/* Interrupts go to the first core. Either may wait for one: an event is kept until it is waited for, so none is missed. */
void clocks_sleep_until(const volatile uint32_t *flag) {
    while (!*flag) {
        __asm__ volatile("wfe" ::: "memory");
    }
}
#else
/* With interrupts held back, one that comes between the look at the flag and WFI still ends WFI; it is let in afterwards. */
void clocks_sleep_until(const volatile uint32_t *flag) {
    __asm__ volatile("cpsid i" ::: "memory");
    while (!*flag) {
        __asm__ volatile("wfi\n"
                         "cpsie i\n"
                         "isb\n"
                         "cpsid i" ::
                             : "memory");
    }
    __asm__ volatile("cpsie i" ::: "memory");
}
#endif

void clocks_wake(volatile uint32_t *flag) {
    *flag = 1;
    if (TUILE_CORES > 1) { __asm__ volatile("dmb\n sev" ::: "memory"); }
}

void rp2_timer_0(void) {
    TIMER_INTR = 1;
    clocks_wake(&alarm_rang);
}

/* One microsecond has begun already, hence one more. */
void clocks_delay_ms(uint32_t delay_ms) {
    if (delay_ms == 0) { return; }
    alarm_rang = 0;
    TIMER_ALARM0 = TIMER_RAWL + delay_ms * 1000u + 1u;
    clocks_sleep_until(&alarm_rang);
}
