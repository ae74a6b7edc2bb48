/* The frame of fill/textured_thumb1.c, its way in and out, and what is seldom. */
#ifndef TUILE_FILL_TEXTURED_THUMB1_PARTS_H
#define TUILE_FILL_TEXTURED_THUMB1_PARTS_H

#include "textured_thumb.h"

#include <stddef.h>

/* A triangle whose depths are far apart, then its gradients. */
typedef struct textured_far {
    uint32_t to_x, to_y;
    uint32_t depth_light[3]; /* out: depth at the centre, dx, dy */
    int32_t x1, y1, x2, y2;
    uint32_t light, light_dx, light_dy; /* out */
} textured_far_t;

_Static_assert(offsetof(textured_far_t, x1) == 20 && sizeof(textured_far_t) == 48, "offsets in the assembly");
_Static_assert(offsetof(textured_run_t, palette) == 16 && offsetof(textured_run_t, source) == 32 &&
                   offsetof(textured_run_t, s_inside) == 64 && offsetof(textured_run_t, level) == 80 &&
                   offsetof(textured_run_t, left) == 120 && offsetof(textured_run_t, other) == 128 &&
                   offsetof(textured_run_t, place) == 176 && sizeof(textured_run_level_t) == 40 &&
                   offsetof(textured_run_level_t, lower) == 16 && offsetof(textured_run_level_t, s_unit) == 32,
               "offsets in the assembly");
_Static_assert(offsetof(record_t, v0) == 2 && offsetof(record_t, d1) == 4 && offsetof(record_t, d2) == 5 &&
                   offsetof(record_t, material) == 6 && offsetof(record_surface_t, source) == 8 && sizeof(vertex_t) == 8 &&
                   TRIANGLE_SMALL_DEPTH == 1 << 17 && TEXTURED_FRACTION == 8 && TEXTURED_BIAS == 1 << 25 && DIVIDE_TABLE == 512,
               "numbers in the assembly");

/* clang-format off */

#define LINE(text) text "\n"

/* gcc takes what it is given for the older syntax here. */
#define UNIFIED LINE(".syntax unified")

/* At the stack pointer, bytes. */
#define FRAME \
    LINE(".equ BELOW, 0")        /* rows below the bend, and of the part that is being filled */ \
    LINE(".equ ROWS, 4") \
    LINE(".equ SIDES, 8")        /* left and right side, and their slopes */ \
    LINE(".equ DEPTH_DY, 24") \
    LINE(".equ LIGHT_DY, 28") \
    LINE(".equ MAP_DY, 32") \
    LINE(".equ STRIDE, 36")      /* bytes */ \
    LINE(".equ COLOUR, 40")      /* from a pixel's depth to its colour, bytes; and the mask */ \
    LINE(".equ MASK, 44") \
    LINE(".equ COLUMN, 48")      /* the column that all is at */ \
    LINE(".equ FIELD, 52")       /* of green, 6 bits above its own place */ \
    LINE(".equ NEXT_X, 56")      /* the side below the bend, a row before its first, and its slope */ \
    LINE(".equ NEXT_SLOPE, 60") \
    LINE(".equ TABLE, 64")       /* divide_table */ \
    LINE(".equ START, 68")       /* small_start(0) */ \
    LINE(".equ FIRST, 72")       /* address of depth in the face's first row and column */ \
    LINE(".equ ROWS_LEFT, 76")   /* of the tile, from that row on */ \
    LINE(".equ DOWN, 80")        /* rows from the top corner's down to the first one, and what lies above the centre then */ \
    LINE(".equ TO_X, 84")        /* textured_far_t from here on */ \
    LINE(".equ TO_Y, 88") \
    LINE(".equ DEPTH_LIGHT, 92") /* of the first corner, then of the others, or their differences in depth */ \
    LINE(".equ CORNERS, 104")    /* x1, y1, x2, y2 */ \
    LINE(".equ COORDINATES, 120") /* s1, s2, t1, t2; behind gradients of depth and light no more */ \
    LINE(".equ FIRST_COORDINATES, 136") \
    LINE(".equ LIGHTS, 140")     /* of the three corners, as they are */ \
    LINE(".equ OFFSETS, 152")    /* of vertices, 4 bytes for each */ \
    LINE(".equ AREA, 164") \
    LINE(".equ RECIPROCAL, 168") \
    LINE(".equ FRACTION, 172")   /* of the reciprocal, over 2^16 */ \
    LINE(".equ KEPT, OFFSETS")   /* three words, where depths are far apart */ \
    LINE(".equ LIST, 176")       /* the face's record: number + 1, first word */ \
    LINE(".equ RUN, 184")        /* textured_run_t */ \
    LINE(".equ COUNT, 188") \
    LINE(".equ END, 192") \
    LINE(".equ LIGHT_HALF, 196") /* rounds light, and biases it */ \
    LINE(".equ DEPTH_HALF, 200") \
    LINE(".equ COPY, 204")       /* of the run */ \
    LINE(".equ TEXELS, COPY + 4") \
    LINE(".equ PALETTE, COPY + 16") \
    LINE(".equ LIMIT, COPY + 20") \
    LINE(".equ ARENA, COPY + 24") \
    LINE(".equ RECORD_BYTES, COPY + 28") \
    LINE(".equ SOURCE, COPY + 32") \
    LINE(".equ KNOWN, COPY + 36") \
    LINE(".equ VERTICES, COPY + 40") \
    LINE(".equ TEXCOORDS, COPY + 44") \
    LINE(".equ TOP, COPY + 48") \
    LINE(".equ HEIGHT, COPY + 52") \
    LINE(".equ DEPTH, COPY + 56") \
    LINE(".equ S_INSIDE, COPY + 64") \
    LINE(".equ ACROSS, COPY + 68") \
    LINE(".equ ONE, COPY + 72") \
    LINE(".equ LOG2_ONE, COPY + 76") \
    LINE(".equ LEVEL, COPY + 80") \
    LINE(".equ LEFT, COPY + 120")     /* and width */ \
    LINE(".equ OTHER, COPY + 128")    /* and mask, texels */ \
    LINE(".equ RUN_LIST, 176") \
    LINE(".equ FRAME, COPY + 176") \
    LINE(".equ FROM_CORNER, 0")       /* of a level */ \
    LINE(".equ ALWAYS, 4") \
    LINE(".equ UPPER, 8") \
    LINE(".equ PIXELS_UP, 12") \
    LINE(".equ LOWER, 16") \
    LINE(".equ UP, 20") \
    LINE(".equ LEVEL_DOWN, 24") \
    LINE(".equ T_UNIT, 28") \
    LINE(".equ S_UNIT, 32")

/* The run into the frame, and back to C, the face at LIST undrawn. r0: the first face. */
#define ENTER \
    LINE("push {r4-r7, lr}") \
    LINE("mov r4, r8") \
    LINE("mov r5, r9") \
    LINE("mov r6, r10") \
    LINE("mov r7, r11") \
    LINE("push {r4-r7}") \
    LINE("sub sp, #FRAME") \
    LINE("str r0, [sp, #RUN]") \
    LINE("movs r1, #0x3f")              /* 2^20 - 64 = 0x3fff * 64 */ \
    LINE("lsls r1, r1, #8") \
    LINE("adds r1, #0xff") \
    LINE("lsls r1, r1, #6") \
    LINE("str r1, [sp, #START]") \
    LINE("movs r1, #0x3f") \
    LINE("lsls r1, r1, #11") \
    LINE("str r1, [sp, #FIELD]") \
    LINE("movs r1, #0x28") \
    LINE("lsls r1, r1, #20") \
    LINE("str r1, [sp, #LIGHT_HALF]") \
    LINE("movs r1, #0x80") \
    LINE("lsls r1, r1, #8") \
    LINE("str r1, [sp, #DEPTH_HALF]") \
    LINE("ldr r1, 1f") \
    LINE("str r1, [sp, #TABLE]") \
    LINE("b 2f") \
    LINE(".align 2") \
    LINE("1: .word divide_table") \
    LINE("2: add r1, sp, #COPY") \
    LINE("movs r4, #7") \
    LINE("mov r8, r4") \
    LINE("3: ldmia r0!, {r2-r7}") \
    LINE("stmia r1!, {r2-r7}") \
    LINE("mov r2, r8") \
    LINE("subs r2, #1") \
    LINE("mov r8, r2") \
    LINE("bne 3b") \
    LINE("ldmia r0!, {r2, r3, r4, r5, r6}") /* the last two; list, end, count */ \
    LINE("stmia r1!, {r2, r3}") \
    LINE("str r5, [sp, #END]") \
    LINE("str r6, [sp, #COUNT]") \
    LINE("ldr r0, [sp, #COPY + 60]") \
    LINE("str r0, [sp, #STRIDE]") \
    LINE("ldr r0, [sp, #COPY + 8]") \
    LINE("adds r0, #2") \
    LINE("str r0, [sp, #COLOUR]") \
    LINE("ldr r0, [sp, #COPY]") \
    LINE("str r0, [sp, #MASK]") \
    LINE("movs r0, r4") \
    LINE("b 11f") \
    LINE("90: ldr r0, [sp, #RUN]") \
    LINE("ldr r1, [sp, #LIST]") \
    LINE("ldr r2, [sp, #END]") \
    LINE("ldr r3, [sp, #COUNT]") \
    LINE("adds r0, #RUN_LIST") \
    LINE("stmia r0!, {r1, r2, r3}") \
    LINE("add sp, #FRAME") \
    LINE("pop {r4-r7}") \
    LINE("mov r8, r4") \
    LINE("mov r9, r5") \
    LINE("mov r10, r6") \
    LINE("mov r11, r7") \
    LINE("pop {r4-r7, pc}")

/* Nothing is known of the face: is it short, and inside the tile's columns? */
#define IS_SMALL \
    LINE("80: movs r7, #255") \
    LINE("lsls r7, r7, #2") \
    LINE("adds r7, #2")                 /* 1022 */ \
    LINE("mov r11, r7") \
    LINE("lsrs r7, r7, #1") \
    LINE("adds r1, r2, r7") \
    LINE("cmp r1, r11") \
    LINE("bhi 88b") \
    LINE("adds r1, r4, r7") \
    LINE("cmp r1, r11") \
    LINE("bhi 88b") \
    LINE("subs r1, r2, r4") \
    LINE("adds r1, r1, r7") \
    LINE("cmp r1, r11") \
    LINE("bhi 88b") \
    LINE("movs r1, r3") \
    LINE("orrs r1, r5") \
    LINE("lsrs r1, r1, #9") \
    LINE("bne 88b") \
    LINE("ldr r7, [sp, #LEFT]") \
    LINE("subs r7, r0, r7") \
    LINE("ldr r1, [sp, #LEFT + 4]") \
    LINE("cmp r7, r1") \
    LINE("bhs 88b") \
    LINE("adds r7, r7, r2") \
    LINE("cmp r7, r1") \
    LINE("bhs 88b") \
    LINE("subs r7, r7, r2") \
    LINE("adds r7, r7, r4") \
    LINE("cmp r7, r1") \
    LINE("blo 12b") \
    LINE("b 88b")

/* Another level: the other one? Then they change places. */
#define OTHER_LEVEL \
    LINE("91: mov r7, r9") \
    LINE("ldr r0, [sp, #OTHER + UPPER]") \
    LINE("lsrs r7, r0") \
    LINE("cmp r7, r11") \
    LINE("bhi 88b") \
    LINE("mov r7, r9") \
    LINE("ldr r0, [sp, #OTHER + LOWER]") \
    LINE("lsrs r7, r0") \
    LINE("ldr r0, [sp, #OTHER + ALWAYS]") \
    LINE("orrs r7, r0") \
    LINE("cmp r7, r11") \
    LINE("bls 88b") \
    LINE("push {r1-r5}") \
    LINE("add r0, sp, #20 + LEVEL") \
    LINE("add r1, sp, #20 + OTHER") \
    LINE("movs r7, #5") \
    LINE("92: ldmia r0!, {r2, r3}") \
    LINE("ldmia r1!, {r4, r5}") \
    LINE("subs r0, #8") \
    LINE("subs r1, #8") \
    LINE("stmia r0!, {r4, r5}") \
    LINE("stmia r1!, {r2, r3}") \
    LINE("subs r7, #1") \
    LINE("bne 92b") \
    LINE("ldr r2, [sp, #20 + MASK]") \
    LINE("ldr r3, [sp, #20 + TEXELS]") \
    LINE("ldmia r1!, {r4, r5}") \
    LINE("str r4, [sp, #20 + MASK]") \
    LINE("str r5, [sp, #20 + TEXELS]") \
    LINE("subs r1, #8") \
    LINE("stmia r1!, {r2, r3}") \
    LINE("pop {r1-r5}") \
    LINE("b 14b")

/* 29: onto the list of those that reach below; r0 and r7 are free. */
#define REACHES_BELOW \
    LINE("29: push {r1, r2}") \
    LINE("ldr r0, [sp, #8 + LIST]") \
    LINE("ldr r1, [sp, #8 + END]") \
    LINE("strh r0, [r1]") \
    LINE("ldr r1, [sp, #8 + RECORD_BYTES]") \
    LINE("muls r0, r1, r0") \
    LINE("ldr r1, [sp, #8 + ARENA]") \
    LINE("subs r1, r1, r0") \
    LINE("movs r0, #0") \
    LINE("strh r0, [r1]")               /* its next */ \
    LINE("str r1, [sp, #8 + END]") \
    LINE("pop {r1, r2}") \
    LINE("bx lr")

/* clang-format on */

#endif
