#include "ssi.h"

#include "../board/board.h"
#include "lm3s6965.h"

#define PIN_DC (1u << 7)     /* of port C: high for data */
#define PIN_SELECT (1u << 0) /* of port D: high selects the panel */
#define FIFO_FRAMES 8u

/* Returns when the last bit is out and the receive FIFO is empty: only then may D/C move. */
static void drain(void) {
    while (SSI0_SR & SSI_SR_BSY) {}
    while (SSI0_SR & SSI_SR_RNE) {
        (void)SSI0_DR;
    }
}

/* For each byte that goes out one comes in, and is taken out of the receive FIFO before it is full: QEMU's PL022 stops when it is,
 * a real one loses what comes. */
static void send(const uint8_t *bytes, size_t size_bytes) {
    size_t sent = 0, received = 0;

    while (received < size_bytes) {
        if (sent < size_bytes && sent - received < FIFO_FRAMES && (SSI0_SR & SSI_SR_TNF)) { SSI0_DR = bytes[sent++]; }
        if (SSI0_SR & SSI_SR_RNE) {
            (void)SSI0_DR;
            received++;
        }
    }
    drain();
}

/* PL022: the bit rate is the core's / (CPSDVSR * (1 + SCR)), CPSDVSR even; one clock for both, the slower of the two. */
static int clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    const uint32_t asked_hz = command_clock_hz < pixel_clock_hz ? command_clock_hz : pixel_clock_hz;
    uint32_t halves;

    (void)context;
    if (asked_hz == 0) { return TUILE_HAL_ARGUMENT; }
    halves = (CORE_MOST_HZ + 2u * asked_hz - 1u) / (2u * asked_hz);
    if (halves > 256) { return TUILE_HAL_ARGUMENT; }
    SSI0_CR1 = 0;
    SSI0_CPSR = 2;
    SSI0_CR0 = (halves - 1u) << 8 | SSI_CR0_MODE_3_8_BITS;
    SSI0_CR1 = SSI_CR1_ENABLE;
    return TUILE_HAL_OK;
}

static int command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    (void)context;
    BOARD_CHECK(low_count <= size_bytes);
    GPIO_DATA(PORT_C, PIN_DC) = 0;
    send(bytes, low_count);
    GPIO_DATA(PORT_C, PIN_DC) = PIN_DC;
    send(bytes + low_count, size_bytes - low_count);
    return TUILE_HAL_OK;
}

static int data(void *context, const uint8_t *bytes, size_t size_bytes) {
    (void)context;
    GPIO_DATA(PORT_C, PIN_DC) = PIN_DC;
    send(bytes, size_bytes);
    return TUILE_HAL_OK;
}

static int delay_ms(void *context, uint32_t delay_ms) {
    (void)context;
    SYST_RVR = CORE_MOST_HZ / 1000u - 1u;
    SYST_CVR = 0;
    SYST_CSR = SYST_CSR_CORE | SYST_CSR_ENABLE;
    for (; delay_ms; delay_ms--) {
        while (!(SYST_CSR & SYST_CSR_COUNTFLAG)) {}
    }
    SYST_CSR = 0;
    return TUILE_HAL_OK;
}

void ssi_open(tuile_bus_t *bus) {
    RCGC1 |= 1u << 4;
    RCGC2 |= 1u << 0 | 1u << 2 | 1u << 3;
    (void)RCGC2; /* three clocks until the port answers (System Control, RCGC2) */
    (void)RCGC2;
    GPIO_AFSEL(PORT_A) |= 1u << 2 | 1u << 3 | 1u << 5;
    GPIO_DEN(PORT_A) |= 1u << 2 | 1u << 3 | 1u << 5;
    GPIO_DIR(PORT_C) |= PIN_DC;
    GPIO_DEN(PORT_C) |= PIN_DC;
    GPIO_DIR(PORT_D) |= PIN_SELECT;
    GPIO_DEN(PORT_D) |= PIN_SELECT;
    GPIO_DATA(PORT_D, PIN_SELECT) = PIN_SELECT;
    *bus = (tuile_bus_t){
        .clocks = clocks,
        .command = command,
        .data = data,
        .delay_ms = delay_ms,
    };
}
