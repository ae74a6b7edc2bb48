#include "core1.h"

#include "chip.h"

#include <stdbool.h>

#define VTOR REGISTER(0xe000ed08u) /* of the core (DDI 0419, B3.2.5) */

static void send_event(void) { __asm__ volatile("dmb\n sev" ::: "memory"); }

static void wait_event(void) { __asm__ volatile("wfe" ::: "memory"); }

static void fifo_drain(void) {
    while (SIO_FIFO_ST & SIO_FIFO_ST_VLD) {
        (void)SIO_FIFO_RD;
    }
}

static uint32_t fifo_answer(uint32_t word) {
    while (!(SIO_FIFO_ST & SIO_FIFO_ST_RDY)) {}
    SIO_FIFO_WR = word;
    send_event();
    while (!(SIO_FIFO_ST & SIO_FIFO_ST_VLD)) {
        wait_event();
    }
    return SIO_FIFO_RD;
}

/* The boot ROM holds core 1 until it has got these words, and repeats each; a wrong answer means from the start (RP2040 data
 * sheet 2.8.2, RP2350 data sheet 5.3). */
void core1_start(void (*entry)(void), void *stack, size_t size_bytes) {
    const uint32_t words[] = {0, 0, 1, VTOR, (uint32_t)((uintptr_t)stack + size_bytes), (uint32_t)(uintptr_t)entry};

    SET_BITS(PSM_FORCE_OFF) = PSM_CORE_1;
    while (!(PSM_FORCE_OFF & PSM_CORE_1)) {}
    CLEAR_BITS(PSM_FORCE_OFF) = PSM_CORE_1;
    for (unsigned i = 0; i < sizeof words / sizeof words[0];) {
        if (words[i] == 0) {
            fifo_drain();
            send_event();
        }
        i = fifo_answer(words[i]) == words[i] ? i + 1u : 0;
    }
}

#if defined(RP2350)
/* Its hardware locks are let go by writes elsewhere (erratum E2); the core has exclusive accesses. */
static uint32_t taken;

static bool take(void) { return __atomic_exchange_n(&taken, 1, __ATOMIC_ACQUIRE) == 0; }

static void give(void) { __atomic_store_n(&taken, 0, __ATOMIC_RELEASE); }
#else
#define SIO_LOCK REGISTER(0xd0000100u) /* a read that takes it gives its bit, a write lets it go (RP2040 data sheet, 2.3.1.3) */

static bool take(void) {
    const bool got = SIO_LOCK != 0;

    __asm__ volatile("dmb" ::: "memory");
    return got;
}

static void give(void) {
    __asm__ volatile("dmb" ::: "memory");
    SIO_LOCK = 1;
}
#endif

static void lock(void *context) {
    (void)context;
    while (!take()) {
        wait_event();
    }
}

static void unlock(void *context) {
    (void)context;
    give();
    send_event();
}

static uint32_t now(void *context) {
    (void)context;
    return TIMER_RAWL;
}

static void pause(void *context) {
    (void)context;
    wait_event();
}

static void notify(void *context) {
    (void)context;
    send_event();
}

const cores_port_t core1_port = {.lock = lock, .unlock = unlock, .now = now, .pause = pause, .notify = notify};
