#include "port.h"

#include "chip.h"
#include "clocks.h"

#include <stdbool.h>

/* What tests break on purpose, one at a time, to see that their emulator notices. */
#ifndef MUTANT
#define MUTANT 0
#endif
#define MUTANT_NO_REQUESTS 1
#define MUTANT_NO_PIN_MUX 2
#define MUTANT_IN_RESET 3
#define MUTANT_NO_PRESCALER 4

#define CHANNEL 0u
#define PWM_LEVELS 255u
#define PWM_DIVIDER 255u /* 125 MHz / 255 / 255: 1.9 kHz */

/* What the two divisors of a PL022 make of a clock: CPSDVSR, even, 2 ... 254, and 1 + SCR, 1 ... 256. */
typedef struct rate {
    uint8_t prescaler;
    uint8_t scr;
} rate_t;

static rate_t command_rate, pixel_rate;
static const rate_t *set;                /* of the two */
static volatile uint32_t sent, one_left; /* nothing is left to send; of two, only one is */
static bool sending;
static struct {
    const uint8_t *bytes; /* NULL: nothing waits */
    size_t size_bytes;
} volatile queued;

void rp2_dma_0(void);

static void begin(const uint8_t *bytes, size_t size_bytes) {
    DMA_READ_ADDR(CHANNEL) = (uint32_t)(uintptr_t)bytes;
    DMA_WRITE_ADDR(CHANNEL) = (uint32_t)(uintptr_t)&SPI0_DR;
    DMA_COUNT(CHANNEL) = (uint32_t)size_bytes;
    DMA_CTRL_TRIGGER(CHANNEL) =
        DMA_CTRL_ENABLE | DMA_CTRL_READ_INCREMENTS | DMA_CTRL_CHAIN_TO(CHANNEL) | DMA_CTRL_REQUEST(DMA_REQUEST_SPI0_TX);
}

/* The eight bytes that the FIFO still holds last longer than this takes to begin the next, so the wire does not rest. */
void rp2_dma_0(void) {
    DMA_INTS0 = 1u << CHANNEL;
    if (queued.bytes) {
        begin(queued.bytes, queued.size_bytes);
        queued.bytes = NULL;
        clocks_wake(&one_left);
    } else {
        clocks_wake(&sent);
    }
}

/* The fastest clock that is not above the one asked for. False when even the slowest is. */
static bool find_rate(rate_t *rate, uint32_t clock_hz) {
    const uint32_t halves =
        clock_hz ? (uint32_t)(((uint64_t)CLK_SYS_HZ + 2u * (uint64_t)clock_hz - 1u) / (2u * (uint64_t)clock_hz)) : 0;
    uint32_t prescaler, best = UINT32_MAX;

    if (halves == 0) { return false; }
    for (prescaler = 1; prescaler <= 127 && best > halves; prescaler++) {
        const uint32_t divisor = (halves + prescaler - 1u) / prescaler;

        if (divisor <= 256 && divisor * prescaler < best) {
            best = divisor * prescaler;
            *rate = (rate_t){.prescaler = (uint8_t)(2u * prescaler), .scr = (uint8_t)(divisor - 1u)};
        }
    }
    return best != UINT32_MAX;
}

static int clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    (void)context;
    set = NULL;
    return find_rate(&command_rate, command_clock_hz) && find_rate(&pixel_rate, pixel_clock_hz) ? TUILE_HAL_OK : TUILE_HAL_ARGUMENT;
}

/* Divisors may only change while the peripheral is disabled (DDI 0194, 2.3.3). */
static void use(const rate_t *rate) {
    if (set == rate) { return; }
    set = rate;
    SPI0_CR1 = 0;
    SPI0_CPSR = MUTANT == MUTANT_NO_PRESCALER ? 0 : rate->prescaler;
    SPI0_CR0 = (uint32_t)rate->scr << 8 | SPI_CR0_MODE_3_8_BITS;
    SPI0_CR1 = SPI_CR1_ENABLE;
}

/* Returns when the last bit is out and the receive FIFO is empty: only then may D/C and the chip select move. */
static void drain(void) {
    while (SPI0_SR & SPI_SR_BSY) {}
    while (SPI0_SR & SPI_SR_RNE) {
        (void)SPI0_DR;
    }
    SPI0_ICR = SPI_ICR_OVERRUN;
}

static void select_panel(bool data) {
    if (data) {
        SIO_OUT_SET = 1u << PORT_PIN_DC;
    } else {
        SIO_OUT_CLEAR = 1u << PORT_PIN_DC;
    }
    SIO_OUT_CLEAR = 1u << PORT_PIN_SELECT;
}

static void send(const uint8_t *bytes, size_t size_bytes) {
    while (size_bytes) {
        if (SPI0_SR & SPI_SR_TNF) {
            SPI0_DR = *bytes++;
            size_bytes--;
        }
        if (SPI0_SR & SPI_SR_RNE) { (void)SPI0_DR; }
    }
    drain();
}

static int command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    (void)context;
    use(&command_rate);
    select_panel(false);
    send(bytes, low_count);
    SIO_OUT_SET = 1u << PORT_PIN_DC;
    send(bytes + low_count, size_bytes - low_count);
    SIO_OUT_SET = 1u << PORT_PIN_SELECT;
    return TUILE_HAL_OK;
}

static int data(void *context, const uint8_t *bytes, size_t size_bytes) {
    (void)context;
    if (sending) {
        clocks_hold_irqs();
        if (!sent) {
            one_left = 0;
            queued.size_bytes = size_bytes;
            queued.bytes = bytes;
            clocks_release_irqs();
            return TUILE_HAL_OK;
        }
        clocks_release_irqs();
    } else {
        use(&pixel_rate);
        select_panel(true);
    }
    sent = 0;
    one_left = 1;
    sending = true;
    begin(bytes, size_bytes);
    return TUILE_HAL_OK;
}

static int leave_one(void *context) {
    (void)context;
    if (sending) { clocks_sleep_until(&one_left); }
    return TUILE_HAL_OK;
}

static int wait(void *context) {
    (void)context;
    if (!sending) { return TUILE_HAL_OK; }
    clocks_sleep_until(&sent);
    drain(); /* up to eight bytes are left in the FIFO */
    SIO_OUT_SET = 1u << PORT_PIN_SELECT;
    sending = false;
    return TUILE_HAL_OK;
}

static int delay_ms(void *context, uint32_t delay_ms) {
    (void)context;
    clocks_delay_ms(delay_ms);
    return TUILE_HAL_OK;
}

static int pin(void *context, tuile_pin_t pin, uint8_t level) {
    (void)context;
    if (pin == TUILE_PIN_BACKLIGHT) {
        PWM_CC(PWM_SLICE(PORT_PIN_BACKLIGHT)) = level;
    } else if (level) {
        SIO_OUT_SET = 1u << PORT_PIN_RESET;
    } else {
        SIO_OUT_CLEAR = 1u << PORT_PIN_RESET;
    }
    return TUILE_HAL_OK;
}

static void open_pin(uint32_t pin, uint32_t function, uint32_t pad) {
    GPIO_CTRL(pin) = function;
    PAD(pin) = pad | PAD_IN | PAD_SCHMITT;
}

/* Nothing is selected, nothing reset and nothing lit when the pins begin to be driven. */
static void open_pins(void) {
    const uint32_t select_high = 1u << PORT_PIN_SELECT | 1u << PORT_PIN_RESET;
    const uint32_t fast = PAD_8MA | PAD_FAST;

    SIO_OUT_CLEAR = 1u << PORT_PIN_DC;
    SIO_OUT_SET = select_high;
    SIO_OE_SET = select_high | 1u << PORT_PIN_DC;
    open_pin(PORT_PIN_DC, FUNCTION_SIO, PAD_4MA);
    open_pin(PORT_PIN_SELECT, FUNCTION_SIO, PAD_4MA);
    open_pin(PORT_PIN_RESET, FUNCTION_SIO, PAD_4MA);
    if (MUTANT != MUTANT_NO_PIN_MUX) {
        open_pin(PORT_PIN_CLOCK, FUNCTION_SPI, fast);
        open_pin(PORT_PIN_DATA, FUNCTION_SPI, fast);
    }
    PWM_DIV(PWM_SLICE(PORT_PIN_BACKLIGHT)) = PWM_DIVIDER << 4;
    PWM_TOP(PWM_SLICE(PORT_PIN_BACKLIGHT)) = PWM_LEVELS - 1u; /* a level above it never falls */
    PWM_CC(PWM_SLICE(PORT_PIN_BACKLIGHT)) = 0;
    PWM_CSR(PWM_SLICE(PORT_PIN_BACKLIGHT)) = 1;
    open_pin(PORT_PIN_BACKLIGHT, FUNCTION_PWM, PAD_4MA);
}

void port_open(tuile_bus_t *bus) {
    clocks_reset(RESET_DMA | RESET_PWM | RESET_IO_BANK0 | RESET_PADS_BANK0 | (MUTANT == MUTANT_IN_RESET ? 0 : RESET_SPI0));
    open_pins();
    SPI0_DMACR = MUTANT == MUTANT_NO_REQUESTS ? 0 : SPI_DMACR_TX;
    DMA_INTE0 = 1u << CHANNEL;
    clocks_enable_irq(IRQ_DMA_0);
    *bus = (tuile_bus_t){
        .clocks = clocks,
        .command = command,
        .data = data,
        .wait = wait,
        .wait_one = leave_one,
        .delay_ms = delay_ms,
        .pin = pin,
        .pins = TUILE_PIN_BIT(TUILE_PIN_RESET) | TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT),
    };
}
