/* Clocks and resets of RP2040 and RP2350. */
#ifndef TUILE_FIRMWARE_RP2_CLOCKS_H
#define TUILE_FIRMWARE_RP2_CLOCKS_H

#include <stdint.h>

/* From the ring oscillator to the crystal: clk_sys and clk_peri run at CLK_SYS_HZ, and the timer counts microseconds. */
void clocks_open(void);

/* Brings subsystems (RESET_..., or-ed) into their state after power-up, and lets them go. */
void clocks_reset(uint32_t subsystems);

/* Sleeps for at least delay_ms, at most an hour. */
void clocks_delay_ms(uint32_t delay_ms);

/* Lets an interrupt in. */
void clocks_enable_irq(uint32_t irq);

/* Sleeps until *flag is set by an interrupt. */
void clocks_sleep_until(const volatile uint32_t *flag);

#endif
