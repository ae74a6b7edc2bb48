/* Raspberry Pi Pico and Pico 2: a panel on SPI0 (port.h), lines by UART0 on GP0 at 115 200 baud.
 *
 * A button between GP15 and ground is seen. Options are a text in the last sector of a flash of 2 MB, ended by a zero or by erased
 * flash. panel=NAME chooses the panel, clock=MHZ how fast pixels go to it at most (62). */
#include "../board/board.h"
#include "../board/line.h"
#include "../board/models.h"
#include "../../hal/panels/ili9341.h"
#include "../../hal/panels/st7789.h"
#include "chip.h"
#include "clocks.h"
#include "port.h"

#if defined(RP2350)
#define BLOCK_BYTES (256u * 1024u)
#else
#define BLOCK_BYTES (128u * 1024u)
#endif
#define OPTIONS_BYTES 128u
#define PIXEL_CLOCK_HZ 62500000u /* beyond what the panels' data sheets promise; modules and short wires take it */
#define PIN_UART_TX 0u
#define PIN_BUTTON 15u /* to ground */
#define BAUD 115200u

extern const volatile uint8_t options_text[]; /* of the linker script */

static _Alignas(8) uint8_t block[BLOCK_BYTES];

void *board_block(size_t *size_bytes) {
    *size_bytes = sizeof block;
    return block;
}

const void *board_model(const scene_script_t *script, size_t *size_bytes) { return models_find(script, size_bytes); }

/* The divisor has six binary places (DDI 0183, 3.3.6). */
static void open_uart(void) {
    const uint32_t divisor = (CLK_SYS_HZ * 4u + BAUD / 2u) / BAUD;

    clocks_reset(RESET_UART0);
    UART0_IBRD = divisor >> 6;
    UART0_FBRD = divisor & 63u;
    UART0_LCRH = UART_LCRH_8N1_FIFO;
    UART0_CTL = UART_CTL_ENABLE;
    GPIO_CTRL(PIN_UART_TX) = FUNCTION_UART;
    PAD(PIN_UART_TX) = PAD_4MA | PAD_IN | PAD_SCHMITT;
}

uint32_t board_clock_us(void) { return TIMER_RAWL; }

static void open_button(void) {
    GPIO_CTRL(PIN_BUTTON) = FUNCTION_SIO;
    PAD(PIN_BUTTON) = PAD_IN | PAD_PULL_UP | PAD_SCHMITT;
}

bool board_button(void) { return !(SIO_IN >> PIN_BUTTON & 1u); }

static bool names(const char *value, const char *name) {
    while (*name && *value == *name) {
        value++;
        name++;
    }
    return *name == 0 && (*value == 0 || *value == ' ');
}

/* The panel that the options name, or the first. */
static const tuile_panel_t *find_panel(const char *options) {
    static const tuile_panel_t *const panels[] = {&tuile_st7789_240x240, &tuile_st7789_240x320, &tuile_ili9341};
    const char *value = line_option(options, "panel");

    for (unsigned i = 0; i < sizeof panels / sizeof panels[0]; i++) {
        if (value && names(value, panels[i]->name)) { return panels[i]; }
    }
    return panels[0];
}

const tuile_display_config_t *board_display(void) {
    static tuile_bus_t bus;
    static tuile_display_config_t config = {.bus = &bus, .pixel_clock_hz = PIXEL_CLOCK_HZ};
    char options[OPTIONS_BYTES];
    const char *clock;

    board_options(options, sizeof options);
    clocks_open();
    port_open(&bus);
    open_uart();
    open_button();
    config.panel = find_panel(options);
    clock = line_option(options, "clock");
    if (clock) { config.pixel_clock_hz = line_value(clock, 0) * 1000000u; }
    return &config;
}

void board_tell(const char *line) {
    for (; *line; line++) {
        while (UART0_FR & UART_FR_TXFF) {}
        UART0_DR = (uint8_t)*line;
    }
    while (UART0_FR & UART_FR_TXFF) {}
    UART0_DR = '\n';
}

/* An emulator has the bytes of the frame and its time; it need not be waited for. */
void board_shown(void) {}

void board_options(char *text, size_t size_bytes) {
    size_t i = 0;

    for (; i + 1 < size_bytes && options_text[i] && options_text[i] != 0xff; i++) {
        text[i] = (char)options_text[i];
    }
    text[i] = 0;
}

/* A debugger or an emulator stops here and finds the code in r0; without one this is a fault, and the core stays in it. */
void board_park(board_code_t code) {
    for (;;) {
        __asm__ volatile("movs r0, %0\n"
                         "bkpt #1" ::"l"(code)
                         : "r0");
    }
}
