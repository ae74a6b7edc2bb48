/* The functions that a compiler calls by itself, for boards without a C library. Built with -fno-tree-loop-distribute-patterns:
 * else each would become a call of itself. */
#include "../../raster/memory.h"

#include <stdint.h>

int memcmp(const void *a, const void *b, size_t size_bytes);

typedef uint32_t __attribute__((may_alias)) word_t; /* of objects of any type */

static int aligned(const void *a, const void *b) { return (((uintptr_t)a | (uintptr_t)b) & 3u) == 0; }

void *memcpy(void *restrict to, const void *restrict from, size_t size_bytes) {
    uint8_t *t = to;
    const uint8_t *f = from;

    if (aligned(to, from)) {
        word_t *words = to;
        const word_t *from_words = from;

        for (; size_bytes >= 4; size_bytes -= 4) {
            *words++ = *from_words++;
        }
        t = (uint8_t *)words;
        f = (const uint8_t *)from_words;
    }
    for (; size_bytes; size_bytes--) {
        *t++ = *f++;
    }
    return to;
}

void *memmove(void *to, const void *from, size_t size_bytes) {
    uint8_t *t = to;
    const uint8_t *f = from;

    if ((uintptr_t)to - (uintptr_t)from >= size_bytes) { return memcpy(to, from, size_bytes); }
    while (size_bytes--) {
        t[size_bytes] = f[size_bytes];
    }
    return to;
}

void *memset(void *to, int value, size_t size_bytes) {
    uint8_t *t = to;

    if (aligned(to, to)) {
        const uint32_t word = (uint8_t)value * 0x01010101u;
        word_t *words = to;

        for (; size_bytes >= 4; size_bytes -= 4) {
            *words++ = word;
        }
        t = (uint8_t *)words;
    }
    for (; size_bytes; size_bytes--) {
        *t++ = (uint8_t)value;
    }
    return to;
}

int memcmp(const void *a, const void *b, size_t size_bytes) {
    const uint8_t *x = a, *y = b;

    for (; size_bytes; size_bytes--, x++, y++) {
        if (*x != *y) { return *x < *y ? -1 : 1; }
    }
    return 0;
}
