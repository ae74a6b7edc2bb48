/* ATmega328P: the registers that are used here, by the sections of its data sheet (DS40002061B). Addresses are those of data space;
 * "register summary" is section 36. */
#ifndef FIRMWARE_UNO_ATMEGA328P_H
#define FIRMWARE_UNO_ATMEGA328P_H

#include <stdint.h>

#define REGISTER8(address) (*(volatile uint8_t *)(address))
#define REGISTER16(address)                                                                               \
    (*(volatile uint16_t *)(address)) /* read low byte first, written high byte first (16.3): as gcc does \
                                       */

/* I/O ports (14.4) */
#define DDRB REGISTER8(0x24) /* 1: output */
#define PORTB REGISTER8(0x25)
#define PIND REGISTER8(0x29)
#define PORTD REGISTER8(0x2B) /* of an input: 1: pulled up */

/* Timer 1 (16.11) */
#define TIFR1 REGISTER8(0x36)
#define TIFR1_OCF1A 0x02 /* compare A met; cleared by writing 1 */
#define TCCR1A REGISTER8(0x80)
#define TCCR1B REGISTER8(0x81)
#define TCCR1B_CTC 0x08    /* count to OCR1A and begin again (16.9.2) */
#define TCCR1B_CLK_64 0x03 /* clock / 64 */
#define TCCR1B_CLK_1024 0x05
#define TCNT1 REGISTER16(0x84)
#define OCR1A REGISTER16(0x88)

/* General purpose I/O registers (8.5): nothing is behind them, so an emulator may listen. */
#define GPIOR0 REGISTER8(0x3E)
#define GPIOR1 REGISTER8(0x4A)
#define GPIOR2 REGISTER8(0x4B)

/* SPI (19.5) */
#define SPCR REGISTER8(0x4C)
#define SPCR_SPE 0x40  /* on */
#define SPCR_MSTR 0x10 /* master; falls back to slave when SS is an input and low (19.3.2) */
#define SPCR_CLK 0x03  /* SPR1, SPR0: clock / 4, 16, 64, 128 */
#define SPSR REGISTER8(0x4D)
#define SPSR_SPIF 0x80  /* a byte is out; cleared by reading it and then touching SPDR */
#define SPSR_SPI2X 0x01 /* twice as fast */
#define SPDR REGISTER8(0x4E)

/* Sleep (10.11) */
#define SMCR REGISTER8(0x53)
#define SMCR_POWER_DOWN 0x05 /* mode 2, and enabled */

#endif
