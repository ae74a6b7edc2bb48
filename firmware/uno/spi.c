#include "spi.h"

#include "atmega328p.h"

#define PIN_RESET 0x01
#define PIN_DC 0x02
#define PIN_SELECT 0x04 /* SS: an output, else a low level there would end master mode (19.3.2) */
#define PIN_DATA 0x08
#define PIN_CLOCK 0x20

#define TWICE 0x80

/* The fastest of 16 MHz / 2, 4 ... 128 that is not above; table 19-5. */
static uint8_t clock_for(uint32_t most_hz) {
    static const TUILE_FLASH uint8_t settings[] = {TWICE | 0, 0, TWICE | 1, 1, TWICE | 2, 2, 3};
    uint32_t clock_hz = UNO_CLOCK_HZ / 2u;
    uint8_t i = 0;

    while (clock_hz > most_hz && i + 1u < sizeof settings) {
        clock_hz /= 2u;
        i++;
    }
    return settings[i];
}

static void set_clock(uint8_t clock) {
    SPCR = (uint8_t)(SPCR_SPE | SPCR_MSTR | (clock & SPCR_CLK)); /* mode 0, most significant bit first */
    SPSR = clock & TWICE ? SPSR_SPI2X : 0;
}

static void send(const uint8_t *bytes, size_t size_bytes) {
    for (; size_bytes; size_bytes--) {
        SPDR = *bytes++;
        while (!(SPSR & SPSR_SPIF)) {}
    }
}

static int clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    uno_spi_t *spi = context;

    spi->command_clock = clock_for(command_clock_hz);
    spi->pixel_clock = clock_for(pixel_clock_hz);
    return TUILE_HAL_OK;
}

static int command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    const uno_spi_t *spi = context;

    set_clock(spi->command_clock);
    PORTB &= (uint8_t) ~(PIN_SELECT | PIN_DC);
    send(bytes, low_count);
    PORTB |= PIN_DC;
    send(bytes + low_count, size_bytes - low_count);
    PORTB |= PIN_SELECT;
    return TUILE_HAL_OK;
}

static int data(void *context, const uint8_t *bytes, size_t size_bytes) {
    const uno_spi_t *spi = context;

    set_clock(spi->pixel_clock);
    PORTB = (uint8_t)((PORTB & ~PIN_SELECT) | PIN_DC);
    send(bytes, size_bytes);
    PORTB |= PIN_SELECT;
    return TUILE_HAL_OK;
}

static int delay_ms(void *context, uint32_t delay_ms) {
    (void)context;
    TCNT1 = 0;
    TIFR1 = TIFR1_OCF1A;
    for (; delay_ms; delay_ms--) {
        while (!(TIFR1 & TIFR1_OCF1A)) {}
        TIFR1 = TIFR1_OCF1A;
    }
    return TUILE_HAL_OK;
}

static int pin(void *context, tuile_pin_t pin, uint8_t level) {
    (void)context;
    if (pin != TUILE_PIN_RESET) { return TUILE_HAL_UNSUPPORTED; }
    PORTB = (uint8_t)(level ? PORTB | PIN_RESET : PORTB & ~PIN_RESET);
    return TUILE_HAL_OK;
}

void uno_spi_open(tuile_bus_t *bus, uno_spi_t *spi) {
    PORTB = PIN_SELECT | PIN_DC | PIN_RESET; /* before they are outputs: no line goes low for a moment */
    DDRB = PIN_SELECT | PIN_DC | PIN_RESET | PIN_DATA | PIN_CLOCK;
    TCCR1A = 0;
    OCR1A = UNO_CLOCK_HZ / 64u / 1000u - 1u;
    TCCR1B = TCCR1B_CTC | TCCR1B_CLK_64;
    *spi = (uno_spi_t){clock_for(0), clock_for(0)};
    *bus = (tuile_bus_t){
        .context = spi,
        .clocks = clocks,
        .command = command,
        .data = data,
        .delay_ms = delay_ms,
        .pin = pin,
        .pins = TUILE_PIN_BIT(TUILE_PIN_RESET),
    };
}
