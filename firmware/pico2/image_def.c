/* What the boot ROM of an RP2350 looks for in the first 4 KB of flash: a block that says that an image for secure Arm cores is
 * here. Without an entry of its own the image is entered by the vectors at its beginning (RP2350 data sheet, 5.9.5). */
#include <stdint.h>

#define BLOCK_BEGINS 0xffffded3u
#define ITEM_IMAGE_TYPE 0x42u
#define IMAGE_EXECUTABLE 0x0001u
#define IMAGE_SECURE 0x0020u
#define IMAGE_RP2350 0x1000u
#define ITEM_LAST 0xffu
#define BLOCK_ENDS 0xab123579u

__attribute__((section(".image_def"), used)) static const uint32_t image_def[5] = {
    BLOCK_BEGINS,
    (IMAGE_RP2350 | IMAGE_SECURE | IMAGE_EXECUTABLE) << 16 | 1u << 8 | ITEM_IMAGE_TYPE, /* a word; Arm is 0 */
    1u << 8 | ITEM_LAST,                                                                /* a word of items before it */
    0,                                                                                  /* the only block of its loop */
    BLOCK_ENDS,
};
