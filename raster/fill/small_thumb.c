/* Set-up and rows of small triangles in Thumb-2: about 150 instructions a face, 130 flat, and 18 a row, where gcc 12 takes 275, 240
 * and 24. The numbers are those of fill/small.h, to the bit.
 *
 * What pays: the list's loop, set-up and rows are one function, so that a face goes from its record to its pixels in registers, all
 * fourteen of them, and what does not fit there lies at the stack pointer, where two to five words are loaded by one instruction.
 * Rows and pixels share one running depth, light and address: a row moves them from the end of the last span to its own start. Rows
 * are counted from the top corner's centre by shifts of its offset. Light and depth at the first centre are summed with carry into
 * a second word, of which four bits matter (small_at).
 *
 * Instructions: ARMv7-M Architecture Reference Manual (DDI 0403), chapter A7.
 */
#include "../tune.h"

#include "small_thumb.h"

#include <stddef.h>

#include "../assembly.h"

#if ASSEMBLY_THUMB

/* A triangle whose depths are far apart, with its gradients: by registers, r0 ... r7, r9, r10, lr, and what rows keep in memory. */
typedef struct small_far {
    uint32_t to_x;
    uint32_t depth; /* in: depth_light of the first corner; out: at the first centre */
    int32_t y1;
    uint32_t depth_dx; /* in: depth_light of the second */
    int32_t y2;
    uint32_t depth_dy; /* in: of the third */
    int32_t x1, x2;
    uint32_t to_y;
    uint32_t light_dx, light, light_dy;
} small_far_t;

void small_thumb_far(small_far_t *face, uint32_t gouraud);

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

#define LINE(text) text "\n"

/* At the stack pointer, bytes; from LIMIT to COLOUR, and from MATERIAL to GIVEN, as small_run_t has it. The side of the bend is the
 * one that changes there. */
#define FRAME \
    LINE(".equ BEND_SLOPE, 0")   /* of that side, and of the other */ \
    LINE(".equ OTHER_SLOPE, 4") \
    LINE(".equ STRIDE, 8")       /* bytes */ \
    LINE(".equ DEPTH_DY, 12") \
    LINE(".equ LIGHT_DY, 16") \
    LINE(".equ VALUE, 16")       /* flat: the colour */ \
    LINE(".equ FIRST, 20")       /* address of depth in the face's first row and column */ \
    LINE(".equ ROWS_LEFT, 24")   /* of the tile, from that row on */ \
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
    LINE(".equ RUN, 92")         /* small_run_t */ \
    LINE(".equ COUNT, 96") \
    LINE(".equ END, 100") \
    LINE(".equ MATERIAL, 104")   /* and left, width */ \
    LINE(".equ GIVEN, 116") \
    LINE(".equ FAR, 120")        /* small_far_t */ \
    LINE(".equ FRAME, 172") \
    LINE(".equ RUN_LIST, 60")
_Static_assert(offsetof(small_run_t, stride) == 28 && offsetof(small_run_t, material) == 44 && offsetof(small_run_t, list) == 60 &&
                   sizeof(small_run_t) == 72 &&
                   sizeof(small_far_t) == 48 && offsetof(small_far_t, light_dy) == 44,
               "offsets in the assembly");
_Static_assert(sizeof(record_t) == 8 && offsetof(record_t, v0) == 2 && offsetof(record_t, d1) == 4 && offsetof(record_t, d2) == 5 &&
                   offsetof(record_t, material) == 6 && sizeof(vertex_t) == 8 && TRIANGLE_SMALL_DEPTH == 1 << 17,
               "numbers in the assembly");

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

/* To the next face: r0. */
#define COUNTED \
    LINE("10: ldrh r0, [sp, #LIST + 4]") \
    LINE("ldr r1, [sp, #COUNT]") \
    LINE("adds r1, r1, #1") \
    LINE("str r1, [sp, #COUNT]")

/* The first centre: r0 to_x, r9 to_y. Then r8 the reciprocal of the area, r11 and r12 differences of depth. */
#define CENTRE \
    LINE("12: ldrd r9, r12, [sp, #TOP]") \
    LINE("ldrd r11, r10, [sp, #DEPTH]") \
    LINE("sub r9, r9, r8") \
    LINE("asrs r8, r9, #4") \
    LINE("bpl 70f") \
    LINE("and r9, r9, #15") \
    LINE("13: mls r11, r8, r10, r11") \
    LINE("add r12, r12, r8") \
    LINE("rsb r0, r0, #8") \
    LINE("asrs r10, r0, #4") \
    LINE("and r0, r0, #15") \
    LINE("sub r11, r11, r10, lsl #1") \
    LINE("strd r11, r12, [sp, #FIRST]") \
    LINE("mul r8, r7, r2") \
    LINE("mls r8, r6, r4, r8") \
    LINE("mvn r10, #0x80000000") \
    LINE("udiv r8, r10, r8") \
    LINE("lsr r10, r1, #8") \
    LINE("rsb r11, r10, r3, lsr #8") \
    LINE("rsb r12, r10, r5, lsr #8") \
    LINE("add r10, r11, #0x20000") \
    LINE("add lr, r12, #0x20000") \
    LINE("orr r10, r10, lr") \
    LINE("lsrs r10, r10, #18") \
    LINE("bne 71f")

/* r3 dx, DY, r1 at the first centre. */
#define DEPTH(DY) \
    LINE("mul r3, r12, r2") \
    LINE("mls r3, r11, r4, r3") \
    LINE("mul " DY ", r11, r7") \
    LINE("mls " DY ", r12, r6, " DY "") \
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

#define START \
    LINE("14: ldrd r8, r5, [sp, #ROWS_LEFT]") \
    LINE("sub r0, r5, r0, lsl #16") \
    LINE("cmp r2, r4") \
    LINE("bge 40f")

/* It begins above the tile: r9 is to_y. */
#define ABOVE \
    LINE("70: movs r8, #0") \
    LINE("b 13b") \
    LINE("89: str r0, [sp, #LIST]") \
    LINE("b 90f")

/* Is it short, and inside the tile's columns? */
#define TESTS \
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
    LINE("bhs 90f") \
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

/* Back to C, the face at LIST undrawn. */
#define LEAVE \
    LINE("90: ldr r0, [sp, #RUN]") \
    LINE("ldr r1, [sp, #LIST]") \
    LINE("ldrd r3, r2, [sp, #COUNT]") \
    LINE("adds r0, r0, #RUN_LIST") \
    LINE("stm r0, {r1, r2, r3}") \
    LINE("add sp, sp, #FRAME") \
    LINE("pop {r4-r11, pc}")

/* The edges of a triangle, its mid corner being (XM, YM), on the side of the bend, its lowest one (XL, YL); r0 start, r9 to_y, r8
 * rows left of the tile. Then the rows, by r0 address, r1 depth, r3 its dx, r8 rows, r9 the bend's side, r11 the other one.
 * UPPER, LOWER: the slope of the bend's side above and below it, and what keeps it and the other one, r5. RECORD: address of record
 * r0, from r1. LOAD: what else rows want. */
#define EDGES(XM, YM, XL, YL, ROWS, UPPER, KEEP_UPPER, LOWER, KEEP_LOWER, RECORD, LOAD) \
    LINE("lsls r5, " XL ", #20") \
    LINE("sdiv r5, r5, " YL) \
    LINE("mul r11, r5, r9") \
    LINE("add r11, r0, r11, asr #4") \
    LINE("sub r12, r9, " YL) \
    LINE("asr r12, r12, #4")                /* -rows */ \
    LINE("adds r8, r8, r12") \
    LINE("bmi 20f") \
    LINE("21: subs " YL ", " YL ", " YM) \
    LINE("subs " XL ", " XL ", " XM) \
    LINE("subs r8, r9, " YM) \
    LINE("bpl 25f") \
    LINE("lsls " XM ", " XM ", #20") \
    LINE("sdiv " UPPER ", " XM ", " YM) \
    LINE("mul r9, " UPPER ", r9") \
    LINE("add r9, r0, r9, asr #4") \
    KEEP_UPPER \
    LINE("and r5, r8, #15")                 /* from the bend to the next centre */ \
    LINE("asr r8, r8, #4")                  /* -rows above the bend */ \
    LINE("subs r12, r8, r12")               /* rows below it */ \
    LINE("ble 24f") \
    LINE("add r0, r0, " XM ", asr #4") \
    LINE("lsls " XL ", " XL ", #20") \
    LINE("sdiv " XL ", " XL ", " YL) \
    LINE("mul r5, r5, " XL) \
    LINE("add r5, r0, r5, asr #4") \
    LINE("subs r5, r5, " XL) \
    LINE("strd r5, " XL ", [sp, #NEXT_X]") \
    LINE("add r8, r12, r8, lsl #16") \
    LINE("22:") \
    LOAD \
    LINE("mov r12, #0") \
    LINE("b " ROWS) \
    LINE("24: subs r8, r8, r12")            /* none */ \
    LINE("lsls r8, r8, #16") \
    LINE("b 22b") \
    LINE("25: lsls " XL ", " XL ", #20")    /* no rows above the bend: r8 from it to the first centre */ \
    LINE("sdiv " LOWER ", " XL ", " YL) \
    LINE("mul r8, r8, " LOWER) \
    LINE("add r0, r0, " XM ", lsl #16") \
    LINE("add r9, r0, r8, asr #4") \
    KEEP_LOWER \
    LINE("lsl r8, r12, #16") \
    LINE("b 22b") \
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

/* With light: lr, and r10 its dx. r6 ramp, r7 colour. */
#define EDGES_GOURAUD(XM, YM, XL, YL, ROWS) \
    EDGES(XM, YM, XL, YL, ROWS, YM, LINE("strd " YM ", r5, [sp, #BEND_SLOPE]"), XL, LINE("strd " XL ", r5, [sp, #BEND_SLOPE]"), \
          LINE("sub r1, r1, r0, lsl #3"), LINE("ldr r0, [sp, #FIRST]") LINE("ldrd r6, r7, [sp, #RAMP]"))

/* Flat: lr the slope of the bend's side, r10 dy. r6 value, r7 colour. */
#define EDGES_FLAT(XM, YM, XL, YL, ROWS) \
    EDGES(XM, YM, XL, YL, ROWS, "lr", LINE("str r5, [sp, #OTHER_SLOPE]"), "lr", LINE("str r5, [sp, #OTHER_SLOPE]"), \
          LINE("ldr r3, [sp, #16 + RECORD_BYTES]") LINE("mls r1, r0, r3, r1"), \
          LINE("ldrd r6, r0, [sp, #VALUE]") LINE("ldr r7, [sp, #COLOUR]"))

/* LEFT, RIGHT: sides. r8 is -rows * 2^16, with the rows below the bend added. r12: the column that r0, r1 and lr are of. */
#define ROWS_GOURAUD(ENTRY, LEFT, RIGHT) \
    LINE("30: ldm sp, {r2, r4, r5}") \
    LINE("add r9, r9, r2") \
    LINE("add r11, r11, r4") \
    LINE("adds r0, r0, r5") \
    LINE("ldrd r2, r4, [sp, #DEPTH_DY]") \
    LINE("add r1, r1, r2") \
    LINE("add lr, lr, r4") \
    LINE(ENTRY " asr r2, " LEFT ", #20") \
    LINE("cmp r2, " RIGHT ", asr #20") \
    LINE("bge 35f") \
    LINE("sub r4, r2, r12") \
    LINE("asr r12, " RIGHT ", #20") \
    LINE("mla r1, r3, r4, r1") \
    LINE("mla lr, r10, r4, lr") \
    LINE("add r0, r0, r4, lsl #1") \
    LINE("sub r5, r12, r2") \
    LINE("32: ldrh r2, [r0], #2") \
    LINE("cmp r2, r1, lsr #16") \
    LINE("bhs 33f") \
    LINE("lsrs r2, r1, #16") \
    LINE("strh r2, [r0, #-2]") \
    LINE("lsr r2, lr, #26") \
    LINE("ldrh r2, [r6, r2, lsl #1]") \
    LINE("strh r2, [r0, r7]") \
    LINE("33: add r1, r1, r3") \
    LINE("add lr, lr, r10") \
    LINE("subs r5, r5, #1") \
    LINE("bne 32b") \
    LINE("35: adds r8, r8, #0x10000") \
    LINE("bmi 30b") \
    LINE("beq 10b") \
    LINE("rsbs r8, r8, #0") \
    LINE("lsls r8, r8, #16") \
    LINE("ldrd r9, r2, [sp, #NEXT_X]") \
    LINE("str r2, [sp, #BEND_SLOPE]") \
    LINE("b 30b")

#define ROWS_FLAT(ENTRY, LEFT, RIGHT) \
    LINE("30: ldrd r2, r4, [sp, #OTHER_SLOPE]") /* and stride */ \
    LINE("add r9, r9, lr") \
    LINE("add r11, r11, r2") \
    LINE("adds r0, r0, r4") \
    LINE("add r1, r1, r10") \
    LINE(ENTRY " asr r2, " LEFT ", #20") \
    LINE("cmp r2, " RIGHT ", asr #20") \
    LINE("bge 35f") \
    LINE("sub r4, r2, r12") \
    LINE("asr r12, " RIGHT ", #20") \
    LINE("mla r1, r3, r4, r1") \
    LINE("add r0, r0, r4, lsl #1") \
    LINE("sub r5, r12, r2") \
    LINE("32: ldrh r2, [r0], #2") \
    LINE("cmp r2, r1, lsr #16") \
    LINE("bhs 33f") \
    LINE("lsrs r2, r1, #16") \
    LINE("strh r2, [r0, #-2]") \
    LINE("strh r6, [r0, r7]") \
    LINE("33: adds r1, r1, r3") \
    LINE("subs r5, r5, #1") \
    LINE("bne 32b") \
    LINE("35: adds r8, r8, #0x10000") \
    LINE("bmi 30b") \
    LINE("beq 10b") \
    LINE("rsbs r8, r8, #0") \
    LINE("lsls r8, r8, #16") \
    LINE("ldrd r9, lr, [sp, #NEXT_X]") \
    LINE("b 30b")

/* ---- with light at the corners ---- */

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
        /* light: r3, r5 differences; r10 dx; lr at the centre, modulo 2^32 */
        LINE("subs r3, r3, r1")
        LINE("sub r3, r3, r11, lsl #8")
        LINE("subs r5, r5, r1")
        LINE("sub r5, r5, r12, lsl #8")
        LINE("mul r10, r5, r2")
        LINE("mls r10, r3, r4, r10")
        LINE("mul r3, r3, r7")
        LINE("mls r3, r5, r6, r3")
        LINE("smull r10, lr, r10, r8")
        LINE("smull r3, r5, r3, r8")
        LINE("lsr r10, r10, #3")
        LINE("orr r10, r10, lr, lsl #29")
        LINE("asr lr, lr, #3")
        LINE("lsrs r3, r3, #3")
        LINE("orr r3, r3, r5, lsl #29")
        LINE("asrs r5, r5, #3")
        LINE("mul lr, lr, r0")
        LINE("mla lr, r5, r9, lr")
        LINE("mov r5, #0x8000000")          /* half, times 16 */
        LINE("umlal r5, lr, r10, r0")
        LINE("umlal r5, lr, r3, r9")
        LINE("str r3, [sp, #LIGHT_DY]")
        LINE("lsl lr, lr, #28")
        LINE("add lr, lr, r5, lsr #4")
        LINE("add lr, lr, r1, lsl #24")

        /* depth: r3 dx; r1 at the centre */
        DEPTH("r5")
        LINE("str r5, [sp, #DEPTH_DY]")
        START
        EDGES_GOURAUD("r6", "r2", "r7", "r4", "50f")
        LINE("40:")
        EDGES_GOURAUD("r7", "r4", "r6", "r2", "51f"));

    __asm__ volatile(ROWS_GOURAUD("50:", "r9", "r11") ROWS_GOURAUD("51:", "r11", "r9"));

    __asm__ volatile(
        ABOVE
        LINE("71: add r12, sp, #FAR")
        LINE("stm r12, {r0-r7, r9}")
        LINE("mov r0, r12")
        LINE("movs r1, #1")
        LINE("bl small_thumb_far")
        LINE("add r12, sp, #FAR")
        LINE("ldm r12, {r0-r7, r9, r10, lr}")
        LINE("ldr r8, [sp, #FAR + 44]")
        LINE("strd r5, r8, [sp, #DEPTH_DY]")
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

/* ---- flat ---- */

__attribute__((naked, noipa)) void small_thumb_flat(small_run_t *run) {
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
        CENTRE
        DEPTH("r10")
        START
        EDGES_FLAT("r6", "r2", "r7", "r4", "50f")
        LINE("40:")
        EDGES_FLAT("r7", "r4", "r6", "r2", "51f"));

    __asm__ volatile(ROWS_FLAT("50:", "r9", "r11") ROWS_FLAT("51:", "r11", "r9"));

    __asm__ volatile(
        ABOVE
        LINE("71: add r12, sp, #FAR")
        LINE("stm r12, {r0-r7, r9}")
        LINE("mov r0, r12")
        LINE("movs r1, #0")
        LINE("bl small_thumb_far")
        LINE("add r12, sp, #FAR")
        LINE("ldm r12, {r0-r7, r9}")
        LINE("mov r10, r5")
        LINE("b 14b")

        LINE("80: ldr r5, [sp, #MATERIAL]")
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
        LEAVE);
}

/* clang-format on */

#endif
