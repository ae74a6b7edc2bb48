#include "bus.h"

#include <errno.h>
#include <time.h>

#define READ_CLOCK_HZ 2000000u /* panels answer slower than they listen: 150 ns a bit (ILI9341, 18.3.4); wires add to it */
#define COMMAND_MAX_BYTES 64u

static int set_dc(tuile_linux_t *port, bool level) {
    int result;

    if (port->dc_level == level) { return TUILE_HAL_OK; }
    port->dc_level = -1;
    if ((result = tuile_linux_line_set(&port->dc, level, &port->fault))) { return result; }
    port->dc_level = level;
    return TUILE_HAL_OK;
}

static int bus_clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    tuile_linux_t *port = context;

    port->command_clock_hz = command_clock_hz; /* the kernel rounds down to what the controller can do */
    port->pixel_clock_hz = pixel_clock_hz;
    return TUILE_HAL_OK;
}

/* One transaction but for chip select, which spidev lets go where D/C changes; panels do not mind it between bytes. */
static int bus_command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    tuile_linux_t *port = context;
    int result;

    if (low_count == 0 || low_count > size_bytes || size_bytes > COMMAND_MAX_BYTES) { return TUILE_HAL_ARGUMENT; }
    if ((result = set_dc(port, false)) ||
        (result = tuile_linux_spi_write(&port->spi, bytes, low_count, port->command_clock_hz, &port->fault)) ||
        size_bytes == low_count || (result = set_dc(port, true))) {
        return result;
    }
    return tuile_linux_spi_write(&port->spi, bytes + low_count, size_bytes - low_count, port->command_clock_hz, &port->fault);
}

/* On the thread, or on the caller's where there is none. */
static int send_data(void *context, const uint8_t *bytes, size_t size_bytes) {
    tuile_linux_t *port = context;
    const int result = set_dc(port, true);

    return result ? result : tuile_linux_spi_write(&port->spi, bytes, size_bytes, port->pixel_clock_hz, &port->fault);
}

static int bus_data(void *context, const uint8_t *bytes, size_t size_bytes) {
    tuile_linux_t *port = context;

    tuile_linux_worker_give(&port->worker, bytes, size_bytes);
    return TUILE_HAL_OK;
}

static int bus_wait(void *context) { return tuile_linux_worker_wait(&((tuile_linux_t *)context)->worker); }

/* Before the answer stands: one clock for the identification of 04h and the status of 09h, one byte for ID4, D3h (ILI9341, 8.2.3,
 * 8.2.4, 8.3.23). D/C stays low, as it cannot change while chip select is held; nobody looks at it then. */
static int bus_read(void *context, uint8_t command, uint8_t *bytes, size_t size_bytes) {
    tuile_linux_t *port = context;
    const size_t dummy_bits = command == 0xD3 ? 8 : command == 0x04 || command == 0x09 ? 1 : 0;
    const size_t raw_bytes = size_bytes + (dummy_bits > 0);
    uint8_t raw[TUILE_LINUX_SPI_READ_BYTES + 1] = {0};
    uint32_t clock_hz = port->command_clock_hz;
    int result;

    if (size_bytes == 0 || raw_bytes > TUILE_LINUX_SPI_READ_BYTES) { return TUILE_HAL_ARGUMENT; }
    if (clock_hz == 0 || clock_hz > READ_CLOCK_HZ) { clock_hz = READ_CLOCK_HZ; }
    if ((result = set_dc(port, false)) ||
        (result = tuile_linux_spi_read(&port->spi, command, raw, raw_bytes, clock_hz, &port->fault))) {
        return result;
    }
    for (size_t i = 0; i < size_bytes; i++) {
        bytes[i] = (uint8_t)((raw[i] << 8 | raw[i + 1]) >> (8 - dummy_bits));
    }
    return TUILE_HAL_OK;
}

static int bus_delay_ms(void *context, uint32_t delay_ms) {
    struct timespec until;

    (void)context;
    (void)clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_sec += (time_t)(delay_ms / 1000u);
    until.tv_nsec += (long)(delay_ms % 1000u) * 1000000L;
    if (until.tv_nsec >= 1000000000L) {
        until.tv_nsec -= 1000000000L;
        until.tv_sec++;
    }
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) == EINTR) {}
    return TUILE_HAL_OK;
}

static int bus_pin(void *context, tuile_pin_t pin, uint8_t level) {
    tuile_linux_t *port = context;

    return tuile_linux_line_set(pin == TUILE_PIN_RESET ? &port->reset : &port->backlight, level != 0, &port->fault);
}

static int bus_tearing(void *context, uint32_t timeout_ms) {
    tuile_linux_t *port = context;

    return tuile_linux_line_edge(&port->tearing, timeout_ms, &port->fault);
}

static int open_lines(tuile_linux_t *port, const tuile_linux_config_t *config) {
    const char *consumer = config->consumer ? config->consumer : "tuile";
    const struct {
        const tuile_linux_line_t *line;
        tuile_linux_request_t *request;
        tuile_linux_use_t use;
        const char *name;
    } lines[] = {
        {&config->dc, &port->dc, TUILE_LINUX_OUTPUT_1, "dc"},
        {&config->reset, &port->reset, TUILE_LINUX_OUTPUT_1, "reset"},
        {&config->backlight, &port->backlight, TUILE_LINUX_OUTPUT_0, "backlight"},
        {&config->tearing, &port->tearing, TUILE_LINUX_EDGES, "tearing"},
    };

    if (!config->dc.chip) { return tuile_linux_say(&port->fault, TUILE_HAL_ARGUMENT, "dc: a panel on SPI needs this line"); }
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        int result;

        if (lines[i].line->chip && (result = tuile_linux_line_request(lines[i].request, lines[i].line, lines[i].use, lines[i].name,
                                                                      consumer, &port->fault))) {
            return result;
        }
    }
    port->dc_level = 1;
    return TUILE_HAL_OK;
}

static int open_all(tuile_linux_t *port, const tuile_linux_config_t *config) {
    int result, error;

    if (!config->spi) { return tuile_linux_say(&port->fault, TUILE_HAL_ARGUMENT, "spi: no device named"); }
    if ((result = tuile_linux_spi_open(&port->spi, config->spi, config->mode, &port->fault)) ||
        (result = open_lines(port, config))) {
        return result;
    }
    if (!config->no_worker && (error = tuile_linux_worker_start(&port->worker, send_data, port))) {
        return tuile_linux_fail(&port->fault, error, true, "thread");
    }
    return TUILE_HAL_OK;
}

int tuile_linux_open(tuile_linux_t *port, const tuile_linux_config_t *config) {
    int result;

    *port = (tuile_linux_t){.spi = {.fd = -1}, .dc_level = -1, .open = true};
    if ((result = open_all(port, config))) {
        tuile_linux_close(port);
        return result;
    }
    port->bus = (tuile_bus_t){
        .context = port,
        .clocks = bus_clocks,
        .command = bus_command,
        .data = config->no_worker ? send_data : bus_data,
        .wait = config->no_worker ? NULL : bus_wait,
        .read = bus_read,
        .delay_ms = bus_delay_ms,
        .pin = bus_pin,
        .tearing = config->tearing.chip ? bus_tearing : NULL,
        .pins = (config->reset.chip ? TUILE_PIN_BIT(TUILE_PIN_RESET) : 0) |
                (config->backlight.chip ? TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT) : 0),
    };
    return TUILE_HAL_OK;
}

void tuile_linux_close(tuile_linux_t *port) {
    if (!port->open) { return; }
    tuile_linux_worker_stop(&port->worker);
    tuile_linux_line_release(&port->tearing);
    tuile_linux_line_release(&port->backlight);
    tuile_linux_line_release(&port->reset);
    tuile_linux_line_release(&port->dc);
    tuile_linux_spi_close(&port->spi);
    port->bus = (tuile_bus_t){0};
    port->open = false;
}
