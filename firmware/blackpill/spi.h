/* SPI1 of the STM32F411 as a bus: commands are polled, data go by DMA2 while the core goes on, and it sleeps in wait(). */
#ifndef TUILE_FIRMWARE_BLACKPILL_SPI_H
#define TUILE_FIRMWARE_BLACKPILL_SPI_H

#include "../../hal/bus.h"

/* Pins of port A; all on one side of the board. */
#define SPI_PIN_BACKLIGHT 1u /* on or off */
#define SPI_PIN_RESET 2u     /* low resets */
#define SPI_PIN_DC 3u        /* high for data */
#define SPI_PIN_SELECT 4u    /* low selects the panel */
#define SPI_PIN_CLOCK 5u
#define SPI_PIN_DATA 7u

/* Opens the peripherals and fills in *bus. There is only one, so it has no context. */
void spi_open(tuile_bus_t *bus);

#endif
