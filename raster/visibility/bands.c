#include "bands.h"

#include "../memory.h"

static uint8_t shift_for(int32_t pixels) {
    uint8_t shift = 0;
    while ((pixels - 1) >> shift >= BANDS_EACH_WAY) {
        shift++;
    }
    return shift;
}

void bands_open(bands_t *bands, void *memory, uint32_t places, const face_bounds_t *all) {
    bands->words = memory;
    bands->count = (places + 31) / 32;
    bands->left = all->left;
    bands->top = all->top;
    bands->shift_x = shift_for(all->right - all->left);
    bands->shift_y = shift_for(all->bottom - all->top);
    memset(memory, 0, bands_bytes(places));
}

void bands_set(const bands_t *bands, uint32_t place, const face_bounds_t *box, bool set) {
    uint32_t *bits = bands->words[place / 32];
    const uint32_t bit = 1u << (place % 32);
    if (box->left >= box->right || box->top >= box->bottom) { return; }
    for (int32_t row = (box->top - bands->top) >> bands->shift_y; row <= (box->bottom - 1 - bands->top) >> bands->shift_y; row++) {
        bits[row] = set ? bits[row] | bit : bits[row] & ~bit;
    }
    for (int32_t i = (box->left - bands->left) >> bands->shift_x; i <= (box->right - 1 - bands->left) >> bands->shift_x; i++) {
        uint32_t *column = &bits[BANDS_EACH_WAY + i];
        *column = set ? *column | bit : *column & ~bit;
    }
}

void bands_insert(const bands_t *bands, uint32_t at, uint32_t count) {
    const uint32_t first = at / 32, kept = (2u << (at % 32)) - 1u; /* places up to `at` of its word */
    for (uint32_t word = count / 32; word > first; word--) {
        for (unsigned band = 0; band < 2 * BANDS_EACH_WAY; band++) {
            bands->words[word][band] = bands->words[word][band] << 1 | bands->words[word - 1][band] >> 31;
        }
    }
    for (unsigned band = 0; band < 2 * BANDS_EACH_WAY; band++) {
        uint32_t *bits = &bands->words[first][band];
        *bits = (*bits & kept) | (*bits & ~(kept >> 1)) << 1;
    }
}
