/* See twins.h. Runs where tests/bench/qemu/start_arm.S starts it. */
#include "twins.h"

#include <stdarg.h>

#include "../../raster/memory.h"

int guest_main(void);

/* ---- what the compiler may call ---- */

void *memcpy(void *restrict to, const void *restrict from, size_t size_bytes) {
    uint8_t *t = to;
    for (const uint8_t *f = from; size_bytes--; f++) {
        *t++ = *f;
    }
    return to;
}

void *memmove(void *to, const void *from, size_t size_bytes) {
    uint8_t *t = to;
    const uint8_t *f = from;
    if (t <= f) { return memcpy(to, from, size_bytes); }
    while (size_bytes--) {
        t[size_bytes] = f[size_bytes];
    }
    return to;
}

void *memset(void *to, int value, size_t size_bytes) {
    for (uint8_t *t = to; size_bytes--; t++) {
        *t = (uint8_t)value;
    }
    return to;
}

/* ---- semihosting ---- */

static void call(uint32_t operation, uintptr_t argument) {
    register uint32_t r0 __asm__("r0") = operation;
    register uintptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

static void print(const char *text) { call(0x04, (uintptr_t)text); }

static void print_number(int32_t number) {
    char text[12] = {0}, *at = text + sizeof text - 1;
    uint32_t size = number < 0 ? 0u - (uint32_t)number : (uint32_t)number;
    do {
        *--at = (char)('0' + size % 10);
        size /= 10;
    } while (size);
    if (number < 0) { *--at = '-'; }
    print(at);
}

void twins_tell(const char *text, ...) {
    va_list list;
    va_start(list, text);
    while (text) {
        print(text);
        print_number(va_arg(list, int32_t));
        text = va_arg(list, const char *);
    }
    va_end(list);
    print("\n");
}

bool twins_equal(const char *what, const void *assembly, const void *c, size_t size_bytes) {
    for (size_t i = 0; i < size_bytes; i++) {
        const uint8_t a = ((const uint8_t *)assembly)[i], b = ((const uint8_t *)c)[i];
        if (a == b) { continue; }
        print(what);
        twins_tell(": byte ", (int32_t)i, " is ", (int32_t)a, " in assembly, in C ", (int32_t)b, NULL);
        return false;
    }
    return true;
}

int guest_main(void) {
    const uint32_t block[2] = {0x20026, !twins_test()};
    call(0x20, (uintptr_t)block);
    return 0;
}
