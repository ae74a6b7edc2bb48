/* Parts that all loops in assembly over small triangles share, with a texture and without: fill/small_thumb.c and
 * fill/textured_thumb.c. Each loop has a frame of its own at the stack pointer, in which it names what parts ask for: RUN, LIST,
 * COUNT, LIGHT_DY, BOUNDS, RIGHT, HANDED, FRAME, RUN_LIST, and KEPT, the bytes that are pushed below it while gradients are made.
 */
#ifndef TUILE_FILL_THUMB_H
#define TUILE_FILL_THUMB_H

#include "../frame/frame.h"
#include "small.h"

#include <stddef.h>

/* Exact gradients, of triangles whose depths are far apart: one in six. They take registers as the macros below have them, r8 being
 * the area, and give r10 light's dx, r3 its dy, r5 light at the first centre, unbiased; or r3 depth's dx, r5 its dy, r1 depth at
 * the first centre. Of the others the latter leaves r8, r11 and r12 with no value. */
void small_thumb_far_light(void);
void small_thumb_far_depth(void);

_Static_assert(offsetof(record_t, v0) == 2 && offsetof(record_t, d1) == 4 && offsetof(record_t, d2) == 5 &&
                   offsetof(record_t, material) == 6 && sizeof(vertex_t) == 8 && TRIANGLE_SMALL_DEPTH == 1 << 17,
               "numbers in the assembly");

/* clang-format off */

#define LINE(text) text "\n"

/* r0 x0, r8 y0, r6 x1, r2 y1, r7 x2, r4 y2, from the first corner for the others. */
#define DIFFERENCES(OF_X) \
    LINE("asrs r8, r0, #16") \
    OF_X \
    LINE("rsb r2, r8, r2, asr #16") \
    LINE("rsb r4, r8, r4, asr #16") \
    LINE("sxth r0, r0")

/* Those of x: below 2^15, and any. */
#define NEAR_DIFFERENCES LINE("subs r6, r2, r0") LINE("sxth r6, r6") LINE("subs r7, r4, r0") LINE("sxth r7, r7")
#define TRUE_DIFFERENCES \
    LINE("sxth r6, r0") LINE("sxth r7, r2") LINE("sub r9, r7, r6") LINE("sxth r7, r4") LINE("subs r7, r7, r6") LINE("mov r6, r9")

/* To the next face: r0. */
#define COUNTED \
    LINE("10: ldrh r0, [sp, #LIST + 4]") \
    LINE("ldr r1, [sp, #COUNT]") \
    LINE("adds r1, r1, #1") \
    LINE("str r1, [sp, #COUNT]")

/* The first centre: r0 to_x, r9 to_y. r10 address of its depth, r8 the tile's rows from there on. PUT_AWAY:
 * of r0 ... r7. Then r0 is start. */
#define CENTRE(PUT_AWAY) \
    LINE("12: ldrd r9, r12, [sp, #TOP]") \
    LINE("ldrd r10, r11, [sp, #DEPTH]") \
    LINE("sub r9, r9, r8") \
    LINE("asrs r8, r9, #4") \
    LINE("bpl 70f") \
    LINE("and r9, r9, #15") \
    LINE("13: mls r10, r8, r11, r10") \
    LINE("add r8, r8, r12") \
    LINE("rsb r0, r0, #8") \
    LINE("asr lr, r0, #4") \
    LINE("and r0, r0, #15") \
    LINE("sub r10, r10, lr, lsl #1") \
    PUT_AWAY \
    LINE("ldr r5, [sp, #START]") \
    LINE("sub r0, r5, r0, lsl #16") \
    LINE("cmp r2, r4") \
    LINE("bge 40f")

/* The edges of a triangle, its mid corner being (XM, YM), on the side of the bend, its lowest one (XL, YL); r0 start, r9 to_y, r8
 * rows left of the tile. Then the first row that is not empty: r8 rows, BEND and lr the bend's side and its slope, OTHER and r5 the
 * other one's, r9 and r10 its to_y and the address of its depth. LAST_OTHER, LAST_BEND: of that side, where it is not held as a
 * first column. RECORD: address of record r0, from r1, the end of the list being in r2. LEFT, RIGHT: sides. EMPTY: a row, that
 * comparison of theirs being true. KEEP: puts away what rows want, and goes on. WHERE: INSIDE, or BESIDE where the triangle may
 * touch columns beside the tile's. */
#define EDGES(XM, YM, XL, YL, BEND, OTHER, LAST_OTHER, LAST_BEND, RECORD, LEFT, RIGHT, EMPTY, KEEP, WHERE) \
    LINE("lsls r5, " XL ", #20") \
    LINE("sdiv r5, r5, " YL) \
    LINE("mul " OTHER ", r5, r9") \
    LINE("add " OTHER ", r0, " OTHER ", asr #4") \
    LAST_OTHER \
    LINE("sub r12, r9, " YL) \
    LINE("asr r12, r12, #4")                /* -rows */ \
    LINE("adds r8, r8, r12") \
    LINE("bmi 20f") \
    LINE("21: subs " YL ", " YL ", " YM) \
    LINE("subs " XL ", " XL ", " XM) \
    LAST_BEND \
    LINE("subs r8, r9, " YM) \
    LINE("bpl 25f") \
    LINE("lsls " XM ", " XM ", #20") \
    LINE("sdiv lr, " XM ", " YM) \
    LINE("mul " BEND ", lr, r9") \
    LINE("add " BEND ", r0, " BEND ", asr #4") \
    LINE("and " YM ", r8, #15")             /* from the bend to the next centre */ \
    LINE("asr r8, r8, #4")                  /* -rows above the bend */ \
    LINE("subs r12, r8, r12")               /* rows below it */ \
    LINE("ble 24f") \
    LINE("add r0, r0, " XM ", asr #4") \
    LINE("lsls " XL ", " XL ", #20") \
    LINE("sdiv " XL ", " XL ", " YL) \
    LINE("mul " YM ", " YM ", " XL) \
    LINE("add " YM ", r0, " YM ", asr #4") \
    LINE("subs " YM ", " YM ", " XL) \
    LINE("strd " YM ", " XL ", [sp, #NEXT_X]") \
    LINE("add r8, r12, r8, lsl #16")        /* -rows * 2^16, with those below the bend added */ \
    LINE("22:") \
    BOUNDS_##WHERE \
    COLUMN_##WHERE(LEFT, RIGHT) \
    LINE(EMPTY " 26f") \
    LINE("23: add r0, r10, r2, lsl #1") \
    KEEP \
    LINE("24: subs r8, r8, r12")            /* none below the bend */ \
    LINE("lsls r8, r8, #16") \
    LINE("b 22b") \
    LINE("25: lsls " XL ", " XL ", #20")    /* none above it: r8 from it to the first centre */ \
    LINE("sdiv lr, " XL ", " YL) \
    LINE("mul r8, r8, lr") \
    LINE("add r0, r0, " XM ", lsl #16") \
    LINE("add " BEND ", r0, r8, asr #4") \
    LINE("lsl r8, r12, #16") \
    LINE("b 22b") \
    LINE("26: adds r8, r8, #0x10000")       /* an empty row */ \
    LINE("bpl 28f") \
    LINE("27: ldr r0, [sp, #STRIDE]") \
    LINE("add " BEND ", " BEND ", lr") \
    LINE("add " OTHER ", " OTHER ", r5") \
    LINE("add r9, r9, #16") \
    LINE("add r10, r10, r0") \
    COLUMN_##WHERE(LEFT, RIGHT) \
    LINE(EMPTY " 26b") \
    LINE("b 23b") \
    LINE("28: beq 10b") \
    LINE("rsbs r8, r8, #0") \
    LINE("lsls r8, r8, #16") \
    LINE("ldrd " BEND ", lr, [sp, #NEXT_X]") \
    LINE("b 27b") \
    LINE("20: sub r12, r12, r8")            /* it reaches below the tile */ \
    BELOW_##WHERE \
    LINE("push {r0, r1, r2, r3}") \
    LINE("ldr r0, [sp, #16 + LIST]") \
    LINE("ldr r1, [sp, #16 + LIMIT + 4]") \
    LINE("ldr r2, [sp, #16 + END]") \
    LINE("strh r0, [r2]") \
    RECORD \
    LINE("movs r3, #0") \
    LINE("strh r3, [r1]")                   /* its next */ \
    LINE("str r1, [sp, #16 + END]") \
    LINE("pop {r0, r1, r2, r3}") \
    LINE("b 21b")

#define BELOW_INSIDE
#define BOUNDS_INSIDE
#define COLUMN_INSIDE(LEFT, RIGHT) LINE("asr r2, " LEFT ", #20") LINE("cmp r2, " RIGHT ", asr #20")

/* One that went to the right is not among those that reach below. */
#define BELOW_BESIDE LINE("ldr r1, [sp, #HANDED]") LINE("cmp r1, #0") LINE("bne 21b")
#define BOUNDS_BESIDE LINE("ldrd r6, r7, [sp, #BOUNDS]")
#define COLUMN_BESIDE(LEFT, RIGHT) \
    LINE("asr r2, " LEFT ", #20") \
    LINE("cmp r2, r6") \
    LINE("it lt") \
    LINE("movlt r2, r6") \
    LINE("asr r12, " RIGHT ", #20") \
    LINE("cmp r12, r7") \
    LINE("it gt") \
    LINE("movgt r12, r7") \
    LINE("cmp r2, r12")

/* The last column of the first row, to r12. */
#define LAST_INSIDE(RIGHT) LINE("asr r12, " RIGHT ", #20")
#define LAST_BESIDE(RIGHT) \
    LINE("ldr r4, [sp, #BOUNDS + 4]") \
    LINE("asr r12, " RIGHT ", #20") \
    LINE("cmp r12, r4") \
    LINE("it gt") \
    LINE("movgt r12, r4")

/* Where a row is not empty: r2 its first column, r4 that less r12, r12 its last column, r5 that less r2. */
#define MOVE_INSIDE(LEFT, RIGHT, EMPTY) \
    LINE("asr r2, " LEFT ", #20") \
    LINE("cmp r2, " RIGHT ", asr #20") \
    LINE(EMPTY " 35f") \
    LINE("sub r4, r2, r12") \
    LINE("asr r12, " RIGHT ", #20") \
    LINE("sub r5, r12, r2")
#define MOVE_BESIDE(LEFT, RIGHT, EMPTY) \
    LINE("ldrd r4, r5, [sp, #BOUNDS]") \
    LINE("asr r2, " LEFT ", #20") \
    LINE("cmp r2, r4") \
    LINE("it lt") \
    LINE("movlt r2, r4") \
    LINE("asr r4, " RIGHT ", #20") \
    LINE("cmp r4, r5") \
    LINE("it lt") \
    LINE("movlt r5, r4") \
    LINE("cmp r2, r5") \
    LINE(EMPTY " 35f") \
    LINE("sub r4, r2, r12") \
    LINE("mov r12, r5") \
    LINE("subs r5, r5, r2")

/* r9, r10, r12: corners' x less the tile's left, r11: its width. LEFT: where these are. Does the face touch no column beside? */
#define TEST_INSIDE(LEFT, TO) \
    LINE("ldrd r10, r11, [sp, #" LEFT "]") \
    LINE("sub r9, r0, r10") \
    LINE("add r10, r9, r6") \
    LINE("add r12, r9, r7") \
    LINE("cmp r9, r11") \
    LINE("itt lo") \
    LINE("cmplo r10, r11") \
    LINE("cmplo r12, r11") \
    LINE("blo " TO)

/* If it reaches beyond the right edge and there is a further column, it goes there: columns_hand_on. HANDED: the place that its
 * number was put, or NULL. RECORD: the address of record r12, from r11, in there. */
#define TO_THE_RIGHT(RECORD) \
    LINE("cmp r9, r11") \
    LINE("itt lt") \
    LINE("cmplt r10, r11") \
    LINE("cmplt r12, r11") \
    LINE("ite lt") \
    LINE("movlt r9, #0") \
    LINE("ldrge r9, [sp, #RIGHT]") \
    LINE("str r9, [sp, #HANDED]") \
    LINE("cmp r9, #0") \
    LINE("beq 83f") \
    LINE("ldr r12, [sp, #LIST]") \
    LINE("ldr r11, [sp, #LIMIT + 4]") \
    LINE("strh r12, [r9]") \
    RECORD \
    LINE("mov r12, #0") \
    LINE("strh r12, [r11]")                 /* its next */ \
    LINE("str r11, [sp, #RIGHT]") \
    LINE("83:")

/* The tile's first column and its last one, which is LESS than width / 16 behind that, from the column of the corner, -lr. */
#define PUT_BOUNDS(LEFT, LESS) \
    LINE("ldrd r11, r12, [sp, #" LEFT "]") \
    LINE("add r11, r11, #7") \
    LINE("add r11, lr, r11, asr #4") \
    LINE("add r12, r11, r12, asr #4") \
    LINE("sub r12, r12, #" LESS) \
    LINE("strd r11, r12, [sp, #BOUNDS]")

/* r11, r12: differences of depth. */
#define DEPTHS \
    LINE("lsr r10, r1, #8") \
    LINE("rsb r11, r10, r3, lsr #8") \
    LINE("rsb r12, r10, r5, lsr #8") \
    LINE("add r10, r11, #0x20000") \
    LINE("add lr, r12, #0x20000") \
    LINE("orr r10, r10, lr") \
    LINE("lsrs r10, r10, #18") \
    LINE("bne 71f")

/* Of light: r10 dx, dy in memory, lr at the first centre, modulo 2^32. HALF: what rounds it, and biases it where wanted, times 16. */
#define LIGHT(HALF) \
    LINE("subs r3, r3, r1") \
    LINE("sub r3, r3, r11, lsl #8") \
    LINE("subs r5, r5, r1") \
    LINE("sub r5, r5, r12, lsl #8") \
    LINE("mul r10, r5, r2") \
    LINE("mls r10, r3, r4, r10") \
    LINE("mul r3, r3, r7") \
    LINE("mls r3, r5, r6, r3") \
    LINE("smull r10, lr, r10, r8") \
    LINE("smull r3, r5, r3, r8") \
    LINE("lsr r10, r10, #3") \
    LINE("orr r10, r10, lr, lsl #29") \
    LINE("asr lr, lr, #3") \
    LINE("lsrs r3, r3, #3") \
    LINE("orr r3, r3, r5, lsl #29") \
    LINE("asrs r5, r5, #3") \
    LINE("mul lr, lr, r0") \
    LINE("mla lr, r5, r9, lr") \
    LINE("mov r5, #" HALF) \
    LINE("umlal r5, lr, r10, r0") \
    LINE("umlal r5, lr, r3, r9") \
    LINE("str r3, [sp, #KEPT + LIGHT_DY]") \
    LINE("lsl lr, lr, #28") \
    LINE("add lr, lr, r5, lsr #4") \
    LINE("add lr, lr, r1, lsl #24")

/* Of depth: r3 dx, DY, r1 at the first centre. */
#define DEPTH(DY) \
    LINE("mul r3, r12, r2") \
    LINE("mls r3, r11, r4, r3") \
    LINE("mul " DY ", r11, r7") \
    LINE("mls " DY ", r12, r6, " DY) \
    LINE("smull r3, r11, r3, r8") \
    LINE("smull " DY ", r12, " DY ", r8") \
    LINE("lsrs r3, r3, #19") \
    LINE("orr r3, r3, r11, lsl #13") \
    LINE("asr r11, r11, #19") \
    LINE("lsr " DY ", " DY ", #19") \
    LINE("orr " DY ", " DY ", r12, lsl #13") \
    LINE("asr r12, r12, #19") \
    LINE("mul r11, r11, r0") \
    LINE("mla r11, r12, r9, r11") \
    LINE("mov r12, #0x80000") \
    LINE("umlal r12, r11, r3, r0") \
    LINE("umlal r12, r11, " DY ", r9") \
    LINE("bic r1, r1, #0xff") \
    LINE("add r1, r1, r12, lsr #4") \
    LINE("add r1, r1, r11, lsl #28")

/* The same where depths are far apart. BIAS: of light. */
#define FAR_AREA LINE("mul r8, r7, r2") LINE("mls r8, r6, r4, r8")
#define FAR_SHADE(BIAS) \
    FAR_AREA \
    LINE("bl small_thumb_far_light") \
    LINE("str r3, [sp, #KEPT + LIGHT_DY]") \
    LINE("push {r5}") \
    LINE("bl small_thumb_far_depth") \
    LINE("pop {lr}") \
    BIAS \
    LINE("str r5, [sp, #KEPT + DEPTH_DY]")

/* It begins above the tile: r9 is to_y. */
#define ABOVE \
    LINE("70: movs r8, #0") \
    LINE("b 13b")

/* Is it short? r6, r2, r7, r4 as above; r9 and r10 are free. */
#define SHORT \
    LINE("movw r10, #1022") \
    LINE("addw r9, r6, #511") \
    LINE("cmp r9, r10") \
    LINE("bhi 90f") \
    LINE("addw r9, r7, #511") \
    LINE("cmp r9, r10") \
    LINE("bhi 90f") \
    LINE("sub r9, r6, r7") \
    LINE("addw r9, r9, #511") \
    LINE("cmp r9, r10") \
    LINE("bhi 90f") \
    LINE("orr r9, r2, r4") \
    LINE("cmp r9, #512") \
    LINE("bhs 90f")

/* Back to C, the face at LIST undrawn, or r0 behind the limit. BEFORE: what else the run, r0, wants to know; REGISTERS: what is put
 * into it from its place on, which r1, r2 and r3 are. */
#define LEAVE(BEFORE, REGISTERS) \
    LINE("89: str r0, [sp, #LIST]") \
    LINE("90: ldr r0, [sp, #RUN]") \
    BEFORE \
    LINE("ldr r1, [sp, #LIST]") \
    LINE("ldrd r3, r2, [sp, #COUNT]") \
    LINE("adds r0, r0, #RUN_LIST") \
    LINE("stm r0, " REGISTERS) \
    LINE("add sp, sp, #FRAME") \
    LINE("pop {r4-r11, pc}")

/* clang-format on */

#endif
