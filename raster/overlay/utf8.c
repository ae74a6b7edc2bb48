/* UTF-8 as RFC 3629 has it: no overlong forms, no surrogates, nothing beyond U+10FFFF. */
#include "overlay.h"

#define REPLACEMENT 0xfffdu

uint32_t tuile_utf8_next(const char **text) {
    const uint8_t *at = (const uint8_t *)*text;
    const uint32_t lead = *at;
    if (lead == 0) { return 0; }
    *text += 1;
    if (lead < 0x80) { return lead; }
    if (lead < 0xc2 || lead > 0xf4) { return REPLACEMENT; }
    const unsigned more = lead < 0xe0 ? 1 : lead < 0xf0 ? 2 : 3;
    /* Of the second byte; of those behind it 0x80 ... 0xbf. A zero at the end of the text is below all of these. */
    unsigned low = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80, high = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
    uint32_t code = lead & (0x3fu >> more);
    for (unsigned i = 1; i <= more; i++) {
        if (at[i] < low || at[i] > high) { return REPLACEMENT; }
        code = code << 6 | (at[i] & 0x3fu);
        *text += 1;
        low = 0x80, high = 0xbf;
    }
    return code;
}
