/* RP2040: addresses and bits that another chip has elsewhere. Numbers in brackets are sections of its data sheet. Included by
 * chip.h. */
#ifndef TUILE_FIRMWARE_RP2_RP2040_H
#define TUILE_FIRMWARE_RP2_RP2040_H

/* The address map (2.2). */
#define CLOCKS_BASE 0x40008000u
#define RESETS_BASE 0x4000c000u
#define PSM_BASE 0x40010000u
#define IO_BANK0_BASE 0x40014000u
#define PADS_BANK0_BASE 0x4001c000u
#define XOSC_BASE 0x40024000u
#define PLL_SYS_BASE 0x40028000u
#define UART0_BASE 0x40034000u
#define SPI0_BASE 0x4003c000u
#define PWM_BASE 0x40050000u
#define TIMER_BASE 0x40054000u
#define WATCHDOG_BASE 0x40058000u
#define DMA_BASE 0x50000000u

/* Subsystem resets (2.14.3). */
#define RESET_DMA (1u << 2)
#define RESET_IO_BANK0 (1u << 5)
#define RESET_PADS_BANK0 (1u << 8)
#define RESET_PLL_SYS (1u << 12)
#define RESET_PWM (1u << 14)
#define RESET_SPI0 (1u << 16)
#define RESET_TIMER (1u << 21)
#define RESET_UART0 (1u << 22)

/* 12 MHz * 125 = 1500 MHz, / 6 / 2 (2.18.2). */
#define CLK_SYS_HZ 125000000u
#define PLL_SYS_MULTIPLIER 125u
#define PLL_SYS_DIVIDERS (6u << 16 | 2u << 12)

/* The timer counts the watchdog's ticks (4.7.2). */
#define TICK REGISTER(WATCHDOG_BASE + 0x2cu)
#define TICK_EVERY(cycles) (1u << 9 | (cycles))
#define TIMER_INTR REGISTER(TIMER_BASE + 0x34u)
#define TIMER_INTE REGISTER(TIMER_BASE + 0x38u)

#define SIO_OUT_SET REGISTER(0xd0000014u) /* (2.3.1.7) */
#define SIO_OUT_CLEAR REGISTER(0xd0000018u)
#define SIO_OE_SET REGISTER(0xd0000024u)

#define PAD_ISOLATED 0u /* pads are not */

#define DMA_CTRL_CHAIN_TO(n) ((n) << 11) /* to itself: to nobody (2.5.7) */
#define DMA_CTRL_REQUEST(n) ((n) << 15)
#define DMA_REQUEST_SPI0_TX 16u /* (2.5.3.1) */

#define IRQ_TIMER_0 0u /* (2.3.2) */
#define IRQ_DMA_0 11u
#define IRQ_COUNT 32u

#define PSM_FORCE_OFF REGISTER(PSM_BASE + 0x4u)
#define PSM_CORE_1 (1u << 16) /* (2.13.5) */

#endif
