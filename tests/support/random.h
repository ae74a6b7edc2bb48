/* Random numbers that are the same on every machine: xorshift64*. */
#ifndef TESTS_SUPPORT_RANDOM_H
#define TESTS_SUPPORT_RANDOM_H

#include <stdint.h>

typedef struct random_source {
    uint64_t state; /* not 0 */
} random_source_t;

random_source_t random_seed(uint64_t seed);
uint64_t random_bits(random_source_t *source);

/* low ... high, both included. */
int32_t random_between(random_source_t *source, int32_t low, int32_t high);

/* One in n. */
int random_one_in(random_source_t *source, uint32_t n);

/* A signed number of at most `bits` bits whose magnitude is spread over all sizes; bits <= 62. */
int64_t random_any_size(random_source_t *source, unsigned bits);

/* low <= x < high */
double random_real(random_source_t *source, double low, double high);

#endif
