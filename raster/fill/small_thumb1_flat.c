/* Flat small triangles in Thumb-1: fill/small_thumb1.c. */
#include "../tune.h"

#include "../assembly.h"

#if ASSEMBLY_THUMB1

#include "small_thumb1_gradients.h"

/* clang-format off */

#define ADDRESS LINE("ldr r3, [sp, #RECORD_BYTES]") LINE("muls r0, r3")
#define RECORD LINE("ldr r3, [sp, #16 + RECORD_BYTES]") LINE("muls r0, r3")

/* The colour of the record at r2, out of the ramp: one that is 0 is not made yet. */
#define COLOUR \
    LINE("ldrb r1, [r2, #7]") \
    LINE("lsls r1, r1, #1") \
    LINE("ldr r7, [sp, #RAMP]") \
    LINE("ldrh r1, [r7, r1]") \
    LINE("cmp r1, #0") \
    LINE("beq 90b") \
    LINE("str r1, [sp, #VALUE]")

/* As there is a ramp or not. */
#define GIVEN_COLOUR \
    LINE("ldr r1, [sp, #GIVEN]") \
    LINE("ldr r7, [sp, #RAMP]") \
    LINE("cmp r7, #0") \
    LINE("beq 81f") \
    LINE("ldrb r1, [r2, #7]") \
    LINE("lsls r1, r1, #1") \
    LINE("ldrh r1, [r7, r1]") \
    LINE("cmp r1, #0") \
    LINE("beq 84b") \
    LINE("81: str r1, [sp, #VALUE]")

#define ROWS(SPAN_OF, ENTRY) \
    UNIFIED \
    LINE("30: mov r7, sp") \
    LINE("ldm r7!, {r0, r1, r2, r5}") \
    LINE("add r10, r0") \
    LINE("add r11, r1") \
    LINE("add r12, r2") \
    LINE("add lr, r5") \
    SPAN_OF(ENTRY) \
    LINE("mov r1, r8") \
    LINE("muls r1, r5") \
    LINE("add r1, r12") \
    LINE("lsls r0, r5, #1") \
    LINE("add r0, lr") \
    LINE("b 34f") \
    LINE("33: adds r0, #2") \
    LINE("add r1, r8") \
    LINE("34: ldrh r5, [r0]") \
    LINE("lsrs r7, r1, #16") \
    LINE("cmp r7, r5") \
    LINE("bls 36f") \
    LINE("strh r7, [r0]") \
    LINE("strh r3, [r0, r4]") \
    ENDS

/* r8 dx, r12 depth in column 0, lr its address, r3 the colour, r4 from a pixel's depth to its colour. */
ASSEMBLY_FUNCTION void small_thumb_flat(small_run_t *run) {
    (void)run;
    __asm__ volatile(UNIFIED
        FRAME
        LINE(".equ STRIDE, 12")
        ENTER
        FACE(ADDRESS, COLOUR)
        CORNERS(LINE("beq 90b"))
        DIFFERENCES(NEAR_X)
        CENTRE
        BENDS_LEFT(RECORD));

    __asm__ volatile(UNIFIED BENDS_RIGHT(RECORD) NEAR_AREA);

    __asm__ volatile(UNIFIED
        DEPTHS
        LINE("19: add r7, sp, #ROW")
        LINE("ldm r7!, {r3, r5, r6}")
        LINE("mov lr, r3")
        LINE("ldr r3, [sp, #VALUE]")
        LINE("ldr r4, [sp, #COLOUR]")
        LINE("ldr r0, [sp, #ROWS_AT]")
        LINE("mov pc, r0"));

    __asm__ volatile(ROWS(SPAN, "31") ROWS(SPAN_CLAMPED, "32"));

    __asm__ volatile(UNIFIED
        FAR(, , "0", )
        BESIDE(GIVEN_COLOUR, RECORD));
}

/* clang-format on */

#endif
