/* Set-up and rows of small triangles in Thumb-2: about 145 instructions a face, 120 flat, and 18 a row, where gcc 12 takes 275, 240
 * and 24. The numbers are those of fill/small.h, to the bit.
 *
 * What pays: the list's loop, set-up and rows are one function, so that a face goes from its record to its pixels in registers, all
 * fourteen of them, and what does not fit there lies at the stack pointer, where two to five words are loaded by one instruction.
 * Sides come first: one face in five or so covers no centre, and its gradients are never made. Rows and pixels share one running
 * depth, light and address: a row moves them from the last pixel of the one above to its own first. Light and depth at the first
 * centre are summed with carry into a second word, of which four bits matter (small_at).
 *
 * Triangles that touch columns beside the tile's have sides and rows of their own, which are clamped, and share the gradients: where
 * a face's rows begin is pushed with its first row, and the last of the gradients pops it into the program counter.
 *
 * Instructions: ARMv7-M Architecture Reference Manual (DDI 0403), chapter A7.
 */
#include "../tune.h"

#include "../assembly.h"
#include "small_thumb.h"

#if ASSEMBLY_THUMB2

#include "small_thumb_parts.h"

/* clang-format off */

/* floor((N << 28) / r8), |N| < 2^18, to N and HIGH, as -1 - floor((-1 - N) / r8) where N is below 0: the upper 32 bits of what is
 * divided, then what they leave with the lower 14. SIGN: any register. */
#define QUOTIENT_OF_LIGHT(N, HIGH, SIGN) \
    LINE("asr " SIGN ", " N ", #31") \
    LINE("eor " N ", " SIGN ", " N ", lsl #14") \
    LINE("udiv " HIGH ", " N ", r8") \
    LINE("mls " N ", " HIGH ", r8, " N) \
    LINE("lsl " N ", " N ", #14") \
    LINE("orr " N ", " N ", " SIGN ", lsr #18") \
    LINE("udiv " N ", " N ", r8") \
    LINE("orr " N ", " N ", " HIGH ", lsl #14") \
    LINE("lsr " HIGH ", " HIGH ", #18") \
    LINE("eor " N ", " N ", " SIGN) \
    LINE("eor " HIGH ", " HIGH ", " SIGN)

/* The same of N and HIGH, below 2^34 in size, times 2^12. */
#define QUOTIENT_OF_DEPTH(N, HIGH, SIGN, REST) \
    LINE("asr " SIGN ", " HIGH ", #31") \
    LINE("eor " N ", " N ", " SIGN) \
    LINE("eor " HIGH ", " HIGH ", " SIGN) \
    LINE("lsr " REST ", " N ", #2") \
    LINE("orr " REST ", " REST ", " HIGH ", lsl #30") \
    LINE("udiv " HIGH ", " REST ", r8") \
    LINE("mls " REST ", " HIGH ", r8, " REST) \
    LINE("lsl " REST ", " REST ", #14") \
    LINE("bfi " REST ", " N ", #12, #2") \
    LINE("orr " REST ", " REST ", " SIGN ", lsr #20") \
    LINE("udiv " N ", " REST ", r8") \
    LINE("orr " N ", " N ", " HIGH ", lsl #14") \
    LINE("lsr " HIGH ", " HIGH ", #18") \
    LINE("eor " N ", " N ", " SIGN) \
    LINE("eor " HIGH ", " HIGH ", " SIGN)

ASSEMBLY_FUNCTION void small_thumb_far_light(void) {
    __asm__ volatile(
        LINE("push {r1, lr}")
        LINE("subs r3, r3, r1")
        LINE("sub r3, r3, r11, lsl #8")
        LINE("subs r5, r5, r1")
        LINE("sub r5, r5, r12, lsl #8")
        LINE("mul r10, r5, r2")
        LINE("mls r10, r3, r4, r10")
        LINE("mul r3, r3, r7")
        LINE("mls r3, r5, r6, r3")
        QUOTIENT_OF_LIGHT("r10", "lr", "r1")
        QUOTIENT_OF_LIGHT("r3", "r5", "r1")
        LINE("ldr r1, [sp]")
        LINE("mul lr, lr, r0")
        LINE("mla lr, r5, r9, lr")
        LINE("mov r5, #0x8000000")          /* half, times 16 */
        LINE("umlal r5, lr, r10, r0")
        LINE("umlal r5, lr, r3, r9")
        LINE("lsrs r5, r5, #4")
        LINE("orr r5, r5, lr, lsl #28")
        LINE("add r5, r5, r1, lsl #24")
        LINE("pop {r1, pc}"));
}

ASSEMBLY_FUNCTION void small_thumb_far_depth(void) {
    __asm__ volatile(
        LINE("push {r1, r10, lr}")
        LINE("smull r3, r1, r12, r2")
        LINE("smull r10, lr, r11, r4")
        LINE("subs r3, r3, r10")
        LINE("sbc r1, r1, lr")
        LINE("smull r5, lr, r11, r7")
        LINE("smull r11, r10, r12, r6")
        LINE("subs r5, r5, r11")
        LINE("sbc lr, lr, r10")
        QUOTIENT_OF_DEPTH("r3", "r1", "r10", "r11")
        QUOTIENT_OF_DEPTH("r5", "lr", "r10", "r11")
        LINE("mul r11, r1, r0")
        LINE("mla r11, lr, r9, r11")
        LINE("ldr r1, [sp]")
        LINE("mov r12, #0x80000")           /* half, times 16 */
        LINE("umlal r12, r11, r3, r0")
        LINE("umlal r12, r11, r5, r9")
        LINE("bic r1, r1, #0xff")
        LINE("add r1, r1, r12, lsr #4")
        LINE("add r1, r1, r11, lsl #28")
        LINE("pop {r8, r10, pc}"));
}

#define RECORD LINE("sub r1, r1, r0, lsl #3")
#define RIGHT_RECORD LINE("sub r11, r11, r12, lsl #3")

/* From the first row on: r0 address, r2 first column, r8 the bend's side, r9 -rows * 2^16, r11 the other side. r1 and lr are at
 * column 0 until they are moved. */
#define FIRST LINE("14: pop {r0, r2, r8, r9, r11, pc}")

/* r12: the column that r0, r1 and lr are of; r6 and r7 ramp and colour. */
#define ROWS(ENTRY, LEFT, RIGHT, WHERE) \
    LINE(ENTRY " ldrd r6, r7, [sp, #RAMP]") \
    LINE("mla r1, r3, r2, r1") \
    LINE("mla lr, r10, r2, lr") \
    LAST_##WHERE(RIGHT) \
    LINE("sub r5, r12, r2") \
    LINE("b 31f") \
    LINE("30: ldm sp, {r2, r4, r5}") \
    LINE("add r8, r8, r2") \
    LINE("add r11, r11, r4") \
    LINE("adds r0, r0, r5") \
    LINE("ldrd r2, r4, [sp, #DEPTH_DY]") \
    LINE("add r1, r1, r2") \
    LINE("add lr, lr, r4") \
    MOVE_##WHERE(LEFT, RIGHT, "bgt") \
    LINE("mla r1, r3, r4, r1") \
    LINE("mla lr, r10, r4, lr") \
    LINE("add r0, r0, r4, lsl #1") \
    LINE("31: ldrh r2, [r0]") \
    LINE("cmp r2, r1, lsr #16") \
    LINE("bhs 33f") \
    LINE("lsrs r2, r1, #16") \
    LINE("strh r2, [r0]") \
    LINE("lsr r2, lr, #26") \
    LINE("ldrh r2, [r6, r2, lsl #1]") \
    LINE("strh r2, [r0, r7]") \
    LINE("33: subs r5, r5, #1") \
    LINE("bmi 35f") \
    LINE("34: add r1, r1, r3") \
    LINE("add lr, lr, r10") \
    LINE("ldrh r2, [r0, #2]!") \
    LINE("cmp r2, r1, lsr #16") \
    LINE("bhs 36f") \
    LINE("lsrs r2, r1, #16") \
    LINE("strh r2, [r0]") \
    LINE("lsr r2, lr, #26") \
    LINE("ldrh r2, [r6, r2, lsl #1]") \
    LINE("strh r2, [r0, r7]") \
    LINE("36: subs r5, r5, #1") \
    LINE("bpl 34b") \
    LINE("35: adds r9, r9, #0x10000") \
    LINE("bmi 30b") \
    LINE("beq 10b") \
    LINE("rsb r9, r9, #0") \
    LINE("lsl r9, r9, #16") \
    LINE("ldrd r8, r2, [sp, #NEXT_X]") \
    LINE("str r2, [sp, #BEND_SLOPE]") \
    LINE("b 30b")

ASSEMBLY_FUNCTION void small_thumb_gouraud(small_run_t *run) {
    (void)run;
    __asm__ volatile(
        ENTER
        COUNTED

        /* r0: the face's record, number + 1 */
        LINE("11: ldrd r1, r2, [sp, #LIMIT]")
        LINE("subs r3, r0, #1")
        LINE("cmp r3, r1")
        LINE("bhs 89f")
        LINE("sub r2, r2, r0, lsl #3")
        LINE("ldrd r3, r4, [r2]")
        LINE("strd r0, r3, [sp, #LIST]")
        LINE("ldrd r1, r5, [sp, #VERTICES]")
        LINE("ubfx r6, r4, #16, #8")
        LINE("cmp r6, r5")
        LINE("bne 80f")
        CORNERS
        DIFFERENCES(NEAR_DIFFERENCES)
        CENTRE(PUT_AWAY)
        BENDS_LEFT(RECORD, "51f", "15f", INSIDE)
        BENDS_RIGHT(RECORD, "52f", "15f", INSIDE)

        AREA
        LIGHT("0x8000000")
        DEPTH("r5")
        LINE("str r5, [sp, #KEPT + DEPTH_DY]")
        FIRST);

    __asm__ volatile(ROWS("51:", "r8", "r11", INSIDE) ROWS("52:", "r11", "r8", INSIDE)
                     ROWS("53:", "r8", "r11", BESIDE) ROWS("54:", "r11", "r8", BESIDE));

    __asm__ volatile(
        ABOVE
        LINE("71:")
        FAR_SHADE()
        LINE("b 14b")

        /* another material, or nothing is known of the face */
        LINE("80: eors r5, r5, r6")
        LINE("cmp r5, #256")                /* SMALL_RUN_SHORT */
        LINE("beq 85f")
        LINE("ldr r5, [sp, #MATERIAL]")
        LINE("cmp r6, r5")
        LINE("bne 90f")
        CORNERS
        DIFFERENCES(TRUE_DIFFERENCES)
        TESTS
        COLUMNS(RECORD, RIGHT_RECORD));
}

/* clang-format on */

#endif
