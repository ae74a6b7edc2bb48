/* Set-up and rows of small triangles in Thumb-2: about 145 instructions a face, 120 flat, and 18 a row, where gcc 12 takes 275, 240
 * and 24. The numbers are those of fill/small.h, to the bit.
 *
 * What pays: the list's loop, set-up and rows are one function, so that a face goes from its record to its pixels in registers, all
 * fourteen of them, and what does not fit there lies at the stack pointer, where two to five words are loaded by one instruction.
 * Sides come first: one face in five or so covers no centre, and its gradients are never made. Rows and pixels share one running
 * depth, light and address: a row moves them from the last pixel of the one above to its own first. Light and depth at the first
 * centre are summed with carry into a second word, of which four bits matter (small_at).
 *
 * Instructions: ARMv7-M Architecture Reference Manual (DDI 0403), chapter A7.
 */
#include "../tune.h"

#include "../assembly.h"
#include "small_thumb.h"

#if ASSEMBLY_THUMB2

#include "small_thumb_parts.h"

void small_thumb_far(small_far_t *face, uint32_t gouraud) {
    const small_corners_t corners = {0, 0, face->x1, face->y1, face->x2, face->y2};
    const vertex_t v0 = {0, 0, face->depth};
    const int32_t z0 = (int32_t)(face->depth >> 8), light0 = (int32_t)(face->depth & 0xff);
    const triangle_gradients_t g =
        small_gradients_exact(&corners, (int32_t)(face->depth_dx >> 8) - z0, (int32_t)(face->depth_dy >> 8) - z0,
                              (int32_t)(face->depth_dx & 0xff) - light0, (int32_t)(face->depth_dy & 0xff) - light0, gouraud != 0);
    face->depth = (uint32_t)small_at(g.depth, triangle_depth_of(&v0), (small_int_t)face->to_x, (small_int_t)face->to_y);
    face->depth_dx = (uint32_t)g.depth.dx;
    face->depth_dy = (uint32_t)g.depth.dy;
    if (!gouraud) { return; }
    face->light = (uint32_t)small_at(g.light, triangle_light_of(&v0), (small_int_t)face->to_x, (small_int_t)face->to_y);
    face->light_dx = (uint32_t)g.light.dx;
    face->light_dy = (uint32_t)g.light.dy;
}

/* clang-format off */

#define RECORD LINE("sub r1, r1, r0, lsl #3")

/* Slopes of the bend's side and of the other one in memory. */
#define KEEP LINE("strd lr, r5, [sp, #BEND_SLOPE]") LINE("push {r0, r2, r3, r8, r11, r12}")

/* From the first row on: r0 address, r2 first column, r8 the bend's side, r9 -rows * 2^16, r11 the other side, r6 and r7 ramp
 * and colour. r1 and lr are at column 0 until they are moved. */
#define FIRST \
    LINE("14: cmp r2, r4") \
    LINE("pop {r0, r2, r8, r9, r11, r12}") \
    LINE("ldrd r6, r7, [sp, #RAMP]") \
    LINE("mla r1, r3, r2, r1") \
    LINE("mla lr, r10, r2, lr") \
    LINE("bge 51f")

/* r12: the column that r0, r1 and lr are of. */
#define ROWS(ENTRY, LEFT, RIGHT) \
    LINE(ENTRY) \
    LINE("asr r12, " RIGHT ", #20") \
    LINE("sub r5, r12, r2") \
    LINE("b 31f") \
    LINE("30: ldm sp, {r2, r4, r5}") \
    LINE("add r8, r8, r2") \
    LINE("add r11, r11, r4") \
    LINE("adds r0, r0, r5") \
    LINE("ldrd r2, r4, [sp, #DEPTH_DY]") \
    LINE("add r1, r1, r2") \
    LINE("add lr, lr, r4") \
    LINE("asr r2, " LEFT ", #20") \
    LINE("cmp r2, " RIGHT ", asr #20") \
    LINE("bgt 35f") \
    LINE("sub r4, r2, r12") \
    LINE("asr r12, " RIGHT ", #20") \
    LINE("mla r1, r3, r4, r1") \
    LINE("mla lr, r10, r4, lr") \
    LINE("add r0, r0, r4, lsl #1") \
    LINE("sub r5, r12, r2") \
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

__attribute__((naked, noipa)) void small_thumb_gouraud(small_run_t *run) {
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
        CENTRE
        BENDS_LEFT(RECORD, KEEP)
        BENDS_RIGHT(RECORD, KEEP)

        AREA
        LIGHT("0x8000000")
        DEPTH("r5")
        LINE("str r5, [sp, #KEPT + DEPTH_DY]")
        FIRST);

    __asm__ volatile(ROWS("", "r8", "r11") ROWS("51:", "r11", "r8"));

    __asm__ volatile(
        ABOVE
        LINE("71: add r0, sp, #KEPT + CORNERS")
        LINE("str r9, [r0, #32]")
        LINE("movs r1, #1")
        LINE("bl small_thumb_far")
        LINE("add r12, sp, #KEPT + CORNERS")
        LINE("ldm r12, {r0-r7, r9, r10, lr}")
        LINE("ldr r8, [sp, #KEPT + CORNERS + 44]")
        LINE("strd r5, r8, [sp, #KEPT + DEPTH_DY]")
        LINE("b 14b")

        /* another material, or nothing is known of the face */
        LINE("80: ldr r5, [sp, #MATERIAL]")
        LINE("cmp r6, r5")
        LINE("bne 90f")
        CORNERS
        DIFFERENCES(TRUE_DIFFERENCES)
        TESTS
        LEAVE);
}

/* clang-format on */

#endif
