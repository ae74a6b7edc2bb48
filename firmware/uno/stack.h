/* The painted stack (start.S), and what a listener is told. */
#ifndef FIRMWARE_UNO_STACK_H
#define FIRMWARE_UNO_STACK_H

#include <stdint.h>

/* Bytes that the stack has never reached, from its far end on. */
uint16_t uno_stack_unused(void);

#endif
