/* The detailed timings of an EDID's base block, for devices that tell their modes by it. */
#ifndef TUILE_HAL_USB_EDID_H
#define TUILE_HAL_USB_EDID_H

#include <stddef.h>
#include <stdint.h>

#include "gud.h"

/* Writes the modes of its detailed timings as GUD's mode records, the first marked as preferred; interlaced ones are left out.
 * Returns how many, at most 4; 0 as well when the block's header or sum is wrong. */
unsigned tuile_edid_modes(const uint8_t *edid, size_t size_bytes, uint8_t modes[4][TUILE_GUD_MODE_BYTES]);

#endif
