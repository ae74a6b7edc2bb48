#include "semihosting.h"

enum {
    SYS_OPEN = 0x01,
    SYS_CLOSE = 0x02,
    SYS_WRITE = 0x05,
    SYS_GET_CMDLINE = 0x15,
    SYS_EXIT_EXTENDED = 0x20,
};
#define OPEN_WB 5u                /* fopen's "wb" */
#define APPLICATION_EXIT 0x20026u /* the reason; the exit code goes with it */

#if defined(__riscv)
/* Three instructions tell a request; they must be uncompressed and lie in one page: RISC-V Semihosting 0.2, chapter 1. */
static intptr_t ask(uintptr_t operation, const void *arguments) {
    register uintptr_t a0 __asm__("a0") = operation;
    register const void *a1 __asm__("a1") = arguments;

    __asm__ volatile(".balign 16\n"
                     ".option push\n"
                     ".option norvc\n"
                     "slli x0, x0, 0x1f\n"
                     "ebreak\n"
                     "srai x0, x0, 7\n"
                     ".option pop\n"
                     : "+r"(a0)
                     : "r"(a1)
                     : "memory");
    return (intptr_t)a0;
}
#else
static intptr_t ask(uintptr_t operation, const void *arguments) {
    register uintptr_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = arguments;

    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return (intptr_t)r0;
}
#endif

static volatile bool asking;

bool semihosting_asking(void) { return asking; }

static intptr_t request(uintptr_t operation, const void *arguments) {
    intptr_t answer;

    asking = true;
    answer = ask(operation, arguments);
    asking = false;
    return answer;
}

void semihosting_exit(uint32_t code) {
    const uintptr_t block[2] = {APPLICATION_EXIT, code};

    for (;;) {
        (void)request(SYS_EXIT_EXTENDED, block);
    }
}

void semihosting_options(char *text, size_t size_bytes) {
    uintptr_t block[2] = {(uintptr_t)text, size_bytes};
    size_t at = 0, first;

    if (request(SYS_GET_CMDLINE, block) != 0) { block[1] = 0; }
    text[block[1] < size_bytes ? block[1] : 0] = 0;
    while (text[at] && text[at] != ' ') {
        at++;
    }
    while (text[at] == ' ') {
        at++;
    }
    for (first = at; text[at]; at++) {
        text[at - first] = text[at];
    }
    text[at - first] = 0;
}

intptr_t semihosting_create(const char *path) {
    uintptr_t block[3] = {(uintptr_t)path, OPEN_WB, 0};

    while (path[block[2]]) {
        block[2]++;
    }
    return request(SYS_OPEN, block);
}

int semihosting_write(intptr_t file, const void *bytes, size_t size_bytes) {
    const uintptr_t block[3] = {(uintptr_t)file, (uintptr_t)bytes, size_bytes};

    return request(SYS_WRITE, block) == 0 ? 0 : -1; /* answers how many bytes were not written */
}

void semihosting_close(intptr_t file) {
    const uintptr_t block[1] = {(uintptr_t)file};

    (void)request(SYS_CLOSE, block);
}
