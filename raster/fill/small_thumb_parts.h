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
    LINE(".equ RIGHT, 120")      /* as small_run_t has it */ \
    LINE(".equ CORNERS, 124")    /* r0 ... r7 before sides are made */ \
    LINE(".equ BOUNDS, 156")     /* columns of the tile from the corner's: the first, the last; of faces that touch others */ \
    LINE(".equ HANDED, 164")     /* the face went to the right there; or NULL */ \
    LINE(".equ FRAME, 172") \
    LINE(".equ KEPT, 24")        /* below that while gradients are made: the first row that is not empty */ \
    LINE(".equ RUN_LIST, 60")
_Static_assert(offsetof(small_run_t, stride) == 28 && offsetof(small_run_t, material) == 44 && offsetof(small_run_t, place) == 60 &&
                   offsetof(small_run_t, right) == 72 && SMALL_RUN_SHORT == 256,
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
    LINE("ldm r12, {r1-r8}")            /* material, left, width, given, list, end, count, right */ \
    LINE("add lr, sp, #MATERIAL") \
    LINE("stm lr, {r1-r4, r8}") \
    LINE("strd r7, r6, [sp, #COUNT]") \
    LINE("mov r0, r5") \
    LINE("b 11f")

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
    TEST_INSIDE("MATERIAL + 4", "12b") \
    LINE("b 82f")

/* ROWS: where the face's rows begin. GRADIENTS: AREA. */
#define KEEP(ROWS, GRADIENTS) \
    LINE("strd lr, r5, [sp, #BEND_SLOPE]") \
    LINE("adr r12, " ROWS " + 1")           /* Thumb */ \
    LINE("push {r0, r2, r3, r8, r11, r12}") \
    LINE("b " GRADIENTS)

/* Faces that are known to be short; and those that touch columns beside the tile's. RIGHT_RECORD: TO_THE_RIGHT. */
#define COLUMNS(RECORD, RIGHT_RECORD) \
    LINE("85:") \
    CORNERS \
    DIFFERENCES(NEAR_DIFFERENCES) \
    TEST_INSIDE("MATERIAL + 4", "12b") \
    LINE("82:") \
    TO_THE_RIGHT(RIGHT_RECORD) \
    CENTRE(PUT_BOUNDS("MATERIAL + 4", "2") PUT_AWAY) \
    BENDS_LEFT(RECORD, "53b", "15b", BESIDE) \
    BENDS_RIGHT(RECORD, "54b", "15b", BESIDE) \
    ABOVE \
    LEAVE(LINE("ldr r4, [sp, #RIGHT]"), "{r1, r2, r3, r4}")

/* Left sides are held as the first column, right ones as the last. */
#define BENDS_LEFT(RECORD, ROWS, GRADIENTS, WHERE) \
    EDGES("r6", "r2", "r7", "r4", "r3", "r11", LINE("sub r11, r11, #0x100000"), , RECORD, "r3", "r11", "bgt", \
          KEEP(ROWS, GRADIENTS), WHERE)
#define BENDS_RIGHT(RECORD, ROWS, GRADIENTS, WHERE) \
    LINE("40:") \
    EDGES("r7", "r4", "r6", "r2", "r3", "r11", , LINE("sub r0, r0, #0x100000"), RECORD, "r11", "r3", "bgt", \
          KEEP(ROWS, GRADIENTS), WHERE)
#define PUT_AWAY LINE("add lr, sp, #CORNERS") LINE("stm lr, {r0-r7}")

/* clang-format on */

#endif
