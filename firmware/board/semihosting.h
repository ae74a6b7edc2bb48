/* What a debugger or an emulator does for a program that asks for it: Arm's semihosting, which RISC-V has taken over. Operations
 * and their blocks of arguments: Arm, Semihosting for AArch32 and AArch64, release 3, chapter 6.
 *
 * Without somebody who answers, the request is a fault on Arm and a trap on RISC-V: semihosting_asking tells the handler. On Arm the
 * program then goes on: it has no options, and does not end. */
#ifndef TUILE_FIRMWARE_SEMIHOSTING_H
#define TUILE_FIRMWARE_SEMIHOSTING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A request is under way. */
bool semihosting_asking(void);

_Noreturn void semihosting_exit(uint32_t code);

/* The options behind the program's name; "" when there are none, or they do not fit. */
void semihosting_options(char *text, size_t size_bytes);

/* A new file of the host, relative to the emulator's folder. A handle, or -1. */
intptr_t semihosting_create(const char *path);

/* 0, or -1 when not all of it was written. */
int semihosting_write(intptr_t file, const void *bytes, size_t size_bytes);
void semihosting_close(intptr_t file);

#endif
