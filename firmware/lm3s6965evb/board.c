/* Stellaris LM3S6965 evaluation board: Cortex-M3, 64 KB of SRAM, an SSD0323 of 128 x 64 in 16 greys. Lines go by UART0. */
#include "../board/board.h"
#include "../board/models.h"
#include "../board/semihosting.h"
#include "../../hal/panels/ssd0323.h"
#include "lm3s6965.h"
#include "ssi.h"

#define BLOCK_BYTES (48u * 1024u)
#define PIN_BUTTON (1u << 1) /* of port F: the board's select switch, to ground */

static _Alignas(8) uint8_t block[BLOCK_BYTES];

void *board_block(size_t *size_bytes) {
    *size_bytes = sizeof block;
    return block;
}

const void *board_model(const scene_script_t *script, size_t *size_bytes) { return models_find(script, size_bytes); }

/* 115 200 baud: the divisor has six binary places, and rounds (Universal Asynchronous Receivers/Transmitters, baud rate). */
static void open_uart(void) {
    const uint32_t divisor = (CORE_HZ * 4u + 115200u / 2u) / 115200u;

    RCGC1 |= 1u << 0;
    RCGC2 |= 1u << 0;
    (void)RCGC2;
    (void)RCGC2;
    GPIO_AFSEL(PORT_A) |= 1u << 0 | 1u << 1;
    GPIO_DEN(PORT_A) |= 1u << 0 | 1u << 1;
    UART0_CTL = 0;
    UART0_IBRD = divisor >> 6;
    UART0_FBRD = divisor & 63u;
    UART0_LCRH = UART_LCRH_8N1_FIFO;
    UART0_CTL = UART_CTL_ENABLE;
}

/* The watchdog is the one counter of 32 bits that runs by itself and that QEMU has too: its SysTick and general-purpose timers are
 * shorter or cannot be read. */
static void open_clock(void) {
    RCGC0 |= 1u << 3;
    (void)RCGC0;
    (void)RCGC0;
    WDT_LOAD = UINT32_MAX;
    WDT_CTL = WDT_CTL_INTEN;
}

/* As exact as the oscillator, which is not (CORE_HZ). */
uint32_t board_clock_us(void) {
    static uint32_t before, us, rest;
    const uint32_t now = ~WDT_VALUE, cycles = now - before;

    us += cycles / (CORE_HZ / 1000000u);
    rest += cycles % (CORE_HZ / 1000000u);
    if (rest >= CORE_HZ / 1000000u) {
        rest -= CORE_HZ / 1000000u;
        us++;
    }
    before = now;
    return us;
}

static void open_button(void) {
    RCGC2 |= 1u << 5;
    (void)RCGC2;
    (void)RCGC2;
    GPIO_PUR(PORT_F) |= PIN_BUTTON;
    GPIO_DEN(PORT_F) |= PIN_BUTTON;
}

bool board_button(void) { return !(GPIO_DATA(PORT_F, PIN_BUTTON) & PIN_BUTTON); }

const tuile_display_config_t *board_display(void) {
    static tuile_bus_t bus;
    static const tuile_display_config_t config = {.bus = &bus, .panel = &tuile_ssd0323};

    open_clock();
    open_button();
    open_uart();
    ssi_open(&bus);
    return &config;
}

static void put(char c) {
    while (UART0_FR & UART_FR_TXFF) {}
    UART0_DR = (uint8_t)c;
}

void board_tell(const char *line) {
    while (*line) {
        put(*line++);
    }
    put('\n');
}

void board_shown(void) {
    while (UART0_FR & UART_FR_RXFE) {}
    (void)UART0_DR;
}

void board_options(char *text, size_t size_bytes) { semihosting_options(text, size_bytes); }

void board_park(board_code_t code) { semihosting_exit(code); }
