/* Parts of the loops in assembly that flat triangles and those with light share: see fill/small_thumb.c. */
#ifndef TUILE_FILL_SMALL_THUMB_PARTS_H
#define TUILE_FILL_SMALL_THUMB_PARTS_H

#include "small_thumb.h"
#include "thumb.h"

/* clang-format off */

/* At the stack pointer, bytes; from LIMIT to COLOUR, and from MATERIAL to GIVEN, as small_run_t has it. The side of the bend is the
 * one that changes there. */
#define FRAME \
    LINE(".equ BEND_SLOPE, 0")   /* of that side, and of the other */ \
    LINE(".equ OTHER_SLOPE, 4") \
    LINE(".equ STRIDE, 8")       /* bytes */ \
    LINE(".equ DEPTH_DY, 12") \
    LINE(".equ LIGHT_DY, 16") \
    LINE(".equ RUN, 20")         /* small_run_t */ \
    LINE(".equ START, 28")       /* small_start(0) */ \
    LINE(".equ NEXT_X, 32")      /* the side below the bend, a row before its first, and its slope */ \
    LINE(".equ LIST, 40")        /* the face's record: number + 1, first word */ \
    LINE(".equ LIMIT, 48") \
    LINE(".equ VERTICES, 56") \
    LINE(".equ TOP, 64") \
    LINE(".equ DEPTH, 72") \
    LINE(".equ RECORD_BYTES, 80") \
    LINE(".equ RAMP, 84") \
    LINE(".equ COLOUR, 88") \
    LINE(".equ VALUE, 92")       /* flat: the colour */ \
    LINE(".equ COUNT, 96") \
    LINE(".equ END, 100") \
    LINE(".equ MATERIAL, 104")   /* and left, width */ \
    LINE(".equ GIVEN, 116") \
    LINE(".equ CORNERS, 120")    /* r0 ... r7 before sides are made */ \
    LINE(".equ FRAME, 156") \
    LINE(".equ KEPT, 24")        /* below that while gradients are made: the first row that is not empty */ \
    LINE(".equ RUN_LIST, 60")
_Static_assert(offsetof(small_run_t, stride) == 28 && offsetof(small_run_t, material) == 44 && offsetof(small_run_t, place) == 60 &&
                   sizeof(small_run_t) == 72,
               "offsets in the assembly");
_Static_assert(sizeof(record_t) == 8, "numbers in the assembly");

/* r4: second word of the record r2, r3: its first word, r1: vertices. To r0 depth and light ... of three corners: r0 x|y, r1, r2,
 * r3, r4, r5. */
#define CORNERS \
    LINE("lsls r7, r4, #24") \
    LINE("beq 90f")                         /* no triangle */ \
    LINE("lsrs r3, r3, #16") \
    LINE("add r8, r1, r3, lsl #3") \
    LINE("add r9, r8, r7, asr #21") \
    LINE("sbfx r10, r4, #8, #8") \
    LINE("add r10, r8, r10, lsl #3") \
    LINE("ldrd r0, r1, [r8]") \
    LINE("ldrd r2, r3, [r9]") \
    LINE("ldrd r4, r5, [r10]")

/* The run into the frame. r0: the first face. */
#define ENTER \
    FRAME \
    LINE("push {r4-r11, lr}") \
    LINE("sub sp, sp, #FRAME") \
    LINE("str r0, [sp, #RUN]") \
    LINE("ldr r1, [r0, #28]") \
    LINE("str r1, [sp, #STRIDE]") \
    LINE("movw r1, #0xffc0") \
    LINE("movt r1, #0xf") \
    LINE("str r1, [sp, #START]") \
    LINE("mov r12, r0") \
    LINE("add lr, sp, #LIMIT") \
    LINE("ldm r12!, {r1-r11}") \
    LINE("stm lr, {r1-r11}") \
    LINE("ldm r12, {r1-r7}")            /* material, left, width, given, list, end, count */ \
    LINE("add lr, sp, #MATERIAL") \
    LINE("stm lr, {r1-r4}") \
    LINE("strd r7, r6, [sp, #COUNT]") \
    LINE("mov r0, r5") \
    LINE("b 11f")

/* The first centre: r0 to_x, r9 to_y. r10 address of its depth, r8 the tile's rows from there on. Then r0 ... r7 are put away, and
 * r0 is start. */
#define CENTRE \
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
    LINE("add lr, sp, #CORNERS") \
    LINE("stm lr, {r0-r7}") \
    LINE("ldr r5, [sp, #START]") \
    LINE("sub r0, r5, r0, lsl #16") \
    LINE("cmp r2, r4") \
    LINE("bge 40f")

/* r8: reciprocal of the area; r11, r12: differences of depth. */
#define AREA \
    LINE("15: add lr, sp, #KEPT + CORNERS") \
    LINE("ldm lr, {r0-r7}") \
    LINE("mul r8, r7, r2") \
    LINE("mls r8, r6, r4, r8") \
    LINE("mvn r10, #0x80000000") \
    LINE("udiv r8, r10, r8") \
    DEPTHS

/* Is it short, and inside the tile's columns? */
#define TESTS \
    SHORT \
    LINE("ldrd r10, r11, [sp, #MATERIAL + 4]") \
    LINE("sub r9, r0, r10") \
    LINE("add r10, r9, r6") \
    LINE("add r12, r9, r7") \
    LINE("cmp r9, r11") \
    LINE("it lo") \
    LINE("cmplo r10, r11") \
    LINE("it lo") \
    LINE("cmplo r12, r11") \
    LINE("blo 12b")

/* The edges of a triangle, its mid corner being (XM, YM), on the side of the bend, its lowest one (XL, YL); r0 start, r9 to_y, r8
 * rows left of the tile. Left sides are held as the first column, right ones as the last. Then the first row that is not empty:
 * r8 rows, r3 and lr the bend's side and its slope, r11 and r5 the other one's, r9 and r10 its to_y and the address of its depth.
 * LAST_OTHER, LAST_BEND: make that side a right one. RECORD: address of record r0, from r1. LEFT, RIGHT: sides. KEEP: puts
 * away what rows want. */
#define EDGES(XM, YM, XL, YL, LAST_OTHER, LAST_BEND, RECORD, LEFT, RIGHT, KEEP) \
    LINE("lsls r5, " XL ", #20") \
    LINE("sdiv r5, r5, " YL) \
    LINE("mul r11, r5, r9") \
    LINE("add r11, r0, r11, asr #4") \
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
    LINE("mul r3, lr, r9") \
    LINE("add r3, r0, r3, asr #4") \
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
    LINE("22: asr r2, " LEFT ", #20") \
    LINE("cmp r2, " RIGHT ", asr #20") \
    LINE("bgt 26f") \
    LINE("23: add r0, r10, r2, lsl #1") \
    KEEP \
    LINE("b 15f") \
    LINE("24: subs r8, r8, r12")            /* none below the bend */ \
    LINE("lsls r8, r8, #16") \
    LINE("b 22b") \
    LINE("25: lsls " XL ", " XL ", #20")    /* none above it: r8 from it to the first centre */ \
    LINE("sdiv lr, " XL ", " YL) \
    LINE("mul r8, r8, lr") \
    LINE("add r0, r0, " XM ", lsl #16") \
    LINE("add r3, r0, r8, asr #4") \
    LINE("lsl r8, r12, #16") \
    LINE("b 22b") \
    LINE("26: adds r8, r8, #0x10000")       /* an empty row */ \
    LINE("bpl 28f") \
    LINE("27: ldr r0, [sp, #STRIDE]") \
    LINE("add r3, r3, lr") \
    LINE("add r11, r11, r5") \
    LINE("add r9, r9, #16") \
    LINE("add r10, r10, r0") \
    LINE("asr r2, " LEFT ", #20") \
    LINE("cmp r2, " RIGHT ", asr #20") \
    LINE("bgt 26b") \
    LINE("b 23b") \
    LINE("28: beq 10b") \
    LINE("rsbs r8, r8, #0") \
    LINE("lsls r8, r8, #16") \
    LINE("ldrd r3, lr, [sp, #NEXT_X]") \
    LINE("b 27b") \
    LINE("20: sub r12, r12, r8")            /* it reaches below the tile */ \
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
#define BENDS_LEFT(RECORD, KEEP) \
    EDGES("r6", "r2", "r7", "r4", LINE("sub r11, r11, #0x100000"), , RECORD, "r3", "r11", KEEP)
#define BENDS_RIGHT(RECORD, KEEP) \
    LINE("40:") EDGES("r7", "r4", "r6", "r2", , LINE("sub r0, r0, #0x100000"), RECORD, "r11", "r3", KEEP)

/* clang-format on */

#endif
