#include "stm32f411.h"

#include <stdarg.h>
#include <string.h>

#include "trace.h"

/* Pins of port A (firmware/blackpill/spi.h, board.c). */
enum { PIN_LIGHT = 1, PIN_RESET = 2, PIN_DC = 3, PIN_SELECT = 4, PIN_CLOCK = 5, PIN_DATA = 7, PIN_TX = 9 };

#define HSI_HZ 16000000u
#define HSE_HZ 25000000u /* the board's crystal */
#define CORE_MOST_HZ 100000000u
#define APB1_MOST_HZ 50000000u
#define LOOKS 3u /* until something is ready */

#define TIM5 0x40000c00u
#define PWR_CR 0x40007000u
#define USART1 0x40011000u
#define SPI1 0x40013000u
#define GPIOA 0x40020000u
#define RCC 0x40023800u
#define FLASH_ACR 0x40023c00u
#define DMA2 0x40026400u
#define SYSTICK 0xe000e010u
#define ISER1 0xe000e104u

#define SPI1_DR (SPI1 + 0x0cu)
#define IRQ_DMA2_STREAM_3 59
#define DMA_FLAGS 0x0f400000u /* of stream 3 in LISR (9.5.1) */
#define DMA_COMPLETE (1u << 27)

void stm32f411_refuse(stm32f411_t *chip, const char *format, ...) {
    va_list arguments;

    if (chip->fault[0]) { return; }
    va_start(arguments, format);
    (void)vsnprintf(chip->fault, sizeof chip->fault, format, arguments);
    va_end(arguments);
}

/* ---- the trace -------------------------------------------------------------------------------------------------- */

static void put_word(uint8_t *to, uint32_t word) {
    for (unsigned i = 0; i < 4; i++) {
        to[i] = (uint8_t)(word >> 8 * i);
    }
}

static void record(stm32f411_t *chip, trace_kind_t kind, uint8_t flag, uint64_t time_ns, const uint32_t *clock_hz,
                   const void *bytes, uint32_t size_bytes) {
    uint8_t head[20] = {(uint8_t)kind, flag};
    const uint32_t head_bytes = clock_hz ? 20 : 16;

    put_word(head + 4, size_bytes + head_bytes - 16u);
    put_word(head + 8, (uint32_t)time_ns);
    put_word(head + 12, (uint32_t)(time_ns >> 32));
    if (clock_hz) { put_word(head + 16, *clock_hz); }
    if (fwrite(head, 1, head_bytes, chip->trace) != head_bytes || fwrite(bytes, 1, size_bytes, chip->trace) != size_bytes) {
        stm32f411_refuse(chip, "the trace cannot be written");
    }
}

static void end_run(stm32f411_t *chip) {
    if (chip->run_bytes) { record(chip, TRACE_BYTES, chip->run_data, chip->run_ns, &chip->run_hz, chip->run, chip->run_bytes); }
    chip->run_bytes = 0;
}

static void put_byte(stm32f411_t *chip, uint8_t byte, bool data, uint32_t hz) {
    if (chip->run_bytes == sizeof chip->run || chip->run_data != data || chip->run_hz != hz) { end_run(chip); }
    if (!chip->run_bytes) {
        chip->run_data = data;
        chip->run_hz = hz;
        chip->run_ns = chip->now_ns;
    }
    chip->run[chip->run_bytes++] = byte;
    chip->now_ns += 8000000000u / hz;
}

/* ---- clocks (6) --------------------------------------------------------------------------------------------------- */

static bool hse_ready(const stm32f411_t *chip) { return chip->rcc_cr >> 17 & 1u; }
static bool pll_used(const stm32f411_t *chip) { return (chip->rcc_cfgr >> 2 & 3u) == 2; }

static uint32_t pll_hz(stm32f411_t *chip) {
    const uint32_t m = chip->rcc_pllcfgr & 63u, n = chip->rcc_pllcfgr >> 6 & 511u, p = 2u * ((chip->rcc_pllcfgr >> 16 & 3u) + 1u);
    const uint32_t source = chip->rcc_pllcfgr >> 22 & 1u ? HSE_HZ : HSI_HZ;
    const uint32_t in = m ? source / m : 0;

    if (m < 2 || in < 1000000u || in > 2000000u) { stm32f411_refuse(chip, "the PLL's input is %u Hz, not 1 to 2 MHz (6.3.2)", in); }
    if (n < 50 || n > 432 || (uint64_t)in * n < 100000000u || (uint64_t)in * n > 432000000u) {
        stm32f411_refuse(chip, "the PLL's VCO is at %u times %u Hz, not 100 to 432 MHz (6.3.2)", n, in);
    }
    return in * n / p;
}

static uint32_t core_hz(stm32f411_t *chip) { return pll_used(chip) ? pll_hz(chip) : HSI_HZ; }

/* What a field of CFGR divides by: 0xx: 1, 100 ... 111: 2 ... 16. */
static uint32_t apb_hz(stm32f411_t *chip, unsigned shift) {
    const uint32_t field = chip->rcc_cfgr >> shift & 7u;

    return core_hz(chip) >> (field < 4 ? 0 : field - 3u);
}

static void check_clocks(stm32f411_t *chip) {
    static const uint32_t most_hz[] = {30000000, 64000000, 90000000}; /* with 0, 1 and 2 wait states, at 2.7 V or more (3.4.1) */
    const uint32_t hz = core_hz(chip), waits = chip->flash_acr & 15u;

    if (hz > CORE_MOST_HZ || apb_hz(chip, 13) > CORE_MOST_HZ) { stm32f411_refuse(chip, "the core's clock is %u Hz", hz); }
    if (apb_hz(chip, 10) > APB1_MOST_HZ) {
        stm32f411_refuse(chip, "APB1's clock is %u Hz, more than 50 MHz (6.2)", apb_hz(chip, 10));
    }
    if (chip->rcc_cfgr >> 4 & 15u) { stm32f411_refuse(chip, "AHB's clock is divided, which is not modelled"); }
    if (waits < 3 && hz > most_hz[waits]) { stm32f411_refuse(chip, "flash has %u wait states at %u Hz (3.4.1)", waits, hz); }
    if (hz > 84000000u && (chip->pwr_cr >> 14 & 3u) != 3) {
        stm32f411_refuse(chip, "the regulator's scale %u does not allow %u Hz (5.4.1)", chip->pwr_cr >> 14 & 3u, hz);
    }
}

static uint32_t read_rcc(stm32f411_t *chip, uint32_t offset) {
    const bool ready = ++chip->looks % LOOKS == 0;

    switch (offset) {
    case 0x00:
        if (ready && chip->rcc_cr >> 16 & 1u) { chip->rcc_cr |= 1u << 17; }
        if (ready && chip->rcc_cr >> 24 & 1u) { chip->rcc_cr |= 1u << 25; }
        return chip->rcc_cr;
    case 0x04: return chip->rcc_pllcfgr;
    case 0x08:
        if (ready && (chip->rcc_cfgr & 3u) != (chip->rcc_cfgr >> 2 & 3u)) {
            chip->rcc_cfgr = (chip->rcc_cfgr & ~12u) | (chip->rcc_cfgr & 3u) << 2;
            check_clocks(chip);
        }
        return chip->rcc_cfgr;
    case 0x30: return chip->ahb1;
    case 0x40: return chip->apb1;
    case 0x44: return chip->apb2;
    default: stm32f411_refuse(chip, "RCC + 0x%02x is not modelled", offset); return 0;
    }
}

static void write_rcc(stm32f411_t *chip, uint32_t offset, uint32_t value) {
    switch (offset) {
    case 0x00:
        if (value >> 24 & 1u && chip->rcc_pllcfgr >> 22 & 1u && !hse_ready(chip)) {
            stm32f411_refuse(chip, "the PLL is started before its crystal is ready");
        }
        chip->rcc_cr = (value & ~(1u << 17 | 1u << 25)) | (chip->rcc_cr & (1u << 17 | 1u << 25));
        return;
    case 0x04:
        if (chip->rcc_cr >> 24 & 1u) { stm32f411_refuse(chip, "PLLCFGR is written while the PLL is on (6.3.2)"); }
        chip->rcc_pllcfgr = value;
        return;
    case 0x08:
        if ((value & 3u) == 2 && !(chip->rcc_cr >> 25 & 1u)) { stm32f411_refuse(chip, "the PLL is chosen before it is locked"); }
        chip->rcc_cfgr = (value & ~12u) | (chip->rcc_cfgr & 12u);
        if (pll_used(chip)) { check_clocks(chip); }
        return;
    case 0x30: chip->ahb1 = value; return;
    case 0x40: chip->apb1 = value; return;
    case 0x44: chip->apb2 = value; return;
    default: stm32f411_refuse(chip, "RCC + 0x%02x is not modelled", offset);
    }
}

/* ---- port A (8) --------------------------------------------------------------------------------------------------- */

static uint32_t mode_of(const stm32f411_t *chip, unsigned pin) { return chip->moder >> 2u * pin & 3u; }

/* -1: nobody drives it. */
static int level_of(const stm32f411_t *chip, unsigned pin) { return mode_of(chip, pin) == 1 ? (int)(chip->odr >> pin & 1u) : -1; }

static uint32_t function_of(const stm32f411_t *chip, unsigned pin) {
    return (pin < 8 ? chip->afrl >> 4u * pin : chip->afrh >> 4u * (pin - 8u)) & 15u;
}

static bool busy(const stm32f411_t *chip) { return chip->shifting || chip->dma_cr & 1u; }

/* After a write, of which `before` is the level of each pin. */
static void pins_moved(stm32f411_t *chip, const int before[8]) {
    for (unsigned pin = PIN_LIGHT; pin <= PIN_SELECT; pin++) {
        const int now = level_of(chip, pin);

        if (now == before[pin]) { continue; }
        if ((pin == PIN_DC || pin == PIN_SELECT) && busy(chip)) {
            stm32f411_refuse(chip, "%s moves while a transfer is under way", pin == PIN_DC ? "D/C" : "the chip select");
        }
        if (pin == PIN_SELECT && now != 0) { end_run(chip); }
        if (pin == PIN_RESET && (now != 0) != (before[pin] != 0)) { /* what nobody drives is pulled up */
            end_run(chip);
            record(chip, TRACE_RESET, now != 0, chip->now_ns, NULL, "", 0);
        }
        if (pin == PIN_LIGHT) { record(chip, TRACE_LIGHT, now > 0 ? 255 : 0, chip->now_ns, NULL, "", 0); }
    }
}

static void write_port(stm32f411_t *chip, uint32_t offset, uint32_t value) {
    int before[8];

    for (unsigned pin = 0; pin < 8; pin++) {
        before[pin] = level_of(chip, pin);
    }
    switch (offset) {
    case 0x00: chip->moder = value; break;
    case 0x08: chip->ospeedr = value; break;
    case 0x0c: chip->pupdr = value; break;
    case 0x18: chip->odr = (chip->odr & ~(value >> 16)) | (value & 0xffffu); break;
    case 0x20: chip->afrl = value; break;
    case 0x24: chip->afrh = value; break;
    default: stm32f411_refuse(chip, "port A + 0x%02x is not modelled", offset);
    }
    pins_moved(chip, before);
}

static uint32_t read_port(stm32f411_t *chip, uint32_t offset) {
    switch (offset) {
    case 0x00: return chip->moder;
    case 0x08: return chip->ospeedr;
    case 0x0c: return chip->pupdr;
    case 0x10: return 0xffffu; /* nothing pulls down */
    case 0x20: return chip->afrl;
    case 0x24: return chip->afrh;
    default: stm32f411_refuse(chip, "port A + 0x%02x is not modelled", offset); return 0;
    }
}

/* ---- SPI1 (20) ---------------------------------------------------------------------------------------------------- */

static void begin_byte(stm32f411_t *chip, uint8_t byte) {
    const uint32_t cr1 = chip->spi_cr1;

    if (!(cr1 >> 6 & 1u) || !(cr1 >> 2 & 1u) || (cr1 >> 8 & 3u) != 3 || (cr1 >> 14 & 3u) != 3 || cr1 >> 11 & 1u || cr1 >> 7 & 1u ||
        (cr1 & 1u) != (cr1 >> 1 & 1u)) { /* 8 bits, the first one highest, mode 0 or 3 */
        stm32f411_refuse(chip, "SPI1 is to send as CR1 = 0x%04x has it", cr1);
    }
    for (unsigned pin = PIN_CLOCK; pin <= PIN_DATA; pin += PIN_DATA - PIN_CLOCK) {
        if (mode_of(chip, pin) != 2 || function_of(chip, pin) != 5) {
            stm32f411_refuse(chip, "a byte on SPI1, but PA%u has the mode %u and the function %u", pin, mode_of(chip, pin),
                             function_of(chip, pin));
        }
    }
    if (level_of(chip, PIN_SELECT) != 0) { stm32f411_refuse(chip, "a byte begins while the panel is not selected"); }
    if (level_of(chip, PIN_DC) < 0) { stm32f411_refuse(chip, "nobody drives D/C"); }
    chip->shifting = true;
    chip->shifted = byte;
    chip->shifted_data = level_of(chip, PIN_DC) > 0;
    chip->shifted_hz = apb_hz(chip, 13) >> ((cr1 >> 3 & 7u) + 1u);
}

/* A byte leaves, and the one behind it begins. */
static void shift(stm32f411_t *chip) {
    if (!chip->shifting) { return; }
    put_byte(chip, chip->shifted, chip->shifted_data, chip->shifted_hz);
    chip->shifting = false;
    if (chip->waiting) {
        chip->waiting = false;
        begin_byte(chip, chip->next);
    }
}

static void give_byte(stm32f411_t *chip, uint8_t byte) {
    if (chip->waiting) {
        stm32f411_refuse(chip, "a byte for SPI1 is lost: its buffer is full");
    } else if (chip->shifting) {
        chip->waiting = true;
        chip->next = byte;
    } else {
        begin_byte(chip, byte);
    }
}

static uint32_t read_spi(stm32f411_t *chip, uint32_t offset) {
    const uint32_t status = (chip->waiting ? 0 : 2u) | (chip->shifting ? 0x80u : 0);

    switch (offset) {
    case 0x00: return chip->spi_cr1;
    case 0x04: return chip->spi_cr2;
    case 0x08: shift(chip); return status;
    default: stm32f411_refuse(chip, "SPI1 + 0x%02x is not modelled", offset); return 0;
    }
}

static void write_spi(stm32f411_t *chip, uint32_t offset, uint32_t value) {
    switch (offset) {
    case 0x00:
        if (busy(chip)) { stm32f411_refuse(chip, "SPI1's CR1 is written while a byte is on the wire (20.3.8)"); }
        if (chip->spi_cr1 >> 6 & value >> 6 & 1u && (chip->spi_cr1 ^ value) & 0x3fu) {
            stm32f411_refuse(chip, "SPI1 changes its clock while it is on (20.5.1)");
        }
        chip->spi_cr1 = value;
        return;
    case 0x04: chip->spi_cr2 = value; return;
    case 0x0c: give_byte(chip, (uint8_t)value); return;
    default: stm32f411_refuse(chip, "SPI1 + 0x%02x is not modelled", offset);
    }
}

/* ---- DMA2, stream 3 (9) ------------------------------------------------------------------------------------------- */

static void start_dma(stm32f411_t *chip, uint32_t control) {
    if ((control >> 25 & 7u) != 3) {
        stm32f411_refuse(chip, "channel %u of DMA2's stream 3 is not SPI1's (9.3.3)", control >> 25 & 7u);
    }
    if ((control >> 6 & 3u) != 1) { stm32f411_refuse(chip, "DMA2 does not go from memory to the peripheral"); }
    if (!(control >> 10 & 1u) || control >> 9 & 1u || control & 0x7800u) {
        stm32f411_refuse(chip, "DMA2 does not go byte by byte");
    }
    if (chip->dma_peripheral != SPI1_DR) { stm32f411_refuse(chip, "DMA2's peripheral is 0x%08x", chip->dma_peripheral); }
    if (chip->dma_count == 0) { stm32f411_refuse(chip, "DMA2 is to move nothing"); }
    if (chip->dma_flags) { stm32f411_refuse(chip, "DMA2's stream 3 is started with flags of its last transfer (9.3.17)"); }
}

static void write_dma(stm32f411_t *chip, uint32_t offset, uint32_t value) {
    if (chip->dma_cr & 1u && offset != 0x08) {
        stm32f411_refuse(chip, "DMA2's stream 3 is written to while it moves data (9.5.5)");
    }
    switch (offset) {
    case 0x08: chip->dma_flags &= ~value; return;
    case 0x58:
        if (value & 1u) { start_dma(chip, value); }
        chip->dma_cr = value;
        return;
    case 0x5c: chip->dma_count = value & 0xffffu; return;
    case 0x60: chip->dma_peripheral = value; return;
    case 0x64: chip->dma_memory = value; return;
    default: stm32f411_refuse(chip, "DMA2 + 0x%02x is not modelled", offset);
    }
}

/* Bytes are read when they go, so a buffer that is overwritten too early is seen. The last two stay in SPI1. */
static void move_data(stm32f411_t *chip) {
    static uint8_t bytes[65536];

    if (!(chip->spi_cr2 >> 1 & 1u)) {
        stm32f411_refuse(chip, "DMA2 waits for SPI1, whose requests are off (CR2.TXDMAEN)");
        return;
    }
    if (!chip->memory(chip->context, chip->dma_memory, bytes, chip->dma_count)) {
        stm32f411_refuse(chip, "DMA2 reads %u bytes at 0x%08x, which is no RAM", chip->dma_count, chip->dma_memory);
        return;
    }
    for (uint32_t i = 0; i < chip->dma_count && !chip->fault[0]; i++) {
        if (chip->waiting) { shift(chip); }
        give_byte(chip, bytes[i]);
    }
    chip->dma_count = 0;
    chip->dma_cr &= ~1u;
    chip->dma_flags |= DMA_COMPLETE;
}

void stm32f411_sleep(stm32f411_t *chip) {
    if (chip->dma_cr & 1u) { move_data(chip); }
}

bool stm32f411_pending(const stm32f411_t *chip) {
    return chip->dma_flags & DMA_COMPLETE && chip->dma_cr >> 4 & 1u && chip->iser1 >> (IRQ_DMA2_STREAM_3 - 32) & 1u;
}

int stm32f411_irq(const stm32f411_t *chip) {
    (void)chip;
    return IRQ_DMA2_STREAM_3;
}

/* ---- the rest ----------------------------------------------------------------------------------------------------- */

static void tell(stm32f411_t *chip, char c) {
    if ((chip->usart_cr1 & 0x2008u) != 0x2008u || mode_of(chip, PIN_TX) != 2 || function_of(chip, PIN_TX) != 7) {
        stm32f411_refuse(chip, "a byte for USART1, which is off or has no pin");
    }
    if (chip->usart_busy) { stm32f411_refuse(chip, "a byte for USART1 is lost"); }
    if (apb_hz(chip, 13) / chip->usart_brr / 576u != 200u) { /* 115 200 baud within half a per cent */
        stm32f411_refuse(chip, "USART1 has %u baud", apb_hz(chip, 13) / chip->usart_brr);
    }
    chip->usart_busy = true;
    if (c != '\n') {
        if (chip->text_bytes + 1 < sizeof chip->text) { chip->text[chip->text_bytes++] = c; }
        return;
    }
    chip->text[chip->text_bytes] = 0;
    memcpy(chip->line, chip->text, sizeof chip->line);
    (void)printf("%s\n", chip->line);
    end_run(chip);
    record(chip, TRACE_TEXT, 0, chip->now_ns, NULL, chip->text, chip->text_bytes);
    chip->text_bytes = 0;
}

static uint32_t read_usart(stm32f411_t *chip, uint32_t offset) {
    const uint32_t status = chip->usart_busy ? 0 : 0x80u;

    chip->usart_busy = false;
    if (offset) { stm32f411_refuse(chip, "USART1 + 0x%02x is not modelled", offset); }
    return status;
}

static void write_usart(stm32f411_t *chip, uint32_t offset, uint32_t value) {
    switch (offset) {
    case 0x04: tell(chip, (char)value); return;
    case 0x08: chip->usart_brr = value; return;
    case 0x0c: chip->usart_cr1 = value; return;
    default: stm32f411_refuse(chip, "USART1 + 0x%02x is not modelled", offset);
    }
}

/* A look at COUNTFLAG takes as long as the next time that it is set. */
static uint32_t read_systick(stm32f411_t *chip, uint32_t address) {
    if (address != SYSTICK || !(chip->systick_csr & 1u)) { return 0; }
    if ((chip->systick_csr & 7u) != 5) { stm32f411_refuse(chip, "SysTick does not count the core's clock, or interrupts"); }
    chip->now_ns += (chip->systick_rvr + 1u) * UINT64_C(1000000000) / core_hz(chip);
    return chip->systick_csr | 0x10000u;
}

/* Registers without their clock read as 0, and writes are lost (6.3.9 and following). */
static void check_enabled(stm32f411_t *chip, uint32_t address) {
    static const struct {
        uint32_t at, bytes;
        unsigned bus, bit;
        const char *name;
    } gates[] = {
        {TIM5, 0x400, 0, 3, "TIM5"},  {PWR_CR, 0x400, 0, 28, "PWR"},  {USART1, 0x400, 1, 4, "USART1"},
        {SPI1, 0x400, 1, 12, "SPI1"}, {GPIOA, 0x400, 2, 0, "port A"}, {DMA2, 0x400, 2, 22, "DMA2"},
    };
    const uint32_t enabled[] = {chip->apb1, chip->apb2, chip->ahb1};

    for (unsigned i = 0; i < sizeof gates / sizeof gates[0]; i++) {
        if (address - gates[i].at < gates[i].bytes && !(enabled[gates[i].bus] >> gates[i].bit & 1u)) {
            stm32f411_refuse(chip, "%s has no clock, but 0x%08x is used", gates[i].name, address);
        }
    }
}

uint32_t stm32f411_read(stm32f411_t *chip, uint32_t address, unsigned size_bytes) {
    if (size_bytes != 4) { stm32f411_refuse(chip, "0x%08x is read in %u bytes", address, size_bytes); }
    check_enabled(chip, address);
    switch (address & ~0x3ffu) {
    case TIM5 & ~0x3ffu: return (uint32_t)(chip->now_ns / 1000u);
    case PWR_CR: return chip->pwr_cr;
    case USART1: return read_usart(chip, address - USART1);
    case SPI1: return read_spi(chip, address - SPI1);
    case GPIOA: return read_port(chip, address - GPIOA);
    case RCC & ~0x3ffu: return read_rcc(chip, address - RCC);
    case FLASH_ACR: return chip->flash_acr;
    case SYSTICK & ~0x3ffu: return read_systick(chip, address);
    default: stm32f411_refuse(chip, "0x%08x is not modelled", address); return 0;
    }
}

static void write_core(stm32f411_t *chip, uint32_t address, uint32_t value) {
    switch (address) {
    case SYSTICK: chip->systick_csr = value; return;
    case SYSTICK + 4: chip->systick_rvr = value & 0xffffffu; return;
    case SYSTICK + 8: return;
    case ISER1: chip->iser1 |= value; return;
    default: stm32f411_refuse(chip, "0x%08x is not modelled", address);
    }
}

void stm32f411_write(stm32f411_t *chip, uint32_t address, unsigned size_bytes, uint32_t value) {
    if (size_bytes != 4) { stm32f411_refuse(chip, "0x%08x is written in %u bytes", address, size_bytes); }
    check_enabled(chip, address);
    switch (address & ~0x3ffu) {
    case TIM5 & ~0x3ffu: return;
    case PWR_CR: chip->pwr_cr = value; return;
    case USART1: write_usart(chip, address - USART1, value); return;
    case SPI1: write_spi(chip, address - SPI1, value); return;
    case GPIOA: write_port(chip, address - GPIOA, value); return;
    case RCC & ~0x3ffu: write_rcc(chip, address - RCC, value); return;
    case FLASH_ACR: chip->flash_acr = value; return;
    case DMA2: write_dma(chip, address - DMA2, value); return;
    default: write_core(chip, address, value);
    }
}

/* Values after reset: 6.3, 8.4, 5.4.1. PA13 to PA15 belong to the debugger. */
void stm32f411_open(stm32f411_t *chip, FILE *trace,
                    bool (*memory)(void *context, uint32_t address, uint8_t *bytes, uint32_t size_bytes), void *context) {
    *chip = (stm32f411_t){
        .trace = trace,
        .memory = memory,
        .context = context,
        .rcc_cr = 0x83,
        .rcc_pllcfgr = 0x24003010,
        .pwr_cr = 0x8000,
        .moder = 0xa8000000,
        .ospeedr = 0x0c000000,
        .pupdr = 0x64000000,
    };
}

void stm32f411_close(stm32f411_t *chip) { end_run(chip); }
