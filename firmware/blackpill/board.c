/* "Black Pill": STM32F411CE, Cortex-M4F, a crystal of 25 MHz, 128 KB of RAM, and a panel on SPI1 (spi.h). Lines go by USART1 on PA9
 * at 115 200 baud. */
#include "../board/board.h"
#include "../board/models.h"
#include "../board/semihosting.h"
#include "../../hal/panels/st7789.h"
#include "spi.h"
#include "stm32f411.h"

#define BLOCK_BYTES (96u * 1024u)
#define PIN_TX 9u     /* of port A */
#define PIN_BUTTON 0u /* likewise: KEY, to ground */
#define BAUD 115200u

static _Alignas(8) uint8_t block[BLOCK_BYTES];

void dma2_stream_3(void);

typedef void (*handler_t)(void);

/* Behind the exceptions of the core (firmware/cortex_m/start.c); the others are not let in. */
__attribute__((section(".vectors.interrupts"), used)) static const handler_t interrupts[IRQ_COUNT] = {
    [IRQ_DMA2_STREAM_3] = dma2_stream_3,
};

void *board_block(size_t *size_bytes) {
    *size_bytes = sizeof block;
    return block;
}

const void *board_model(const scene_script_t *script, size_t *size_bytes) { return models_find(script, size_bytes); }

/* The regulator first, then flash, then the clock that needs them (5.1.3, 3.4.1). */
static void open_clocks(void) {
    RCC_APB1ENR |= 1u << 28;
    (void)RCC_APB1ENR;
    PWR_CR |= PWR_CR_VOS_SCALE_1;
    RCC_CR |= RCC_CR_HSEON;
    while (!(RCC_CR & RCC_CR_HSERDY)) {}
    RCC_PLLCFGR = PLL_FROM_HSE;
    RCC_CR |= RCC_CR_PLLON;
    while (!(RCC_CR & RCC_CR_PLLRDY)) {}
    FLASH_ACR = FLASH_ACR_3_WAITS;
    RCC_CFGR = RCC_CFGR_APB1_HALF;
    RCC_CFGR = RCC_CFGR_APB1_HALF | RCC_CFGR_SW_PLL;
    while ((RCC_CFGR & RCC_CFGR_SWS) != RCC_CFGR_SWS_PLL) {}
}

static void open_usart(void) {
    RCC_AHB1ENR |= 1u << 0;
    RCC_APB2ENR |= 1u << 4;
    (void)RCC_APB2ENR;
    GPIOA_AFRH |= FUNCTION_USART1 << 4u * (PIN_TX - 8u);
    GPIOA_MODER = (GPIOA_MODER & ~(3u << 2u * PIN_TX)) | MODE_FUNCTION << 2u * PIN_TX;
    USART1_BRR = (CORE_HZ + BAUD / 2u) / BAUD;
    USART1_CR1 = USART_CR1_TRANSMIT;
}

static void open_clock(void) {
    RCC_APB1ENR |= 1u << 3;
    (void)RCC_APB1ENR;
    TIM5_PSC = CORE_HZ / 1000000u - 1u;
    TIM5_EGR = TIM_EGR_UPDATE;
    TIM5_CR1 = TIM_CR1_ENABLE;
}

uint32_t board_clock_us(void) { return TIM5_CNT; }

/* An input after reset; port A has its clock already. */
static void open_button(void) { GPIOA_PUPDR |= PULL_UP << 2u * PIN_BUTTON; }

bool board_button(void) { return !(GPIOA_IDR >> PIN_BUTTON & 1u); }

const tuile_display_config_t *board_display(void) {
    static tuile_bus_t bus;
    static const tuile_display_config_t config = {.bus = &bus, .panel = &tuile_st7789_240x240, .pixel_clock_hz = 50000000};

    open_clocks();
    open_usart();
    open_clock();
    open_button();
    spi_open(&bus);
    return &config;
}

static void put(char c) {
    while (!(USART1_SR & USART_SR_TXE)) {}
    USART1_DR = (uint8_t)c;
}

void board_tell(const char *line) {
    while (*line) {
        put(*line++);
    }
    put('\n');
}

void board_shown(void) {}

/* Nobody starts it with options; a debugger that answers semihosting need not be there. */
void board_options(char *text, size_t size_bytes) {
    (void)size_bytes;
    text[0] = 0;
}

void board_park(board_code_t code) { semihosting_exit(code); }
