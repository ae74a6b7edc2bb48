/* A bus (hal/bus.h) on the SPI of an ATmega328P at 16 MHz: bytes are polled, and out when a call returns.
 *
 *     Arduino Uno   port   panel
 *     13            PB5    clock
 *     11            PB3    data
 *     10            PB2    chip select, low while a transaction lasts
 *      9            PB1    D/C
 *      8            PB0    reset
 */
#ifndef FIRMWARE_UNO_SPI_H
#define FIRMWARE_UNO_SPI_H

#include "../../raster/flash.h"
#include "../../hal/bus.h"

#define UNO_CLOCK_HZ 16000000UL

typedef struct uno_spi {
    uint8_t command_clock, pixel_clock; /* SPR1, SPR0 and, as bit 7, SPI2X */
} uno_spi_t;

/* Sets up pins, SPI and the timer of delay_ms. bus->context is spi, which outlives it. Clocks are 16 MHz / 2 ... 128. */
void uno_spi_open(tuile_bus_t *bus, uno_spi_t *spi);

#endif
