/* Lets a fuzz target run without a fuzzing engine: compiled with FUZZ_DRIVER defined, the program feeds its target the files named
 * on the command line, or, without any, seeds changed at random, the same ones each time (FUZZ_ROUNDS of them). Otherwise this
 * header is empty and the target is linked with libFuzzer or the like. */
#ifndef TESTS_REFERENCE_FUZZ_DRIVER_H
#define TESTS_REFERENCE_FUZZ_DRIVER_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

#ifdef FUZZ_DRIVER
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_generator.h"

#ifndef FUZZ_ROUNDS
#define FUZZ_ROUNDS 20000
#endif

enum { FUZZ_SIZE_MAX = 8192 };

/* Cuts, repeats, swaps bytes, and writes what parsers stumble over. */
static size_t fuzz_change(uint64_t *state, uint8_t *bytes, size_t size) {
    static const char *const spice[] = {
        "/",   "-",      ".",        ",",   "#", "\n", "\r\n", " ", "0", "9223372036854775807", "/9223372036854775807",
        "1/0", "-32768", "65535.99", "\xff"};
    int changes = scene_generator_between(state, 0, 6);
    for (int i = 0; i < changes && size > 4; i++) {
        size_t at = (size_t)scene_generator_between(state, 0, (int32_t)size - 1);
        size_t length = (size_t)scene_generator_between(state, 1, 12);
        length = length > size - at ? size - at : length;
        switch (scene_generator_between(state, 0, 3)) {
        case 0:
            memmove(bytes + at, bytes + at + length, size - at - length);
            size -= length;
            break;
        case 1:
            if (size + length <= FUZZ_SIZE_MAX) {
                memmove(bytes + at + length, bytes + at, size - at);
                size += length;
            }
            break;
        case 2: bytes[at] = (uint8_t)scene_generator_between(state, 0, 255); break;
        default: {
            const char *word = spice[scene_generator_between(state, 0, (int32_t)(sizeof spice / sizeof spice[0]) - 1)];
            if (size + strlen(word) <= FUZZ_SIZE_MAX) {
                memmove(bytes + at + strlen(word), bytes + at, size - at);
                memcpy(bytes + at, word, strlen(word));
                size += strlen(word);
            }
            break;
        }
        }
    }
    return size;
}

static int fuzz_file(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file) {
        (void)fprintf(stderr, "%s: cannot be opened\n", path);
        return 1;
    }
    static uint8_t bytes[1 << 20];
    size_t size = fread(bytes, 1, sizeof bytes, file);
    (void)fclose(file);
    return LLVMFuzzerTestOneInput(bytes, size);
}

/* seed(n) makes the n-th seed, a string to be released with free, or NULL. */
static int fuzz_drive(int argc, char **argv, char *(*seed)(uint64_t n)) {
    int result = 0;
    for (int i = 1; i < argc; i++) {
        result |= fuzz_file(argv[i]);
    }
    if (argc > 1) { return result; }
    uint64_t state = 1;
    for (uint64_t n = 0; n < FUZZ_ROUNDS; n++) {
        char *text = seed(n);
        if (!text) { return 1; }
        uint8_t work[FUZZ_SIZE_MAX];
        size_t size = strlen(text) < FUZZ_SIZE_MAX ? strlen(text) : FUZZ_SIZE_MAX;
        memcpy(work, text, size);
        free(text);
        size = fuzz_change(&state, work, size);
        uint8_t *exact = malloc(size + 1); /* on the heap and no longer than it is, so that reading past the end is seen */
        if (!exact) { return 1; }
        memcpy(exact, work, size);
        exact = size ? realloc(exact, size) : exact;
        result |= LLVMFuzzerTestOneInput(exact, size);
        free(exact);
    }
    (void)printf("%s: %ld inputs\n", argv[0], (long)FUZZ_ROUNDS);
    return result;
}
#endif

#endif
