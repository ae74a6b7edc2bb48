/* The frame of fill/textured_thumb1.c, its way in and out, and what is seldom. */
#ifndef TUILE_FILL_TEXTURED_THUMB1_PARTS_H
#define TUILE_FILL_TEXTURED_THUMB1_PARTS_H

#include "textured_thumb.h"
#include "thumb1.h"

#include <stddef.h>

/* Of area / 512, by how many places area is to be shifted to the right to be in 256 ... 511: fill/small_thumb1.c. */
extern const uint8_t small_thumb1_shifts[512];

/* A triangle whose depths are far apart, as it lies at the stack pointer, then its gradients. */
typedef struct textured_far {
    uint32_t depth_light[3]; /* out: depth at the centre, dx, dy */
    int32_t x1, y1, x2, y2;
    uint32_t light, light_dx, light_dy; /* out */
} textured_far_t;

_Static_assert(offsetof(textured_far_t, x1) == 12 && sizeof(textured_far_t) == 40, "offsets in the assembly");
_Static_assert(offsetof(textured_run_t, palette) == 16 && offsetof(textured_run_t, source) == 32 &&
                   offsetof(textured_run_t, top) == 48 && offsetof(textured_run_t, pixels_up) == 76 &&
                   offsetof(textured_run_t, s_inside) == 112 && offsetof(textured_run_t, place) == 132 &&
                   offsetof(textured_run_t, levels) == 144 && offsetof(textured_run_t, right) == 508 &&
                   sizeof(textured_run_level_t) == 40 && offsetof(textured_run_level_t, always) == 8 &&
                   offsetof(textured_run_level_t, from_corner) == 28,
               "offsets in the assembly");
_Static_assert(sizeof(source_slot_t) == 2 * sizeof(vertex_t) && offsetof(source_slot_t, instance) == 4 &&
                   offsetof(source_slot_t, colours) == 6 && offsetof(source_slot_t, attributes) == 8,
               "numbers in the assembly");
_Static_assert(offsetof(record_t, v0) == 2 && offsetof(record_t, d1) == 4 && offsetof(record_t, d2) == 5 &&
                   offsetof(record_t, material) == 6 && offsetof(record_surface_t, source) == 8 && sizeof(vertex_t) == 8 &&
                   TRIANGLE_SMALL_DEPTH == 1 << 17 && TEXTURED_FRACTION == 8 && TEXTURED_BIAS == 1 << 25 && DIVIDE_TABLE == 512 &&
                   sizeof(divide_side_t) == 8 && offsetof(divide_side_t, inverse) == 4,
               "numbers in the assembly");

/* clang-format off */

/* At the stack pointer, bytes. */
#define FRAME \
    LINE(".equ BELOW, 0")            /* rows below the bend, and of the part that is being filled */ \
    LINE(".equ ROWS, 4") \
    LINE(".equ SIDES, 8")            /* left and right side, and their slopes */ \
    LINE(".equ DEPTH_DY, 24") \
    LINE(".equ LIGHT_DY, 28") \
    LINE(".equ MAP_DY, 32") \
    LINE(".equ STRIDE, 36")          /* bytes */ \
    LINE(".equ COLOUR, 40")          /* from a pixel's depth to its colour, bytes */ \
    LINE(".equ MASK, 44")            /* of the level */ \
    LINE(".equ TEXELS, 48") \
    LINE(".equ COLUMN, 52")          /* the column that all is at */ \
    LINE(".equ UPPER, 56")           /* of the level, as textured_run_level_t has it */ \
    LINE(".equ LOWER, 60") \
    LINE(".equ ALWAYS, 64") \
    LINE(".equ UP, 68") \
    LINE(".equ LEVEL_DOWN, 72") \
    LINE(".equ T_UNIT, 76") \
    LINE(".equ S_UNIT, 80") \
    LINE(".equ FROM_CORNER, 84") \
    LINE(".equ NEXT_X, 88")          /* the side below the bend, a row before its first, and its slope */ \
    LINE(".equ NEXT_SLOPE, 92") \
    LINE(".equ FIRST, 96")           /* address of depth in the face's first row and column */ \
    LINE(".equ ROWS_LEFT, 100")      /* of the tile, from that row on */ \
    LINE(".equ DOWN, 104")           /* rows from the top corner's down to the first one, and what lies above the centre then */ \
    LINE(".equ TO_X, 108") \
    LINE(".equ TO_Y, 112") \
    LINE(".equ LIGHTS, 116")         /* depth and light of the second and third corner */ \
    LINE(".equ DEPTH_LIGHT, 124")    /* of the first one; textured_far_t */ \
    LINE(".equ DEPTHS, 128")         /* of the others, from the first one's */ \
    LINE(".equ CORNERS, 136")        /* x1, y1, x2, y2 */ \
    LINE(".equ COORDINATES, 152")    /* s1, s2, t1, t2 */ \
    LINE(".equ FIRST_COORDINATES, 168") \
    LINE(".equ OFFSETS, 172")        /* of vertices, 4 bytes for each */ \
    LINE(".equ AREA, 184") \
    LINE(".equ RECIPROCAL, 188") \
    LINE(".equ FRACTION, 192")       /* of the reciprocal, over 2^16 */ \
    LINE(".equ LIST, 196")           /* number + 1 of the face's record, and its first word */ \
    LINE(".equ RUN, 204")            /* textured_run_t */ \
    LINE(".equ COUNT, 208") \
    LINE(".equ END, 212") \
    LINE(".equ LEAST_AREA, 216")     /* of faces that are not to be looked at: 8, or where they are not known any is less */ \
    LINE(".equ SLOPES, 220")           /* divide_sides */ \
    LINE(".equ TABLE, 224")          /* divide_table, small_thumb1_shifts */ \
    LINE(".equ SHIFTS, 228") \
    LINE(".equ START, 232")          /* small_start(0) */ \
    LINE(".equ ONES, 236")           /* 2^31 - 1 */ \
    LINE(".equ NEAR, 240")           /* TRIANGLE_SMALL_DEPTH */ \
    LINE(".equ ROUND, 244")          /* of colours, red, green and blue */ \
    LINE(".equ FIELD, 248")          /* of green, 6 bits above its own place */ \
    LINE(".equ PALETTE, 252")        /* of the run, as all to PIXELS_UP */ \
    LINE(".equ LIMIT, 256") \
    LINE(".equ ARENA, 260") \
    LINE(".equ RECORD_BYTES, 264") \
    LINE(".equ SOURCE, 268") \
    LINE(".equ KNOWN, 272") \
    LINE(".equ VERTICES, 276") \
    LINE(".equ TEXCOORDS, 280") \
    LINE(".equ TOP, 284") \
    LINE(".equ HEIGHT, 288") \
    LINE(".equ DEPTH, 292") \
    LINE(".equ RUN_STRIDE, 296") \
    LINE(".equ ACROSS, 300") \
    LINE(".equ ONE, 304") \
    LINE(".equ LOG2_ONE, 308") \
    LINE(".equ PIXELS_UP, 312") \
    LINE(".equ S_INSIDE, 316")       /* and as all to the width */ \
    LINE(".equ INSTANCE, 320") \
    LINE(".equ MODEL_TEXCOORDS, 324") \
    LINE(".equ LEFT, 328")           /* and width */ \
    LINE(".equ KEPT, OFFSETS")           /* three words, where depths are far apart */ \
    LINE(".equ RIGHT, 336")           /* where the next face for the column to the right is put, or 0 */ \
    LINE(".equ BESIDE, 340")          /* not 0: the face touches columns beside the tile's; 2: it goes to the right */ \
    LINE(".equ CLAMP_LEFT, 344")      /* the tile's columns, from the face's own */ \
    LINE(".equ CLAMP_RIGHT, 348") \
    LINE(".equ ROWS_AT, 352")         /* the loop over the face's rows; that of faces inside, and of others */ \
    LINE(".equ PLAIN_AT, 356") \
    LINE(".equ CLAMPED_AT, 360") \
    LINE(".equ FRAME, 364") \
    LINE(".equ RUN_RIGHT, 508") \
    LINE(".equ RUN_SOURCE, 32") \
    LINE(".equ RUN_LIST, 132") \
    LINE(".equ RUN_LEVELS, 144")

/* The run into the frame, and back to C, the face at LIST undrawn. r0: the first face. */
#define ENTER \
    OPEN_FRAME \
    LINE("str r0, [sp, #RUN]") \
    LINE("adr r1, 1f") \
    LINE("ldmia r1!, {r2-r4, r6}") \
    LINE("add r5, sp, #SLOPES") \
    LINE("stmia r5!, {r2-r4, r6}") \
    LINE("ldmia r1!, {r2-r4, r6}") \
    LINE("stmia r5!, {r2-r4, r6}") \
    LINE("ldr r1, [r0, #8]") \
    LINE("adds r1, #2") \
    LINE("str r1, [sp, #COLOUR]") \
    LINE("adds r0, #16") \
    LINE("ldmia r0!, {r1-r4, r6, r7}") \
    LINE("stmia r5!, {r1-r4, r6, r7}") \
    LINE("ldmia r0!, {r1-r4, r6, r7}") \
    LINE("stmia r5!, {r1-r4, r6, r7}") \
    LINE("ldmia r0!, {r1-r4}") \
    LINE("stmia r5!, {r1-r4}") \
    LINE("adds r0, #32") \
    LINE("ldmia r0!, {r1-r4, r6, r7}")      /* and list */ \
    LINE("stmia r5!, {r1-r4, r6}") \
    LINE("ldmia r0!, {r1, r2}") \
    LINE("str r1, [sp, #END]") \
    LINE("str r2, [sp, #COUNT]") \
    LINE("ldr r0, [sp, #RUN]") \
    LINE("movs r1, #RUN_RIGHT / 4") \
    LINE("lsls r1, r1, #2") \
    LINE("ldr r1, [r0, r1]") \
    LINE("str r1, [sp, #RIGHT]") \
    LINE("adr r1, 4f") \
    LINE("ldr r2, [sp, #PALETTE]") \
    LINE("cmp r2, #0") \
    LINE("bne 3f") \
    LINE("adds r1, #8") \
    LINE("3: ldmia r1!, {r2, r3}") \
    LINE("str r2, [sp, #PLAIN_AT]") \
    LINE("str r2, [sp, #ROWS_AT]") \
    LINE("str r3, [sp, #CLAMPED_AT]") \
    LINE("ldr r1, [sp, #RUN_STRIDE]") \
    LINE("str r1, [sp, #STRIDE]") \
    LINE("movs r1, #31")                    /* no level */ \
    LINE("str r1, [sp, #UPPER]") \
    LINE("str r1, [sp, #LOWER]") \
    LINE("movs r1, #0") \
    LINE("str r1, [sp, #ALWAYS]") \
    LINE("str r1, [sp, #BESIDE]") \
    LINE("movs r0, r7") \
    LINE("movs r1, #8") \
    LINE("ldr r2, [sp, #KNOWN]") \
    LINE("cmp r2, #0") \
    LINE("bne 2f") \
    LINE("ldr r1, [sp, #ONES]") \
    LINE("2: str r1, [sp, #LEAST_AREA]") \
    LINE("b 11f") \
    LINE("90: ldr r0, [sp, #RUN]") \
    LINE("ldr r1, [sp, #LIST]") \
    LINE("ldr r2, [sp, #END]") \
    LINE("ldr r3, [sp, #COUNT]") \
    LINE("ldr r4, [sp, #SOURCE]") \
    LINE("str r4, [r0, #RUN_SOURCE]") \
    LINE("ldr r4, [sp, #RIGHT]") \
    LINE("movs r5, #RUN_RIGHT / 4") \
    LINE("lsls r5, r5, #2") \
    LINE("str r4, [r0, r5]") \
    LINE("adds r0, #RUN_LIST") \
    LINE("stmia r0!, {r1, r2, r3}") \
    CLOSE_FRAME \
    LINE(".align 2") \
    LINE("1: .word divide_sides, divide_table, small_thumb1_shifts, 0xfffc0, 0x7fffffff, 0x20000, 0x10420, 0x1f800") \
    LINE("4: .word 73f, 75f, 74f, 76f")

/* Is the face, r7 its area, r9 texels, of the level? ELSE: where to if not. */
#define OF_LEVEL(ELSE) \
    LINE("ldr r0, [sp, #PIXELS_UP]") \
    LINE("lsls r7, r0") \
    LINE("mov r6, r9") \
    LINE("ldr r0, [sp, #UPPER]") \
    LINE("lsrs r6, r0") \
    LINE("cmp r6, r7") \
    LINE("bhi " ELSE) \
    LINE("mov r6, r9") \
    LINE("ldr r0, [sp, #LOWER]") \
    LINE("lsrs r6, r0") \
    LINE("ldr r0, [sp, #ALWAYS]") \
    LINE("orrs r6, r0") \
    LINE("cmp r6, r7") \
    LINE("bls " ELSE)

/* 80: its area, r7, is too small, or nothing is known of the face: is it short, and inside the tile's columns? */
#define IS_SMALL \
    LINE("80: cmp r7, #8") \
    LINE("blt 88b") \
    LINE("ldr r0, [sp, #KNOWN]") \
    LINE("cmp r0, #0") \
    LINE("bne 88b") \
    LINE("movs r7, #255") \
    LINE("lsls r7, r7, #2") \
    LINE("adds r7, #2")                 /* 1022 */ \
    LINE("mov r11, r7") \
    LINE("lsrs r7, r7, #1") \
    LINE("adds r6, r2, r7") \
    LINE("cmp r6, r11") \
    LINE("bhi 88b") \
    LINE("adds r6, r4, r7") \
    LINE("cmp r6, r11") \
    LINE("bhi 88b") \
    LINE("subs r6, r2, r4") \
    LINE("adds r6, r6, r7") \
    LINE("cmp r6, r11") \
    LINE("bhi 88b") \
    LINE("movs r6, r3") \
    LINE("orrs r6, r5") \
    LINE("lsrs r6, r6, #9") \
    LINE("bne 88b") \
    LINE("ldr r0, [sp, #OFFSETS]")      /* x0 */ \
    LINE("lsls r0, r0, #1") \
    LINE("ldr r7, [sp, #VERTICES]") \
    LINE("ldr r7, [r7, r0]") \
    LINE("sxth r7, r7") \
    LINE("ldr r0, [sp, #LEFT]") \
    LINE("subs r0, r7, r0") \
    LINE("mov r11, r7") \
    LINE("ldr r6, [sp, #LEFT + 4]") \
    LINE("cmp r0, r6") \
    LINE("bhs 84f") \
    LINE("adds r7, r0, r2") \
    LINE("cmp r7, r6") \
    LINE("bhs 84f") \
    LINE("adds r7, r0, r4") \
    LINE("cmp r7, r6") \
    LINE("bhs 84f") \
    LINE("movs r0, #0") \
    LINE("str r0, [sp, #BESIDE]") \
    LINE("ldr r0, [sp, #PLAIN_AT]") \
    LINE("str r0, [sp, #ROWS_AT]") \
    LINE("ldr r7, [sp, #AREA]") \
    LINE("b 81b") \
    LINE("83: b 88b") \
    LINE("84: cmp r0, r6")              /* it is not: does it reach beyond the right edge, to another column? */ \
    LINE("bge 85f") \
    LINE("adds r7, r0, r2") \
    LINE("cmp r7, r6") \
    LINE("bge 85f") \
    LINE("adds r7, r0, r4") \
    LINE("cmp r7, r6") \
    LINE("blt 89f") \
    LINE("85: movs r0, #2") \
    LINE("ldr r7, [sp, #RIGHT]") \
    LINE("cmp r7, #0") \
    LINE("bne 94f") \
    LINE("89: movs r0, #1") \
    LINE("94: str r0, [sp, #BESIDE]") \
    LINE("mov r7, r11") \
    LINE("movs r0, #8") \
    LINE("subs r0, r0, r7") \
    LINE("asrs r0, r0, #4")             /* -column */ \
    LINE("ldr r7, [sp, #LEFT]") \
    LINE("adds r7, #7") \
    LINE("asrs r7, r7, #4") \
    LINE("adds r0, r0, r7") \
    LINE("str r0, [sp, #CLAMP_LEFT]") \
    LINE("asrs r6, r6, #4") \
    LINE("subs r6, #1") \
    LINE("adds r0, r0, r6") \
    LINE("str r0, [sp, #CLAMP_RIGHT]") \
    LINE("ldr r0, [sp, #CLAMPED_AT]") \
    LINE("str r0, [sp, #ROWS_AT]") \
    LINE("ldr r7, [sp, #AREA]") \
    OF_LEVEL("92f") \
    LINE("b 97f") \
    LINE("92: b 91f")

/* 91: another level, the first that is not too fine: does the run have it? r7 pixels, r9 texels. */
#define OTHER_LEVEL \
    LINE("91: ldr r0, [sp, #RUN]") \
    LINE("adds r0, #RUN_LEVELS - 40") \
    LINE("92: adds r0, #40") \
    LINE("mov r6, r9") \
    LINE("ldr r1, [r0]") \
    LINE("lsrs r6, r1") \
    LINE("cmp r6, r7") \
    LINE("bhi 92b") \
    LINE("mov r6, r9") \
    LINE("ldmia r0!, {r1-r5}") \
    LINE("lsrs r6, r2") \
    LINE("orrs r6, r3") \
    LINE("cmp r6, r7") \
    LINE("bls 83b") \
    LINE("add r7, sp, #UPPER") \
    LINE("stmia r7!, {r1-r5}") \
    LINE("ldmia r0!, {r1-r5}") \
    LINE("stmia r7!, {r1-r3}") \
    LINE("str r4, [sp, #MASK]") \
    LINE("str r5, [sp, #TEXELS]") \
    LINE("add r7, sp, #CORNERS") \
    LINE("ldmia r7!, {r2-r5}") \
    LINE("ldr r1, [sp, #DOWN]") \
    LINE("97: ldr r0, [sp, #BESIDE]")   /* nothing leaves it to C now: on to the column to the right */ \
    LINE("cmp r0, #2") \
    LINE("bne 98f") \
    LINE("movs r0, #RIGHT / 4") \
    LINE("lsls r0, r0, #2") \
    LINE("bl 29f") \
    LINE("98: b 14b")

/* 87: another source, r5, with the material in its upper half: is it of the same instance and material, and without colours and
 * attributes? */
#define OTHER_SOURCE \
    LINE("87: eors r6, r5") \
    LINE("lsrs r6, r6, #16") \
    LINE("bne 83b") \
    LINE("uxth r6, r5") \
    LINE("lsls r7, r6, #3") \
    LINE("ldr r1, [sp, #VERTICES]") \
    LINE("adds r7, r7, r1") \
    LINE("ldmia r7!, {r0, r1}")         /* source_slot_t */ \
    LINE("ldrh r7, [r7]") \
    LINE("ldr r2, [sp, #INSTANCE]") \
    LINE("eors r1, r2") \
    LINE("orrs r1, r7") \
    LINE("bne 83b") \
    LINE("subs r0, r0, r6") \
    LINE("lsls r0, r0, #2") \
    LINE("ldr r1, [sp, #MODEL_TEXCOORDS]") \
    LINE("adds r0, r0, r1") \
    LINE("str r0, [sp, #TEXCOORDS]") \
    LINE("str r5, [sp, #SOURCE]") \
    LINE("b 17b")

/* Onto the list whose end is the word r0 bytes above the stack pointer; r0 and r7 are lost. */
#define APPEND \
    LINE("29: push {r1, r2, r3}") \
    LINE("mov r7, sp") \
    LINE("adds r7, #12") \
    LINE("adds r7, r7, r0") \
    LINE("ldr r0, [sp, #12 + LIST]") \
    LINE("ldr r1, [r7]") \
    LINE("strh r0, [r1]") \
    LINE("ldr r1, [sp, #12 + RECORD_BYTES]") \
    LINE("muls r0, r1, r0") \
    LINE("ldr r1, [sp, #12 + ARENA]") \
    LINE("subs r1, r1, r0") \
    LINE("movs r0, #0") \
    LINE("strh r0, [r1]")               /* its next */ \
    LINE("str r1, [r7]") \
    LINE("pop {r1, r2, r3}") \
    LINE("bx lr")

/* clang-format on */

#endif
