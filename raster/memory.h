/* The functions that a compiler may call in a freestanding program too, so every target has them, with or without a <string.h>. */
#ifndef TUILE_MEMORY_H
#define TUILE_MEMORY_H

#include <stddef.h>

void *memcpy(void *restrict to, const void *restrict from, size_t size_bytes);
void *memmove(void *to, const void *from, size_t size_bytes);
void *memset(void *to, int value, size_t size_bytes);

#endif
