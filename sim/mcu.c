#include "mcu.h"

#include <string.h>

/* Cycles of an instruction. RV32IMAC stands for Xtensa, which no compiler of Debian makes code for. An iteration of CoreMark is
 * 322 975 instructions of RV32IM (gcc -O2, a published count of a simulated core), so that a core of so many CoreMark a MHz takes
 * 10^6 / that / 322 975 cycles for one of them; caches and flash are in it as far as CoreMark meets them. */
#define CYCLES_OF_COREMARK(per_mhz) ((uint32_t)(1e6 / (per_mhz) / 322975.0 * 1000.0 + 0.5))

/* What the Pico's driver takes for a command or a chunk beyond its bits, in cycles of the RP2040 in its emulator. Nobody has
 * measured the others: they are assumed to take as many. */
#define TRANSFER_CYCLES 430

const sim_mcu_t sim_mcus[] = {
    /* CPSDVSR, even, 2 to 254, times 1 + SCR, 1 to 256: every even divisor up to 512 is among their products. */
    {"rp2040", 125000000, 2, 512, 2, "RP2040 data sheet 4.4.3.4, clk_peri 125 MHz", .core_hz = 125000000, .core = "cortex-m0plus",
     .cycles_milli = 1400, .cycles_from = "measured in rp2040js, without waits for flash", .transfer_cycles = TRANSFER_CYCLES,
     .queues = true},
    {"stm32f4", 100000000, 2, 256, 0, "RM0383 20.5.1, BR of SPI_CR1, APB2 100 MHz", .core_hz = 100000000, .core = "cortex-m4",
     .cycles_milli = 1480, .cycles_from = "the cycles of the Cortex-M4 TRM over what is counted, without waits for flash",
     .transfer_cycles = TRANSFER_CYCLES},
    {"esp32", 80000000, 1, 512, 1, "ESP32 reference manual 7.7, APB_CLK 80 MHz", .core_hz = 240000000, .core = "rv32imac",
     .cycles_milli = CYCLES_OF_COREMARK(2.10),
     .cycles_from = "one core, 2.10 CoreMark a MHz by the data sheet; RV32IMAC stands for Xtensa",
     .transfer_cycles = TRANSFER_CYCLES},
    {"esp32c3", 80000000, 1, 512, 1, "ESP32-C3 reference manual, SPI_CLOCK_REG, APB_CLK 80 MHz", .core_hz = 160000000,
     .core = "rv32imac", .cycles_milli = CYCLES_OF_COREMARK(2.55), .cycles_from = "2.55 CoreMark a MHz by the data sheet",
     .transfer_cycles = TRANSFER_CYCLES},
    {"atmega328p", 16000000, 2, 128, 0, "ATmega328P data sheet 19.5, SPR and SPI2X, 16 MHz", .core_hz = 16000000, .core = "compact",
     .cycles_milli = 1000, .cycles_from = "cycles of the compact renderer, which is what fits there, in simavr", .polled = true},
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

uint32_t sim_mcu_transfer_ns(const sim_mcu_t *mcu) {
    return (uint32_t)(((uint64_t)mcu->transfer_cycles * 1000000000u + mcu->core_hz - 1u) / mcu->core_hz);
}
