#include "bus.h"

static int template_clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    template_port_t *port = context;

    /* Round down to what the divider of the peripheral can make. */
    port->command_clock_hz = command_clock_hz;
    port->pixel_clock_hz = pixel_clock_hz;
    return TUILE_HAL_OK;
}

static int template_command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    (void)context, (void)bytes, (void)low_count, (void)size_bytes;
    /* Chip select; D/C low; bytes[0 ... low_count); wait until the last bit is out; D/C high; the rest; wait; deselect. */
    return TUILE_HAL_UNSUPPORTED;
}

static int template_data(void *context, const uint8_t *bytes, size_t size_bytes) {
    (void)context, (void)bytes, (void)size_bytes;
    /* Chip select; D/C high; start the DMA and return, or send all and leave wait out below. */
    return TUILE_HAL_UNSUPPORTED;
}

static int template_wait(void *context) {
    (void)context;
    /* Until the DMA has ended and the last bit is out; deselect. Report a fault of the transfer here. */
    return TUILE_HAL_OK;
}

static int template_delay_ms(void *context, uint32_t delay_ms) {
    (void)context, (void)delay_ms;
    return TUILE_HAL_OK;
}

static int template_pin(void *context, tuile_pin_t pin, uint8_t level) {
    (void)context, (void)pin, (void)level;
    return TUILE_HAL_OK;
}

int template_bus_open(tuile_bus_t *bus, template_port_t *port) {
    *port = (template_port_t){0};
    *bus = (tuile_bus_t){
        .context = port,
        .clocks = template_clocks,
        .command = template_command,
        .data = template_data,
        .wait = template_wait,
        .delay_ms = template_delay_ms,
        .pin = template_pin,
        .pins = TUILE_PIN_BIT(TUILE_PIN_RESET) | TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT),
    };
    return TUILE_HAL_OK;
}
