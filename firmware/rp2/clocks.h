/* Clocks and resets of RP2040 and RP2350. */
#ifndef TUILE_FIRMWARE_RP2_CLOCKS_H
#define TUILE_FIRMWARE_RP2_CLOCKS_H

#include <stdint.h>

/* Cores that draw: 2 with -DTUILE_CORES=2. */
#ifndef TUILE_CORES
#define TUILE_CORES 1
#endif

/* From the ring oscillator to the crystal: clk_sys and clk_peri run at CLK_SYS_HZ, and the timer counts microseconds. */
void clocks_open(void);

/* Brings subsystems (RESET_..., or-ed) into their state after power-up, and lets them go. */
void clocks_reset(uint32_t subsystems);

/* Sleeps for at least delay_ms, at most an hour. */
void clocks_delay_ms(uint32_t delay_ms);

/* Lets an interrupt in. */
void clocks_enable_irq(uint32_t irq);

/* Around what an interrupt of this core must not come into. */
void clocks_hold_irqs(void);
void clocks_release_irqs(void);

/* Sleeps until *flag is set by clocks_wake in an interrupt. With TUILE_CORES=2 either core may, and interrupts are the first one's.
 */
void clocks_sleep_until(const volatile uint32_t *flag);
void clocks_wake(volatile uint32_t *flag);

#endif
