/* RP2350: addresses and bits that another chip has elsewhere. Numbers in brackets are sections of its data sheet. Included by
 * chip.h. */
#ifndef TUILE_FIRMWARE_RP2_RP2350_H
#define TUILE_FIRMWARE_RP2_RP2350_H

/* The address map (2.2). */
#define CLOCKS_BASE 0x40010000u
#define PSM_BASE 0x40018000u
#define RESETS_BASE 0x40020000u
#define IO_BANK0_BASE 0x40028000u
#define PADS_BANK0_BASE 0x40038000u
#define XOSC_BASE 0x40048000u
#define PLL_SYS_BASE 0x40050000u
#define UART0_BASE 0x40070000u
#define SPI0_BASE 0x40080000u
#define PWM_BASE 0x400a8000u
#define TIMER_BASE 0x400b0000u
#define TICKS_BASE 0x40108000u
#define DMA_BASE 0x50000000u

/* Subsystem resets (7.5.3). */
#define RESET_DMA (1u << 2)
#define RESET_IO_BANK0 (1u << 6)
#define RESET_PADS_BANK0 (1u << 9)
#define RESET_PLL_SYS (1u << 14)
#define RESET_PWM (1u << 16)
#define RESET_SPI0 (1u << 18)
#define RESET_TIMER (1u << 23)
#define RESET_UART0 (1u << 26)

/* 12 MHz * 125 = 1500 MHz, / 5 / 2 (8.6.3). */
#define CLK_SYS_HZ 150000000u
#define PLL_SYS_MULTIPLIER 125u
#define PLL_SYS_DIVIDERS (5u << 16 | 2u << 12)

/* Each timer has a tick of its own (8.5.1). */
#define TICK REGISTER(TICKS_BASE + 0x18u)
#define TICK_CYCLES REGISTER(TICKS_BASE + 0x1cu)
#define TIMER_INTR REGISTER(TIMER_BASE + 0x3cu)
#define TIMER_INTE REGISTER(TIMER_BASE + 0x40u)

#define SIO_OUT_SET REGISTER(0xd0000018u) /* (3.1.11) */
#define SIO_OUT_CLEAR REGISTER(0xd0000020u)
#define SIO_OE_SET REGISTER(0xd0000038u)

#define PAD_ISOLATED 0x100u /* (9.7) */

#define DMA_CTRL_CHAIN_TO(n) ((n) << 13) /* to itself: to nobody (12.6.10) */
#define DMA_CTRL_REQUEST(n) ((n) << 17)
#define DMA_REQUEST_SPI0_TX 24u /* (12.6.4.1) */

#define IRQ_TIMER_0 0u /* (3.2) */
#define IRQ_DMA_0 10u
#define IRQ_COUNT 52u

#define PSM_FORCE_OFF REGISTER(PSM_BASE + 0x4u)
#define PSM_CORE_1 (1u << 24) /* (7.4.4) */

#endif
