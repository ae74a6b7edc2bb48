#include "mcu.h"

#include <string.h>

const sim_mcu_t sim_mcus[] = {
    /* CPSDVSR, even, 2 to 254, times 1 + SCR, 1 to 256: every even divisor up to 512 is among their products. */
    {"rp2040", 125000000, 2, 512, 2, "RP2040 data sheet 4.4.3.4, clk_peri 125 MHz"},
    {"stm32f4", 100000000, 2, 256, 0, "RM0383 20.5.1, BR of SPI_CR1, APB2 100 MHz"},
    {"esp32", 80000000, 1, 512, 1, "ESP32 reference manual 7.7, APB_CLK 80 MHz"},
    {"atmega328p", 16000000, 2, 128, 0, "ATmega328P data sheet 19.5, SPR and SPI2X, 16 MHz"},
};

const size_t sim_mcu_count = sizeof sim_mcus / sizeof sim_mcus[0];

const sim_mcu_t *sim_mcu_find(const char *name) {
    for (size_t i = 0; i < sim_mcu_count; i++) {
        if (strcmp(sim_mcus[i].name, name) == 0) { return &sim_mcus[i]; }
    }
    return NULL;
}

uint32_t sim_mcu_clock(const sim_mcu_t *mcu, uint32_t asked_hz) {
    uint32_t divisor = mcu->least;
    while (divisor < mcu->most && mcu->source_hz / divisor > asked_hz) {
        divisor = mcu->step ? divisor + mcu->step : 2 * divisor;
    }
    /* 125 MHz / 6 is 20833333.3 Hz: asked for 20833333 it must not be taken for faster. */
    return mcu->source_hz / divisor;
}
