/* Bytes over spidev, the kernel's own interface to SPI (include/uapi/linux/spi/spidev.h). */
#ifndef TUILE_HAL_LINUX_SPI_H
#define TUILE_HAL_LINUX_SPI_H

#include <stddef.h>
#include <stdint.h>

#include "fault.h"

typedef struct tuile_linux_spi {
    int fd;               /* negative: not open */
    uint32_t chunk_bytes; /* of one transfer: the most that bufsiz allows, in whole pixels of 2 and 3 bytes */
    char path[96];
} tuile_linux_spi_t;

/* The kernel's bufsiz: no ioctl takes more bytes. 4096, the kernel's default, where it does not tell. */
uint32_t tuile_linux_spi_bufsiz(void);

/* mode: 0 ... 3. What else the device tree says of the device (chip select, three wires ...) stays; bits go out highest first.
 * After an error nothing is open. */
int tuile_linux_spi_open(tuile_linux_spi_t *spi, const char *path, uint8_t mode, tuile_linux_fault_t *fault);

/* Whether it could be opened; changes nothing. */
int tuile_linux_spi_probe(const char *path, tuile_linux_fault_t *fault);

void tuile_linux_spi_close(tuile_linux_spi_t *spi);

/* Any number of bytes, cut into chunks; chip select is let go between them. Returns when they are out. clock_hz 0: the device
 * tree's. Ends at the first chunk that fails, and tries nothing twice. */
int tuile_linux_spi_write(const tuile_linux_spi_t *spi, const uint8_t *bytes, size_t size_bytes, uint32_t clock_hz,
                          tuile_linux_fault_t *fault);

/* A byte out, then size_bytes in, with chip select held: at most TUILE_LINUX_SPI_READ_BYTES. */
#define TUILE_LINUX_SPI_READ_BYTES 16u
int tuile_linux_spi_read(const tuile_linux_spi_t *spi, uint8_t command, uint8_t *bytes, size_t size_bytes, uint32_t clock_hz,
                         tuile_linux_fault_t *fault);

#endif
