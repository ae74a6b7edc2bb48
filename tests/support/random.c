#include "random.h"

random_source_t random_seed(uint64_t seed) {
    random_source_t source = {seed * UINT64_C(0x9e3779b97f4a7c15) + 1};
    if (source.state == 0) { source.state = 1; }
    for (int i = 0; i < 8; i++) {
        (void)random_bits(&source);
    }
    return source;
}

uint64_t random_bits(random_source_t *source) {
    uint64_t x = source->state;
    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    source->state = x;
    return x * UINT64_C(0x2545f4914f6cdd1d);
}

int32_t random_between(random_source_t *source, int32_t low, int32_t high) {
    const uint64_t range = (uint64_t)((int64_t)high - low) + 1;
    return (int32_t)(low + (int64_t)(((random_bits(source) >> 32) * range) >> 32));
}

int random_one_in(random_source_t *source, uint32_t n) { return random_between(source, 1, (int32_t)n) == 1; }

int64_t random_any_size(random_source_t *source, unsigned bits) {
    const unsigned size = (unsigned)random_between(source, 0, (int32_t)bits);
    const int64_t magnitude = (int64_t)(random_bits(source) >> 1 >> (63 - size));
    return random_one_in(source, 2) ? -magnitude : magnitude;
}

double random_real(random_source_t *source, double low, double high) {
    return low + (high - low) * ((double)(random_bits(source) >> 11) * 0x1p-53);
}
