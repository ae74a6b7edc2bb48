/* Flat small triangles in Thumb-2: fill/small_thumb.c. */
#include "../tune.h"

#include "../assembly.h"
#include "small_thumb.h"

#if ASSEMBLY_THUMB2

#include "small_thumb_parts.h"

/* clang-format off */

#define RECORD LINE("ldr r3, [sp, #16 + RECORD_BYTES]") LINE("mls r1, r0, r3, r1")
#define RIGHT_RECORD LINE("ldr r10, [sp, #RECORD_BYTES]") LINE("mls r11, r12, r10, r11")

/* From the first row on: r0 address, r2 first column, r8 the bend's side, r9 -rows * 2^16, r11 the other side. r1 is at column 0
 * until it is moved. */
#define FIRST LINE("14: pop {r0, r2, r8, r9, r11, pc}")

/* r12: the column that r0 and r1 are of; r6 and r7 value and colour; lr the slope of the bend's side. */
#define ROWS(ENTRY, LEFT, RIGHT, WHERE) \
    LINE(ENTRY " ldr lr, [sp, #BEND_SLOPE]") \
    LINE("ldrd r7, r6, [sp, #COLOUR]") \
    LINE("mla r1, r3, r2, r1") \
    LAST_##WHERE(RIGHT) \
    LINE("sub r5, r12, r2") \
    LINE("b 31f") \
    LINE("30: ldrd r2, r4, [sp, #OTHER_SLOPE]") /* and stride */ \
    LINE("add r8, r8, lr") \
    LINE("add r11, r11, r2") \
    LINE("adds r0, r0, r4") \
    LINE("add r1, r1, r10") \
    MOVE_##WHERE(LEFT, RIGHT, "bgt") \
    LINE("mla r1, r3, r4, r1") \
    LINE("add r0, r0, r4, lsl #1") \
    LINE("31: ldrh r2, [r0]") \
    LINE("cmp r2, r1, lsr #16") \
    LINE("bhs 33f") \
    LINE("lsrs r2, r1, #16") \
    LINE("strh r2, [r0]") \
    LINE("strh r6, [r0, r7]") \
    LINE("33: subs r5, r5, #1") \
    LINE("bmi 35f") \
    LINE("34: adds r1, r1, r3") \
    LINE("ldrh r2, [r0, #2]!") \
    LINE("cmp r2, r1, lsr #16") \
    LINE("bhs 36f") \
    LINE("lsrs r2, r1, #16") \
    LINE("strh r2, [r0]") \
    LINE("strh r6, [r0, r7]") \
    LINE("36: subs r5, r5, #1") \
    LINE("bpl 34b") \
    LINE("35: adds r9, r9, #0x10000") \
    LINE("bmi 30b") \
    LINE("beq 10b") \
    LINE("rsb r9, r9, #0") \
    LINE("lsl r9, r9, #16") \
    LINE("ldrd r8, lr, [sp, #NEXT_X]") \
    LINE("b 30b")

ASSEMBLY_FUNCTION void small_thumb_flat(small_run_t *run) {
    (void)run;
    __asm__ volatile(
        ENTER
        COUNTED

        /* r0: the face's record, number + 1 */
        LINE("11: ldrd r1, r2, [sp, #LIMIT]")
        LINE("subs r3, r0, #1")
        LINE("cmp r3, r1")
        LINE("bhs 89f")
        LINE("ldrd r4, r7, [sp, #RECORD_BYTES]")
        LINE("mls r2, r0, r4, r2")
        LINE("ldrd r3, r4, [r2]")
        LINE("strd r0, r3, [sp, #LIST]")
        LINE("ldrd r1, r5, [sp, #VERTICES]")
        LINE("ubfx r6, r4, #16, #8")
        LINE("cmp r6, r5")
        LINE("bne 80f")
        LINE("lsrs r6, r4, #24")
        LINE("ldrh r6, [r7, r6, lsl #1]")
        LINE("cmp r6, #0")
        LINE("beq 90f")
        LINE("str r6, [sp, #VALUE]")
        CORNERS
        DIFFERENCES(NEAR_DIFFERENCES)
        CENTRE(PUT_AWAY)
        BENDS_LEFT(RECORD, "51f", "15f", INSIDE)
        BENDS_RIGHT(RECORD, "52f", "15f", INSIDE)

        AREA
        DEPTH("r10")
        FIRST);

    __asm__ volatile(ROWS("51:", "r8", "r11", INSIDE) ROWS("52:", "r11", "r8", INSIDE)
                     ROWS("53:", "r8", "r11", BESIDE) ROWS("54:", "r11", "r8", BESIDE));

    __asm__ volatile(
        ABOVE
        LINE("71:")
        FAR_AREA
        LINE("bl small_thumb_far_depth")
        LINE("mov r10, r5")
        LINE("b 14b")

        LINE("80: eors r5, r5, r6")
        LINE("cmp r5, #256")                /* SMALL_RUN_SHORT */
        LINE("beq 83f")
        LINE("ldr r5, [sp, #MATERIAL]")
        LINE("cmp r6, r5")
        LINE("bne 90f")
        LINE("ldr r6, [sp, #GIVEN]")
        LINE("cbz r7, 81f")                 /* no ramp */
        LINE("lsrs r6, r4, #24")
        LINE("ldrh r6, [r7, r6, lsl #1]")
        LINE("cmp r6, #0")
        LINE("beq 90f")
        LINE("81: str r6, [sp, #VALUE]")
        CORNERS
        DIFFERENCES(TRUE_DIFFERENCES)
        TESTS
        LINE("83: lsrs r6, r4, #24")
        LINE("ldrh r6, [r7, r6, lsl #1]")
        LINE("cmp r6, #0")
        LINE("beq 90f")
        LINE("str r6, [sp, #VALUE]")
        COLUMNS(RECORD, RIGHT_RECORD));
}

/* clang-format on */

#endif
