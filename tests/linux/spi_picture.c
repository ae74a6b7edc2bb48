/* Shows a picture on an ILI9341 by way of the kernel's own interfaces, spidev and the GPIO character device.
 * Usage: spi_picture /dev/spidevB.C /dev/gpiochipN PICTURE.ppm   (240 x 320) */
#include "../../hal/display.h"
#include "../../hal/panels/ili9341.h"
#include "../../sim/picture.h"

#include <fcntl.h>
#include <linux/gpio.h>
#include <linux/spi/spidev.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

enum { LINE_DC, LINE_RESET, LINE_BACKLIGHT };
#define CHUNK_BYTES 4096u /* spidev's buffer unless the kernel is told otherwise */

typedef struct link {
    int spi, lines;
} link_t;

static int set_line(const link_t *link, unsigned line, unsigned level) {
    struct gpio_v2_line_values values = {.bits = (uint64_t)level << line, .mask = UINT64_C(1) << line};

    return ioctl(link->lines, GPIO_V2_LINE_SET_VALUES_IOCTL, &values) ? TUILE_HAL_IO : TUILE_HAL_OK;
}

static int send_bytes(const link_t *link, unsigned dc, const uint8_t *bytes, size_t size_bytes) {
    struct spi_ioc_transfer transfer = {.tx_buf = (uintptr_t)bytes, .len = (uint32_t)size_bytes};
    const int result = set_line(link, LINE_DC, dc);

    if (result || size_bytes == 0) { return result; }
    return ioctl(link->spi, SPI_IOC_MESSAGE(1), &transfer) == (int)size_bytes ? TUILE_HAL_OK : TUILE_HAL_IO;
}

static int link_command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    const int result = send_bytes(context, 0, bytes, low_count);

    return result ? result : send_bytes(context, 1, bytes + low_count, size_bytes - low_count);
}

static int link_data(void *context, const uint8_t *bytes, size_t size_bytes) { return send_bytes(context, 1, bytes, size_bytes); }

static int link_pin(void *context, tuile_pin_t pin, uint8_t level) {
    return set_line(context, pin == TUILE_PIN_RESET ? LINE_RESET : LINE_BACKLIGHT, level > 0);
}

static int link_delay(void *context, uint32_t delay_ms) {
    struct timespec left = {.tv_sec = delay_ms / 1000, .tv_nsec = delay_ms % 1000 * 1000000L};

    (void)context;
    while (nanosleep(&left, &left) != 0) {}
    return TUILE_HAL_OK;
}

static int open_link(link_t *link, const char *spi, const char *chip) {
    struct gpio_v2_line_request request = {
        .offsets = {4, 5, 6}, .consumer = "spi_picture", .config = {.flags = GPIO_V2_LINE_FLAG_OUTPUT}, .num_lines = 3};
    const int chip_file = open(chip, O_RDWR | O_CLOEXEC);
    const uint8_t mode = SPI_MODE_0;

    link->spi = open(spi, O_RDWR | O_CLOEXEC);
    if (chip_file < 0 || link->spi < 0 || ioctl(link->spi, SPI_IOC_WR_MODE, &mode) ||
        ioctl(chip_file, GPIO_V2_GET_LINE_IOCTL, &request)) {
        return -1;
    }
    link->lines = request.fd;
    return close(chip_file);
}

static int show(tuile_display_t *display, const sim_picture_t *picture) {
    int result = tuile_display_window(display, 0, 0, picture->width, picture->height);

    for (uint32_t y = 0; !result && y < picture->height; y++) {
        uint8_t row[480];
        for (uint32_t x = 0; x < picture->width; x++) {
            const uint8_t *rgb = sim_picture_at(picture, x, y);
            row[2 * x] = (uint8_t)((rgb[0] & 0xF8) | rgb[1] >> 5);
            row[2 * x + 1] = (uint8_t)((rgb[1] << 3 & 0xE0) | rgb[2] >> 3);
        }
        result = tuile_display_write(display, row, 2 * picture->width);
    }
    return result ? result : tuile_display_present(display);
}

int main(int count, char **arguments) {
    link_t link;
    tuile_bus_t bus = {.context = &link,
                       .command = link_command,
                       .data = link_data,
                       .delay_ms = link_delay,
                       .pin = link_pin,
                       .max_chunk_bytes = CHUNK_BYTES,
                       .pins = TUILE_PIN_BIT(TUILE_PIN_RESET) | TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT)};
    tuile_display_t display;
    sim_picture_t picture;
    sim_error_t error;
    int result;

    if (count != 4) { return 2; }
    if (sim_picture_read(&picture, arguments[3], &error)) {
        (void)fprintf(stderr, "spi_picture: %s\n", error.text);
        return 1;
    }
    if (open_link(&link, arguments[1], arguments[2])) {
        perror("spi_picture");
        return 1;
    }
    result = tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341});
    if (!result) { result = show(&display, &picture); }
    if (!result) { result = tuile_display_sleep(&display); }
    sim_picture_free(&picture);
    if (result) { (void)fprintf(stderr, "spi_picture: error %d\n", result); }
    return result ? 1 : 0;
}
