/* Registers of the LM3S6965 that this board uses: Texas Instruments' data sheet, by the titles of its chapters; the SSI is Arm's
 * PL022 (Technical Reference Manual DDI 0194, chapter 3), the UART a PL011 (DDI 0183, chapter 3). */
#ifndef TUILE_FIRMWARE_LM3S6965_H
#define TUILE_FIRMWARE_LM3S6965_H

#include <stdint.h>

#define REGISTER(address) (*(volatile uint32_t *)(address))

/* System Control */
#define RCGC0 REGISTER(0x400fe100u) /* clocks: bit 3 watchdog */
#define RCGC1 REGISTER(0x400fe104u) /* clocks: bit 0 UART0, bit 4 SSI0 */
#define RCGC2 REGISTER(0x400fe108u) /* clocks: bit 0 port A, bit 2 port C, bit 3 port D, bit 5 port F */

/* General-Purpose Input/Outputs. The address of a data register carries a mask of the pins that are written, in bits 9 to 2. */
#define PORT_A 0x40004000u
#define PORT_C 0x40006000u
#define PORT_D 0x40007000u
#define PORT_F 0x40025000u
#define GPIO_DATA(port, pins) REGISTER((port) + ((uint32_t)(pins) << 2))
#define GPIO_DIR(port) REGISTER((port) + 0x400u)
#define GPIO_AFSEL(port) REGISTER((port) + 0x420u) /* the pin belongs to a peripheral */
#define GPIO_PUR(port) REGISTER((port) + 0x510u)   /* it is pulled up */
#define GPIO_DEN(port) REGISTER((port) + 0x51cu)   /* it is a digital pin */

/* Synchronous Serial Interface 0 (DDI 0194, 3.3.1 to 3.3.5) */
#define SSI0_CR0 REGISTER(0x40008000u)
#define SSI0_CR1 REGISTER(0x40008004u)
#define SSI0_DR REGISTER(0x40008008u)
#define SSI0_SR REGISTER(0x4000800cu)
#define SSI0_CPSR REGISTER(0x40008010u)
#define SSI_CR0_MODE_3_8_BITS 0xc7u
#define SSI_CR1_ENABLE 2u
#define SSI_SR_TNF 2u  /* the transmit FIFO has room */
#define SSI_SR_RNE 4u  /* the receive FIFO has something */
#define SSI_SR_BSY 16u /* a frame is on the wire, or one waits */

/* Universal Asynchronous Receiver/Transmitter 0 (DDI 0183, 3.3) */
#define UART0_DR REGISTER(0x4000c000u)
#define UART0_FR REGISTER(0x4000c018u)
#define UART0_IBRD REGISTER(0x4000c024u)
#define UART0_FBRD REGISTER(0x4000c028u)
#define UART0_LCRH REGISTER(0x4000c02cu)
#define UART0_CTL REGISTER(0x4000c030u)
#define UART_FR_RXFE 16u /* nothing has come */
#define UART_FR_TXFF 32u /* no room */
#define UART_LCRH_8N1_FIFO 0x70u
#define UART_CTL_ENABLE 0x301u

/* SysTick, of the core (DDI 0419, B3.3) */
#define SYST_CSR REGISTER(0xe000e010u)
#define SYST_RVR REGISTER(0xe000e014u)
#define SYST_CVR REGISTER(0xe000e018u)
#define SYST_CSR_ENABLE 1u
#define SYST_CSR_CORE 4u /* counts the core's clock */
#define SYST_CSR_COUNTFLAG 0x10000u

/* Watchdog Timer: counts down at the core's clock, and begins again; unless it is told to, it resets nothing. */
#define WDT_LOAD REGISTER(0x40000000u)
#define WDT_VALUE REGISTER(0x40000004u)
#define WDT_CTL REGISTER(0x40000008u)
#define WDT_CTL_INTEN 1u /* it counts; its interrupt is not let in */

/* After reset the core runs by the internal oscillator, which has 12 MHz to within 30 % (System Control, clock sources). */
#define CORE_HZ 12000000u
#define CORE_MOST_HZ 15600000u

#endif
