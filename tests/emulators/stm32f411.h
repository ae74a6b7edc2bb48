/* Of an STM32F411, what the Black Pill's program uses (firmware/blackpill/), and the wires of its panel. Numbers in brackets are
 * sections of its reference manual, RM0383. What the manual forbids, or leaves without effect, is refused.
 *
 * Nothing takes time by itself: oscillators start, bytes leave SPI1 and timers count while registers are looked at, DMA moves data
 * when the core sleeps. */
#ifndef TESTS_EMULATORS_STM32F411_H
#define TESTS_EMULATORS_STM32F411_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct stm32f411 {
    char fault[256]; /* what was refused first; "" when nothing was */
    char line[128];  /* the last one that came whole by USART1 */
    uint64_t now_ns;

    FILE *trace; /* from here on: its own */
    bool (*memory)(void *context, uint32_t address, uint8_t *bytes, uint32_t size_bytes);
    void *context;

    uint32_t rcc_cr, rcc_pllcfgr, rcc_cfgr, ahb1, apb1, apb2, pwr_cr, flash_acr;
    uint32_t moder, ospeedr, pupdr, odr, afrl, afrh;
    uint32_t spi_cr1, spi_cr2;
    uint32_t dma_cr, dma_count, dma_peripheral, dma_memory, dma_flags;
    uint32_t usart_brr, usart_cr1;
    uint32_t tim_psc, tim_cr1;
    uint32_t systick_csr, systick_rvr, iser1;
    unsigned looks; /* at what is not ready */

    bool shifting, waiting; /* SPI1: a byte on the wire, one behind it */
    uint8_t shifted, next;
    bool shifted_data; /* the level of D/C when it began */
    uint32_t shifted_hz;

    uint8_t run[65536]; /* bytes of one transaction at one level of D/C */
    uint32_t run_bytes, run_hz;
    uint64_t run_ns;
    bool run_data;

    char text[128];
    uint32_t text_bytes;
    bool usart_busy;
} stm32f411_t;

/* As it is after reset, the panel's reset line, chip select and D/C not driven. memory reads RAM for the DMA. */
void stm32f411_open(stm32f411_t *chip, FILE *trace,
                    bool (*memory)(void *context, uint32_t address, uint8_t *bytes, uint32_t size_bytes), void *context);

uint32_t stm32f411_read(stm32f411_t *chip, uint32_t address, unsigned size_bytes);
void stm32f411_write(stm32f411_t *chip, uint32_t address, unsigned size_bytes, uint32_t value);

/* The core sleeps until something happens. */
void stm32f411_sleep(stm32f411_t *chip);

/* Is there a request that is let in, and which; its number in the table of 10.2. */
bool stm32f411_pending(const stm32f411_t *chip);
int stm32f411_irq(const stm32f411_t *chip);

/* Keeps the first message. */
__attribute__((format(printf, 2, 3))) void stm32f411_refuse(stm32f411_t *chip, const char *format, ...);

/* The end: writes what the trace still lacks. */
void stm32f411_close(stm32f411_t *chip);

#endif
