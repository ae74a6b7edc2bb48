/* Which of the two chips is built for: their peripherals are the same, at other addresses. */
#ifndef TUILE_FIRMWARE_RP2_CHIP_H
#define TUILE_FIRMWARE_RP2_CHIP_H

#include <stdint.h>

#ifndef REGISTER /* tests have registers of their own */
#define REGISTER(address) (*(volatile uint32_t *)(address))
#endif

/* Every peripheral register but SIO's and the core's has three more addresses, at which a write flips, sets or clears bits. */
#define SET_BITS(reg) REGISTER((uintptr_t) & (reg) + 0x2000u)
#define CLEAR_BITS(reg) REGISTER((uintptr_t) & (reg) + 0x3000u)

#if defined(RP2350)
#include "rp2350.h"
#else
#include "rp2040.h"
#endif

/* What is the same in both. Offsets within a peripheral, from the bases of the chip's header. */
#define RESETS_RESET REGISTER(RESETS_BASE + 0x0u)
#define RESETS_DONE REGISTER(RESETS_BASE + 0x8u)

#define XOSC_CTRL REGISTER(XOSC_BASE + 0x0u)
#define XOSC_STATUS REGISTER(XOSC_BASE + 0x4u)
#define XOSC_STARTUP REGISTER(XOSC_BASE + 0xcu)
#define XOSC_HZ 12000000u
#define XOSC_CTRL_ENABLE_1_15MHZ (0xfabu << 12 | 0xaa0u)
#define XOSC_STATUS_STABLE 0x80000000u

#define PLL_SYS_CS REGISTER(PLL_SYS_BASE + 0x0u)
#define PLL_SYS_PWR REGISTER(PLL_SYS_BASE + 0x4u)
#define PLL_SYS_FBDIV REGISTER(PLL_SYS_BASE + 0x8u)
#define PLL_SYS_PRIM REGISTER(PLL_SYS_BASE + 0xcu)
#define PLL_CS_LOCK 0x80000000u
#define PLL_PWR_PD 0x01u
#define PLL_PWR_POSTDIVPD 0x08u
#define PLL_PWR_VCOPD 0x20u

#define CLK_REF_CTRL REGISTER(CLOCKS_BASE + 0x30u)
#define CLK_REF_SELECTED REGISTER(CLOCKS_BASE + 0x38u)
#define CLK_SYS_CTRL REGISTER(CLOCKS_BASE + 0x3cu)
#define CLK_SYS_SELECTED REGISTER(CLOCKS_BASE + 0x44u)
#define CLK_PERI_CTRL REGISTER(CLOCKS_BASE + 0x48u)
#define CLK_REF_SRC_XOSC 2u
#define CLK_SYS_SRC_AUX 1u     /* whose default is PLL_SYS */
#define CLK_PERI_ENABLE 0x800u /* from clk_sys */

/* In microseconds, by the chip's tick. */
#define TIMER_ALARM0 REGISTER(TIMER_BASE + 0x10u)
#define TIMER_RAWL REGISTER(TIMER_BASE + 0x28u)

#define GPIO_CTRL(pin) REGISTER(IO_BANK0_BASE + 8u * (pin) + 4u)
#define PAD(pin) REGISTER(PADS_BANK0_BASE + 4u * (pin) + 4u)
#define FUNCTION_SPI 1u
#define FUNCTION_UART 2u
#define FUNCTION_PWM 4u
#define FUNCTION_SIO 5u
#define PAD_IN 0x40u
#define PAD_8MA 0x20u
#define PAD_4MA 0x10u
#define PAD_PULL_UP 0x08u
#define PAD_SCHMITT 0x02u
#define PAD_FAST 0x01u

#define SIO_CPUID REGISTER(0xd0000000u)
#define SIO_IN REGISTER(0xd0000004u)
#define SIO_FIFO_ST REGISTER(0xd0000050u)
#define SIO_FIFO_WR REGISTER(0xd0000054u)
#define SIO_FIFO_RD REGISTER(0xd0000058u)
#define SIO_FIFO_ST_VLD 1u /* something to read */
#define SIO_FIFO_ST_RDY 2u /* room to write */

/* A PL022 (Arm DDI 0194, chapter 3). */
#define SPI0_CR0 REGISTER(SPI0_BASE + 0x0u)
#define SPI0_CR1 REGISTER(SPI0_BASE + 0x4u)
#define SPI0_DR REGISTER(SPI0_BASE + 0x8u)
#define SPI0_SR REGISTER(SPI0_BASE + 0xcu)
#define SPI0_CPSR REGISTER(SPI0_BASE + 0x10u)
#define SPI0_ICR REGISTER(SPI0_BASE + 0x20u)
#define SPI0_DMACR REGISTER(SPI0_BASE + 0x24u)
#define SPI_CR0_MODE_3_8_BITS 0xc7u
#define SPI_CR1_ENABLE 2u
#define SPI_SR_TNF 2u  /* the transmit FIFO has room */
#define SPI_SR_RNE 4u  /* the receive FIFO has something */
#define SPI_SR_BSY 16u /* a frame is on the wire, or one waits */
#define SPI_ICR_OVERRUN 1u
#define SPI_DMACR_TX 2u

#define DMA_READ_ADDR(n) REGISTER(DMA_BASE + 0x40u * (n) + 0x0u)
#define DMA_WRITE_ADDR(n) REGISTER(DMA_BASE + 0x40u * (n) + 0x4u)
#define DMA_COUNT(n) REGISTER(DMA_BASE + 0x40u * (n) + 0x8u)
#define DMA_CTRL_TRIGGER(n) REGISTER(DMA_BASE + 0x40u * (n) + 0xcu)
#define DMA_INTE0 REGISTER(DMA_BASE + 0x404u)
#define DMA_INTS0 REGISTER(DMA_BASE + 0x40cu)
#define DMA_CTRL_ENABLE 1u /* and bytes, the size 0 */
#define DMA_CTRL_READ_INCREMENTS 0x10u

/* Two pins a slice, A the even one. */
#define PWM_SLICE(pin) ((pin) / 2u % 8u)
#define PWM_CSR(slice) REGISTER(PWM_BASE + 0x14u * (slice) + 0x0u)
#define PWM_DIV(slice) REGISTER(PWM_BASE + 0x14u * (slice) + 0x4u)
#define PWM_CC(slice) REGISTER(PWM_BASE + 0x14u * (slice) + 0xcu)
#define PWM_TOP(slice) REGISTER(PWM_BASE + 0x14u * (slice) + 0x10u)

/* A PL011 (Arm DDI 0183, chapter 3). */
#define UART0_DR REGISTER(UART0_BASE + 0x00u)
#define UART0_FR REGISTER(UART0_BASE + 0x18u)
#define UART0_IBRD REGISTER(UART0_BASE + 0x24u)
#define UART0_FBRD REGISTER(UART0_BASE + 0x28u)
#define UART0_LCRH REGISTER(UART0_BASE + 0x2cu)
#define UART0_CTL REGISTER(UART0_BASE + 0x30u)
#define UART_FR_TXFF 32u
#define UART_LCRH_8N1_FIFO 0x70u
#define UART_CTL_ENABLE 0x301u

#define NVIC_ISER REGISTER(0xe000e100u) /* of the core (DDI 0419, B3.4) */

#endif
