#include "spi.h"

#include "stm32f411.h"

#include <stdbool.h>

static uint8_t command_rate, pixel_rate;
static volatile bool sent;
static bool sending;

void dma2_stream_3(void);

void dma2_stream_3(void) {
    DMA2_LIFCR = DMA_STREAM_3_FLAGS;
    sent = true;
}

/* The exponent of the fastest clock that is not above the one asked for, APB2 / 2 ... / 256; 8 when there is none. */
static uint8_t find_rate(uint32_t clock_hz) {
    uint8_t rate = 0;

    while (rate < 8 && CORE_HZ >> (rate + 1u) > clock_hz) {
        rate++;
    }
    return rate;
}

static int clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    (void)context;
    command_rate = find_rate(command_clock_hz);
    pixel_rate = find_rate(pixel_clock_hz);
    return command_rate < 8 && pixel_rate < 8 ? TUILE_HAL_OK : TUILE_HAL_ARGUMENT;
}

/* The rate changes only while the peripheral is off, which it may be turned when nothing is on the wire (20.3.8). */
static void use(uint8_t rate) {
    const uint32_t control =
        SPI_CR1_MODE_3 | SPI_CR1_MASTER | SPI_CR1_RATE(rate) | SPI_CR1_SELECT_BY_SOFTWARE | SPI_CR1_TRANSMIT_ONLY;

    if (SPI1_CR1 == (control | SPI_CR1_ENABLE)) { return; }
    SPI1_CR1 = control;
    SPI1_CR1 = control | SPI_CR1_ENABLE;
}

static void set_pin(unsigned pin, bool high) { GPIOA_BSRR = 1u << (high ? pin : pin + 16u); }

/* Returns when the last bit is out: only then may D/C and the chip select move. */
static void drain(void) {
    while (!(SPI1_SR & SPI_SR_TXE)) {}
    while (SPI1_SR & SPI_SR_BSY) {}
}

static void send(const uint8_t *bytes, size_t size_bytes) {
    for (; size_bytes; size_bytes--) {
        while (!(SPI1_SR & SPI_SR_TXE)) {}
        SPI1_DR = *bytes++;
    }
    drain();
}

static int command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    (void)context;
    use(command_rate);
    set_pin(SPI_PIN_DC, false);
    set_pin(SPI_PIN_SELECT, false);
    send(bytes, low_count);
    set_pin(SPI_PIN_DC, true);
    send(bytes + low_count, size_bytes - low_count);
    set_pin(SPI_PIN_SELECT, true);
    return TUILE_HAL_OK;
}

static int data(void *context, const uint8_t *bytes, size_t size_bytes) {
    (void)context;
    use(pixel_rate);
    set_pin(SPI_PIN_DC, true);
    set_pin(SPI_PIN_SELECT, false);
    sent = false;
    sending = true;
    DMA2_LIFCR = DMA_STREAM_3_FLAGS;
    DMA2_S3PAR = (uint32_t)(uintptr_t)&SPI1_DR;
    DMA2_S3M0AR = (uint32_t)(uintptr_t)bytes;
    DMA2_S3NDTR = (uint32_t)size_bytes;
    DMA2_S3CR = DMA_CR_CHANNEL_3 | DMA_CR_MEMORY_INCREMENTS | DMA_CR_TO_PERIPHERAL | DMA_CR_INTERRUPT_AT_END | DMA_CR_ENABLE;
    return TUILE_HAL_OK;
}

/* With interrupts held back, one that comes between the look at `sent` and WFI still ends WFI; it is let in afterwards. */
static int wait(void *context) {
    (void)context;
    if (!sending) { return TUILE_HAL_OK; }
    __asm__ volatile("cpsid i" ::: "memory");
    while (!sent) {
        __asm__ volatile("wfi\n"
                         "cpsie i\n"
                         "isb\n"
                         "cpsid i" ::
                             : "memory");
    }
    __asm__ volatile("cpsie i" ::: "memory");
    drain();
    set_pin(SPI_PIN_SELECT, true);
    sending = false;
    return TUILE_HAL_OK;
}

static int delay_ms(void *context, uint32_t delay_ms) {
    (void)context;
    SYST_RVR = CORE_HZ / 1000u - 1u;
    SYST_CVR = 0;
    SYST_CSR = 5; /* counts the core's clock, without interrupts */
    for (; delay_ms; delay_ms--) {
        while (!(SYST_CSR & SYST_CSR_COUNTFLAG)) {}
    }
    SYST_CSR = 0;
    return TUILE_HAL_OK;
}

static int pin(void *context, tuile_pin_t pin, uint8_t level) {
    (void)context;
    set_pin(pin == TUILE_PIN_BACKLIGHT ? SPI_PIN_BACKLIGHT : SPI_PIN_RESET, level != 0);
    return TUILE_HAL_OK;
}

static void open_pin(unsigned pin, uint32_t mode) {
    GPIOA_OSPEEDR = (GPIOA_OSPEEDR & ~(3u << 2u * pin)) | SPEED_HIGH << 2u * pin;
    GPIOA_MODER = (GPIOA_MODER & ~(3u << 2u * pin)) | mode << 2u * pin;
}

/* Nothing is selected, nothing reset and nothing lit when the pins begin to be driven. */
void spi_open(tuile_bus_t *bus) {
    RCC_AHB1ENR |= 1u << 0 | 1u << 22;
    RCC_APB2ENR |= 1u << 12;
    (void)RCC_APB2ENR; /* a clock arrives two periods later (6.2) */
    set_pin(SPI_PIN_SELECT, true);
    set_pin(SPI_PIN_RESET, true);
    set_pin(SPI_PIN_BACKLIGHT, false);
    open_pin(SPI_PIN_BACKLIGHT, MODE_OUTPUT);
    open_pin(SPI_PIN_RESET, MODE_OUTPUT);
    open_pin(SPI_PIN_DC, MODE_OUTPUT);
    open_pin(SPI_PIN_SELECT, MODE_OUTPUT);
    GPIOA_AFRL |= FUNCTION_SPI1 << 4u * SPI_PIN_CLOCK | FUNCTION_SPI1 << 4u * SPI_PIN_DATA;
    open_pin(SPI_PIN_CLOCK, MODE_FUNCTION);
    open_pin(SPI_PIN_DATA, MODE_FUNCTION);
    SPI1_CR2 = SPI_CR2_TX_DMA;
    NVIC_ISER1 = 1u << (IRQ_DMA2_STREAM_3 - 32u);
    *bus = (tuile_bus_t){
        .clocks = clocks,
        .command = command,
        .data = data,
        .wait = wait,
        .delay_ms = delay_ms,
        .pin = pin,
        .max_chunk_bytes = DMA_MOST_BYTES,
        .pins = TUILE_PIN_BIT(TUILE_PIN_RESET) | TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT),
    };
}
