/* The second core of RP2040 and RP2350, and what the two agree by (firmware/cores.h). */
#ifndef TUILE_FIRMWARE_RP2_CORE1_H
#define TUILE_FIRMWARE_RP2_CORE1_H

#include "../cores.h"

/* Starts it in entry, which must not return, with a stack of its own: size_bytes from stack, a multiple of 8. Once, after
 * clocks_open. */
void core1_start(void (*entry)(void), void *stack, size_t size_bytes);

/* A lock of the chip, its timer in microseconds, and events. */
extern const cores_port_t core1_port;

#endif
