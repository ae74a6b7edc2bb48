#include "spi.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "../bus.h"

#define BUFSIZ_DEFAULT_BYTES 4096u
/* spidev counts each transfer rounded up to what DMA wants (ARCH_KMALLOC_MINALIGN): 128 bytes on arm64, no more elsewhere. */
#define TRANSFER_UNIT_BYTES 128u

uint32_t tuile_linux_spi_bufsiz(void) {
    FILE *file = fopen("/sys/module/spidev/parameters/bufsiz", "re");
    unsigned bytes = 0;

    if (!file) { return BUFSIZ_DEFAULT_BYTES; }
    if (fscanf(file, "%u", &bytes) != 1) { bytes = 0; }
    (void)fclose(file);
    return bytes ? bytes : BUFSIZ_DEFAULT_BYTES;
}

int tuile_linux_spi_probe(const char *path, tuile_linux_fault_t *fault) {
    const int fd = open(path, O_RDWR | O_CLOEXEC);
    uint32_t flags = 0;
    int result = TUILE_HAL_OK;

    if (fd < 0) { return tuile_linux_fail(fault, errno, true, "%s", path); }
    if (ioctl(fd, SPI_IOC_RD_MODE32, &flags) < 0) { result = tuile_linux_fail(fault, errno, true, "%s: mode", path); }
    (void)close(fd);
    return result;
}

static uint32_t chunk_of(uint32_t bufsiz) {
    const uint32_t usable = bufsiz < TRANSFER_UNIT_BYTES ? bufsiz : bufsiz - bufsiz % TRANSFER_UNIT_BYTES;

    return usable - usable % TUILE_CHUNK_LEAST_BYTES;
}

int tuile_linux_spi_open(tuile_linux_spi_t *spi, const char *path, uint8_t mode, tuile_linux_fault_t *fault) {
    const uint32_t bufsiz = tuile_linux_spi_bufsiz();
    uint32_t flags = 0;
    int error;

    *spi = (tuile_linux_spi_t){.fd = -1, .chunk_bytes = chunk_of(bufsiz)};
    if (strlen(path) >= sizeof spi->path || mode > 3) {
        return tuile_linux_say(fault, TUILE_HAL_ARGUMENT, "%s: %s", path, mode > 3 ? "SPI modes are 0 to 3" : "too long a name");
    }
    if (spi->chunk_bytes == 0) {
        return tuile_linux_say(fault, TUILE_HAL_SIZE, "%s: spidev's bufsiz is %u bytes, which holds no pixels", path, bufsiz);
    }
    (void)snprintf(spi->path, sizeof spi->path, "%s", path);
    spi->fd = open(path, O_RDWR | O_CLOEXEC);
    if (spi->fd < 0) { return tuile_linux_fail(fault, errno, true, "%s", path); }
    if (ioctl(spi->fd, SPI_IOC_RD_MODE32, &flags) >= 0) {
        flags = (flags & ~(uint32_t)(SPI_CPHA | SPI_CPOL | SPI_LSB_FIRST)) | mode;
        if (ioctl(spi->fd, SPI_IOC_WR_MODE32, &flags) >= 0) { return TUILE_HAL_OK; }
    }
    error = errno;
    tuile_linux_spi_close(spi);
    return tuile_linux_fail(fault, error, true, "%s: mode %u", path, mode);
}

void tuile_linux_spi_close(tuile_linux_spi_t *spi) {
    if (spi->fd >= 0) { (void)close(spi->fd); }
    spi->fd = -1;
}

/* The kernel answers with the bytes of all transfers. EINTR is a fault like any other: a driver that can be interrupted has
 * already put some of them on the wire. */
static int settle(const tuile_linux_spi_t *spi, int answer, size_t size_bytes, tuile_linux_fault_t *fault) {
    if (answer < 0) { return tuile_linux_fail(fault, errno, false, "%s: %zu bytes", spi->path, size_bytes); }
    if ((size_t)answer != size_bytes) {
        return tuile_linux_say(fault, TUILE_HAL_IO, "%s: %d of %zu bytes were sent", spi->path, answer, size_bytes);
    }
    return TUILE_HAL_OK;
}

int tuile_linux_spi_write(const tuile_linux_spi_t *spi, const uint8_t *bytes, size_t size_bytes, uint32_t clock_hz,
                          tuile_linux_fault_t *fault) {
    while (size_bytes > 0) {
        const uint32_t now = size_bytes < spi->chunk_bytes ? (uint32_t)size_bytes : spi->chunk_bytes;
        struct spi_ioc_transfer transfer = {.tx_buf = (uintptr_t)bytes, .len = now, .speed_hz = clock_hz, .bits_per_word = 8};
        const int result = settle(spi, ioctl(spi->fd, SPI_IOC_MESSAGE(1), &transfer), now, fault);

        if (result) { return result; }
        bytes += now;
        size_bytes -= now;
    }
    return TUILE_HAL_OK;
}

int tuile_linux_spi_read(const tuile_linux_spi_t *spi, uint8_t command, uint8_t *bytes, size_t size_bytes, uint32_t clock_hz,
                         tuile_linux_fault_t *fault) {
    struct spi_ioc_transfer transfers[2] = {
        {.tx_buf = (uintptr_t)&command, .len = 1, .speed_hz = clock_hz, .bits_per_word = 8},
        {.rx_buf = (uintptr_t)bytes, .len = (uint32_t)size_bytes, .speed_hz = clock_hz, .bits_per_word = 8},
    };

    return settle(spi, ioctl(spi->fd, SPI_IOC_MESSAGE(2), transfers), size_bytes + 1, fault);
}
