/* What the loops of fill/small_thumb1.c and small_thumb1_flat.c share: the parts that they are made of, and what is left to C. */
#ifndef TUILE_FILL_SMALL_THUMB1_H
#define TUILE_FILL_SMALL_THUMB1_H

#include "small_thumb.h"
#include "thumb1.h"

#include <stddef.h>

/* A triangle as it lies at the stack pointer, and its gradients. */
typedef struct small_thumb1_far {
    uint32_t corner0, corner1, corner2; /* depth_light */
    int32_t x1, y1, x2, y2;
    int32_t z0, z1, z2; /* depth_light >> 8, from the first corner for the others */
    uint32_t to_x, to_y;
    uint32_t depth, depth_dx, depth_dy, light, light_dx, light_dy; /* out: at the first centre, and a pixel further */
} small_thumb1_far_t;

/* Makes them, of any triangle that is small. gouraud: light's too. */
void small_thumb1_far(small_thumb1_far_t *face, uint32_t gouraud);

/* Of area / 512, by how many places area is to be shifted to the right to be in 256 ... 511. */
extern const uint8_t small_thumb1_shifts[512];

_Static_assert(offsetof(record_t, v0) == 2 && offsetof(record_t, d1) == 4 && offsetof(record_t, d2) == 5 &&
                   offsetof(record_t, material) == 6 && offsetof(record_t, light) == 7 && sizeof(record_t) == 8 &&
                   sizeof(vertex_t) == 8 && TRIANGLE_SMALL_DEPTH == 1 << 17 && SHORT_SIDE == 512 && DIVIDE_TABLE == 512,
               "numbers in the assembly");
_Static_assert(offsetof(small_run_t, stride) == 28 && offsetof(small_run_t, record_bytes) == 32 &&
                   offsetof(small_run_t, given) == 56 && offsetof(small_run_t, place) == 60 &&
                   offsetof(small_run_t, right) == 72 && sizeof(small_place_t) == 12,
               "offsets in the assembly");

/* clang-format off */

/* At the stack pointer, bytes. A row loads what stands first, up to ROW; STRIDE is a loop's own. From CORNER0 to FAR_LIGHT_DX as
 * small_thumb1_far_t has it; from LIMIT to DEPTH, and from RECORD_BYTES to GIVEN, as small_run_t. */
#define FRAME \
    LINE(".equ SLOPE_LEFT, 0") \
    LINE(".equ SLOPE_RIGHT, 4") \
    LINE(".equ DEPTH_DY, 8") \
    LINE(".equ ROW, 20")            /* address of the depth in the first corner's column */ \
    LINE(".equ FIRST, 24")          /* column of the first row that is not empty, and its pixels */ \
    LINE(".equ PIXELS, 28") \
    LINE(".equ ROWS, 32")           /* -rows that are left above the bend, or below it; then -those below it, or 0 */ \
    LINE(".equ BELOW, 36") \
    LINE(".equ NEXT_X, 40")         /* the side below the bend, a row before its first, and its slope */ \
    LINE(".equ NEXT_SLOPE, 44") \
    LINE(".equ CORNER0, 48") \
    LINE(".equ X1, 60") \
    LINE(".equ Y1, 64") \
    LINE(".equ Y2, 72") \
    LINE(".equ Z0, 76") \
    LINE(".equ TO_X, 88") \
    LINE(".equ TO_Y, 92") \
    LINE(".equ FAR_DEPTH, 96") \
    LINE(".equ FAR_DEPTH_DX, 100") \
    LINE(".equ FAR_LIGHT, 108")     /* or light at the first centre */ \
    LINE(".equ FAR_LIGHT_DX, 112") \
    LINE(".equ LIMIT, 120")         /* limit, arena_end, vertices, known */ \
    LINE(".equ ARENA, 124") \
    LINE(".equ TOP, 136") \
    LINE(".equ HEIGHT, 140") \
    LINE(".equ DEPTH, 144") \
    LINE(".equ RECORD_BYTES, 148") \
    LINE(".equ RAMP, 152") \
    LINE(".equ COLOUR, 156") \
    LINE(".equ MATERIAL, 160") \
    LINE(".equ LEFT, 164") \
    LINE(".equ WIDTH, 168") \
    LINE(".equ GIVEN, 172") \
    LINE(".equ LIST, 176")          /* number + 1 of the face; as small_run_t the end of those that reach below, the count, right */ \
    LINE(".equ END, 180") \
    LINE(".equ COUNT, 184") \
    LINE(".equ RIGHT, 188") \
    LINE(".equ RUN, 192") \
    LINE(".equ NEXT, 196")          /* first word of the record: number + 1 of the next in its lower half */ \
    LINE(".equ BACK, 200")          /* -stride */ \
    LINE(".equ TABLE, 204")         /* divide_table, small_thumb1_shifts */ \
    LINE(".equ SHIFTS, 208") \
    LINE(".equ START, 212")         /* small_start(0) */ \
    LINE(".equ ONES, 216")          /* 2^31 - 1 */ \
    LINE(".equ NEAR, 220")          /* TRIANGLE_SMALL_DEPTH */ \
    LINE(".equ VALUE, 224")         /* flat: the colour */ \
    LINE(".equ FRACTION, 228")      /* of the reciprocal: divide_area_t's f / 2^16, and area */ \
    LINE(".equ DIVISOR, 232") \
    LINE(".equ SIDES, 236")         /* divide_sides */ \
    LINE(".equ ROWS_AT, 240")       /* address of the loop over rows, as they are clamped or not */ \
    LINE(".equ HANDED, 244")        /* 1: the face is in the list of RIGHT already */ \
    LINE(".equ CLAMP_LEFT, 248")    /* the tile's columns, from the face's own */ \
    LINE(".equ CLAMP_RIGHT, 252") \
    LINE(".equ FRAME, 260") \
    LINE(".equ RUN_STRIDE, 28") \
    LINE(".equ RUN_LIST, 60")

/* The run into the frame, and the way back to C, the face at LIST undrawn. r0: the first face. */
#define ENTER \
    OPEN_FRAME \
    LINE("str r0, [sp, #RUN]") \
    LINE("ldr r1, [r0, #RUN_STRIDE]") \
    LINE("str r1, [sp, #STRIDE]") \
    LINE("negs r1, r1") \
    LINE("str r1, [sp, #BACK]") \
    LINE("add r1, sp, #LIMIT") \
    LINE("ldm r0!, {r2-r7}") \
    LINE("stm r1!, {r2-r7}") \
    LINE("ldm r0!, {r2, r3}")       /* depth, stride */ \
    LINE("stm r1!, {r2}") \
    LINE("ldm r0!, {r2-r7}") \
    LINE("stm r1!, {r2-r7}") \
    LINE("ldm r0!, {r2-r6}")        /* given, list, end, count, right */ \
    LINE("stm r1!, {r2-r6}") \
    LINE("ldr r4, =divide_table") \
    LINE("ldr r5, =small_thumb1_shifts") \
    LINE("ldr r6, =0xfffc0") \
    LINE("ldr r7, =0x7fffffff") \
    LINE("add r1, sp, #TABLE") \
    LINE("stm r1!, {r4-r7}") \
    LINE("ldr r2, =0x20000") \
    LINE("str r2, [sp, #NEAR]") \
    LINE("ldr r2, =divide_sides") \
    LINE("str r2, [sp, #SIDES]") \
    LINE("ldr r2, =31f") \
    LINE("str r2, [sp, #ROWS_AT]") \
    LINE("movs r2, #0") \
    LINE("str r2, [sp, #HANDED]") \
    LINE("ldr r0, [sp, #LIST]") \
    LINE("b 11f") \
    LINE(".ltorg") \
    LINE("79: b 80f") \
    LINE("89: str r0, [sp, #LIST]") \
    LINE("90: ldr r0, [sp, #RUN]") \
    LINE("adds r0, #RUN_LIST") \
    LINE("add r7, sp, #LIST") \
    LINE("ldm r7!, {r1-r4}") \
    LINE("stm r0!, {r1-r4}") \
    CLOSE_FRAME

/* The next face: r0 number + 1, r2 address of the record, r5 vertices. ADDRESS: r0 times the size of a record. LIGHT: what flat
 * faces have of it. Those of another material, or of which nothing is known, are drawn by way of BESIDE. */
#define FACE(ADDRESS, LIGHT) \
    LINE("10: ldr r0, [sp, #NEXT]") \
    LINE("ldr r1, [sp, #COUNT]") \
    LINE("uxth r0, r0") \
    LINE("adds r1, #1") \
    LINE("str r1, [sp, #COUNT]") \
    LINE("11: add r7, sp, #LIMIT") \
    LINE("ldm r7!, {r1, r2, r5, r6}") \
    LINE("subs r3, r0, #1") \
    LINE("cmp r3, r1") \
    LINE("bhs 89b") \
    LINE("str r0, [sp, #LIST]") \
    ADDRESS \
    LINE("subs r2, r2, r0") \
    LINE("ldrb r1, [r2, #6]") \
    LINE("cmp r1, r6") \
    LINE("bne 79b") \
    LIGHT

/* r2: address of the record, r5: vertices. To r0 x|y, r2, r4 of the corners; r6, r7 are free. NONE: what to
 * do with what is no triangle. */
#define CORNERS(NONE) \
    LINE("ldm r2!, {r3, r4}") \
    LINE("str r3, [sp, #NEXT]") \
    LINE("lsls r7, r4, #24") \
    NONE \
    LINE("asrs r7, r7, #21") \
    LINE("lsls r6, r4, #16") \
    LINE("asrs r6, r6, #24") \
    LINE("lsls r6, r6, #3") \
    LINE("lsrs r3, r3, #16") \
    LINE("lsls r3, r3, #3") \
    LINE("adds r3, r3, r5") \
    LINE("adds r7, r7, r3") \
    LINE("adds r6, r6, r3") \
    LINE("ldm r3!, {r0, r1}") \
    LINE("ldm r7!, {r2, r3}") \
    LINE("ldm r6!, {r4, r5}") \
    LINE("add r7, sp, #CORNER0") \
    LINE("stm r7!, {r1, r3, r5}")

/* r0 x0, r6 y0, r2 x1, r3 y1, r4 x2, r5 y2, from the first corner for the others. X: of those of x below 2^15, or of any. */
#define DIFFERENCES(X) \
    LINE("asrs r6, r0, #16") \
    LINE("asrs r3, r2, #16") \
    LINE("subs r3, r3, r6") \
    LINE("asrs r5, r4, #16") \
    LINE("subs r5, r5, r6") \
    X \
    LINE("sxth r0, r0")
#define NEAR_X LINE("subs r2, r2, r0") LINE("sxth r2, r2") LINE("subs r4, r4, r0") LINE("sxth r4, r4")
#define ANY_X \
    LINE("sxth r2, r2") LINE("sxth r4, r4") LINE("sxth r1, r0") LINE("subs r2, r2, r1") LINE("subs r4, r4, r1")

/* The first centre: r1 to_y, r0 start; r6 rows of the tile from there on, r8 from the address of its depth to DEPTH, r9 divide_sides.
 * All but the place of the first corner is put away. */
#define CENTRE \
    LINE("12: ldr r1, [sp, #TOP]") \
    LINE("subs r1, r1, r6") \
    LINE("asrs r6, r1, #4") \
    LINE("bpl 70f") \
    LINE("movs r7, #15") \
    LINE("ands r1, r7") \
    LINE("13: add r7, sp, #X1") \
    LINE("stm r7!, {r2-r5}") \
    LINE("str r1, [sp, #TO_Y]") \
    LINE("movs r7, #8") \
    LINE("subs r0, r7, r0") \
    LINE("asrs r7, r0, #4") \
    LINE("lsls r7, r7, #1") \
    LINE("mov r8, r7") \
    LINE("lsls r0, r0, #28") \
    LINE("lsrs r7, r0, #28") \
    LINE("str r7, [sp, #TO_X]") \
    LINE("ldr r7, [sp, #STRIDE]") \
    LINE("muls r7, r6") \
    LINE("add r8, r7") \
    LINE("ldr r7, [sp, #HEIGHT]") \
    LINE("adds r6, r6, r7") \
    LINE("lsrs r0, r0, #12") \
    LINE("ldr r7, [sp, #START]") \
    LINE("subs r0, r7, r0") \
    LINE("ldr r7, [sp, #SIDES]") \
    LINE("mov r9, r7") \
    LINE("cmp r3, r5") \
    LINE("blt 14f") \
    LINE("b 40f") \
    LINE("70: movs r6, #0")         /* it begins above the tile */ \
    LINE("b 13b") \
    LINE("14:")

/* r7: dx * 2^20 / dy, divide_side_by_table; X, a lower register, which may be dy, is lost. */
#define SIDE(DX, DY, X) \
    LINE("lsls r7, " DY ", #3") \
    LINE("add r7, r9") \
    LINE("ldm r7, {" X ", r7}") \
    LINE("muls r7, " DX) \
    LINE("asrs r7, " X)

/* The face's record, behind all others of a list. RECORD: r0 times the size of a record. */
#define APPEND(LIST_END, RECORD) \
    LINE("push {r0-r3}") \
    LINE("ldr r0, [sp, #16 + LIST]") \
    LINE("ldr r2, [sp, #16 + " LIST_END "]") \
    LINE("strh r0, [r2]") \
    RECORD \
    LINE("ldr r1, [sp, #16 + ARENA]") \
    LINE("subs r1, r1, r0") \
    LINE("movs r3, #0") \
    LINE("strh r3, [r1]")           /* its next */ \
    LINE("str r1, [sp, #16 + " LIST_END "]") \
    LINE("pop {r0-r3}")

/* The sides of a triangle whose mid corner is (XM, YM), on side BEND, and its lowest one (XL, YL), OTHER being the other side, each
 * with the place of its slope. Then the first row that is not empty: r5 its first column, r6 pixels. RECORD: r0 times the size of a
 * record. */
#define EDGES(XM, YM, XL, YL, BEND, BEND_SLOPE, OTHER, OTHER_SLOPE, RECORD) \
    LINE("mov r12, r6") \
    SIDE(XL, YL, "r6") \
    LINE("str r7, [sp, #" OTHER_SLOPE "]") \
    LINE("muls r7, r1") \
    LINE("asrs r7, r7, #4") \
    LINE("adds r7, r7, r0") \
    LINE("mov " OTHER ", r7") \
    LINE("subs r7, r1, " YL) \
    LINE("asrs r7, r7, #4")         /* -rows */ \
    LINE("mov r6, r12") \
    LINE("adds r6, r6, r7") \
    LINE("bmi 20f") \
    LINE("21: mov r12, r7") \
    LINE("subs " YL ", " YL ", " YM) \
    LINE("subs " XL ", " XL ", " XM) \
    LINE("subs r6, r1, " YM) \
    LINE("bpl 25f") \
    SIDE(XM, YM, YM) \
    LINE("str r7, [sp, #" BEND_SLOPE "]") \
    LINE("muls r7, r1") \
    LINE("asrs r7, r7, #4") \
    LINE("adds r7, r7, r0") \
    LINE("mov " BEND ", r7") \
    LINE("asrs r7, r6, #4")         /* -rows above the bend */ \
    LINE("mov " YM ", r12") \
    LINE("subs " YM ", " YM ", r7") /* -rows below it */ \
    LINE("bge 24f") \
    LINE("str r7, [sp, #ROWS]") \
    LINE("str " YM ", [sp, #BELOW]") \
    LINE("lsls " XM ", " XM ", #16") \
    LINE("adds r0, r0, " XM) \
    SIDE(XL, YL, YL) \
    LINE("movs " YL ", #15")        /* from the bend to the next centre */ \
    LINE("ands r6, " YL) \
    LINE("muls r6, r7") \
    LINE("asrs r6, r6, #4") \
    LINE("adds r6, r6, r0") \
    LINE("subs r6, r6, r7") \
    LINE("str r6, [sp, #NEXT_X]") \
    LINE("str r7, [sp, #NEXT_SLOPE]") \
    LINE("22: mov r5, r10") \
    LINE("asrs r5, r5, #20") \
    LINE("mov r6, r11") \
    LINE("asrs r6, r6, #20") \
    LINE("subs r6, r6, r5") \
    LINE("ble 26f") \
    LINE("b 50f") \
    LINE("20: subs r7, r7, r6")     /* it reaches below the tile */ \
    LINE("ldr r6, [sp, #HANDED]") \
    LINE("cmp r6, #0") \
    LINE("bne 21b") \
    APPEND("END", RECORD) \
    LINE("b 21b") \
    LINE("25:") \
    SIDE(XL, YL, YL)                /* no row above the bend; r6: from it to the first centre */ \
    LINE("str r7, [sp, #" BEND_SLOPE "]") \
    LINE("muls r6, r7") \
    LINE("asrs r6, r6, #4") \
    LINE("lsls " XM ", " XM ", #16") \
    LINE("adds r0, r0, " XM) \
    LINE("adds r0, r0, r6") \
    LINE("mov " BEND ", r0") \
    LINE("24: mov r7, r12") \
    LINE("str r7, [sp, #ROWS]") \
    LINE("movs r7, #0") \
    LINE("str r7, [sp, #BELOW]") \
    LINE("b 22b") \
    LINE("26: ldr r7, [sp, #ROWS]") /* an empty row */ \
    LINE("adds r7, #1") \
    LINE("bpl 28f") \
    LINE("27: str r7, [sp, #ROWS]") \
    LINE("ldr r7, [sp, #SLOPE_LEFT]") \
    LINE("add r10, r7") \
    LINE("ldr r7, [sp, #SLOPE_RIGHT]") \
    LINE("add r11, r7") \
    LINE("ldr r7, [sp, #BACK]") \
    LINE("add r8, r7") \
    LINE("ldr r7, [sp, #TO_Y]") \
    LINE("adds r7, #16") \
    LINE("str r7, [sp, #TO_Y]") \
    LINE("b 22b") \
    LINE("29: b 10b") \
    LINE("28: ldr r7, [sp, #BELOW]") \
    LINE("cmp r7, #0") \
    LINE("beq 29b") \
    LINE("movs r5, #0") \
    LINE("str r5, [sp, #BELOW]") \
    LINE("ldr r5, [sp, #NEXT_X]") \
    LINE("mov " BEND ", r5") \
    LINE("ldr r5, [sp, #NEXT_SLOPE]") \
    LINE("str r5, [sp, #" BEND_SLOPE "]") \
    LINE("b 27b")
#define BENDS_LEFT(RECORD) EDGES("r2", "r3", "r4", "r5", "r10", "SLOPE_LEFT", "r11", "SLOPE_RIGHT", RECORD)
#define BENDS_RIGHT(RECORD) \
    LINE("40:") EDGES("r4", "r5", "r2", "r3", "r11", "SLOPE_RIGHT", "r10", "SLOPE_LEFT", RECORD)

/* The row of the sides: r5 its first column, r6 pixels, if there are any. ENTRY: of the first row, which has them already. */
#define SPAN(ENTRY) \
    LINE("mov r5, r10") \
    LINE("asrs r5, r5, #20") \
    LINE("mov r6, r11") \
    LINE("asrs r6, r6, #20") \
    LINE("subs r6, r6, r5") \
    LINE("ble 35f") \
    LINE(ENTRY ":")

/* Likewise, of columns of the tile alone; r0 is lost. */
#define SPAN_CLAMPED(ENTRY) \
    LINE("mov r5, r10") \
    LINE("asrs r5, r5, #20") \
    LINE("mov r6, r11") \
    LINE("asrs r6, r6, #20") \
    LINE("29: ldr r0, [sp, #CLAMP_LEFT]") \
    LINE("cmp r5, r0") \
    LINE("bge 28f") \
    LINE("mov r5, r0") \
    LINE("28: ldr r0, [sp, #CLAMP_RIGHT]") \
    LINE("cmp r6, r0") \
    LINE("ble 27f") \
    LINE("mov r6, r0") \
    LINE("27: subs r6, r6, r5") \
    LINE("ble 35f") \
    LINE("b 26f") \
    LINE(ENTRY ": adds r6, r6, r5") \
    LINE("b 29b") \
    LINE("26:")

/* Behind a pixel, and behind a row. */
#define ENDS \
    LINE("36: subs r6, #1") \
    LINE("bne 33b") \
    LINE("35: ldr r5, [sp, #ROWS]") \
    LINE("adds r5, #1") \
    LINE("str r5, [sp, #ROWS]") \
    LINE("bmi 30b") \
    LINE("ldr r5, [sp, #BELOW]") \
    LINE("cmp r5, #0") \
    LINE("bne 38f") \
    LINE("b 10b") \
    LINE("38: str r5, [sp, #ROWS]") \
    LINE("movs r6, #0") \
    LINE("str r6, [sp, #BELOW]") \
    LINE("ldr r5, [sp, #Y1]") \
    LINE("ldr r6, [sp, #Y2]") \
    LINE("cmp r5, r6") \
    LINE("ldr r5, [sp, #NEXT_X]") \
    LINE("ldr r6, [sp, #NEXT_SLOPE]") \
    LINE("bge 39f") \
    LINE("mov r10, r5") \
    LINE("str r6, [sp, #SLOPE_LEFT]") \
    LINE("b 30b") \
    LINE("39: mov r11, r5") \
    LINE("str r6, [sp, #SLOPE_RIGHT]") \
    LINE("b 30b")

/* Another material, or a face of which nothing is known: is it short? Inside the tile's columns it is drawn as those that are known
 * to be so; else it is clamped to them, and handed to the right where it reaches farther. */
#define BESIDE(LIGHT, RECORD) \
    LINE("84: b 90b") \
    LINE("80: ldr r7, [sp, #MATERIAL]") \
    LINE("cmp r1, r7") \
    LINE("bne 84b") \
    LIGHT \
    CORNERS(LINE("beq 84b")) \
    DIFFERENCES(ANY_X) \
    LINE("ldr r1, =1022") \
    LINE("mov r8, r1") \
    LINE("ldr r7, =511") \
    LINE("adds r1, r2, r7") \
    LINE("cmp r1, r8") \
    LINE("bhi 84b") \
    LINE("adds r1, r4, r7") \
    LINE("cmp r1, r8") \
    LINE("bhi 84b") \
    LINE("subs r1, r2, r4") \
    LINE("adds r1, r1, r7") \
    LINE("cmp r1, r8") \
    LINE("bhi 84b") \
    LINE("movs r1, r3") \
    LINE("orrs r1, r5") \
    LINE("lsrs r1, r1, #9") \
    LINE("bne 84b") \
    LINE("ldr r1, [sp, #WIDTH]") \
    LINE("mov r8, r1") \
    LINE("ldr r1, [sp, #LEFT]") \
    LINE("subs r1, r0, r1") \
    LINE("cmp r1, r8") \
    LINE("bhs 85f") \
    LINE("adds r7, r1, r2") \
    LINE("cmp r7, r8") \
    LINE("bhs 85f") \
    LINE("adds r7, r1, r4") \
    LINE("cmp r7, r8") \
    LINE("bhs 85f") \
    LINE("movs r1, #0") \
    LINE("str r1, [sp, #HANDED]") \
    LINE("ldr r1, =31b") \
    LINE("82: str r1, [sp, #ROWS_AT]") \
    LINE("b 12b") \
    LINE("85: cmp r1, r8")          /* it is not inside; does it reach beyond the right edge? */ \
    LINE("bge 86f") \
    LINE("adds r7, r1, r2") \
    LINE("cmp r7, r8") \
    LINE("bge 86f") \
    LINE("adds r7, r1, r4") \
    LINE("cmp r7, r8") \
    LINE("blt 87f") \
    LINE("86: ldr r7, [sp, #RIGHT]") \
    LINE("cmp r7, #0") \
    LINE("beq 87f") \
    APPEND("RIGHT", RECORD) \
    LINE("movs r1, #1") \
    LINE("b 88f") \
    LINE("87: movs r1, #0") \
    LINE("88: str r1, [sp, #HANDED]") \
    LINE("movs r1, #8") \
    LINE("subs r1, r1, r0") \
    LINE("asrs r1, r1, #4")         /* -column */ \
    LINE("ldr r7, [sp, #LEFT]") \
    LINE("adds r7, #7") \
    LINE("asrs r7, r7, #4") \
    LINE("adds r1, r1, r7") \
    LINE("str r1, [sp, #CLAMP_LEFT]") \
    LINE("ldr r7, [sp, #WIDTH]") \
    LINE("asrs r7, r7, #4") \
    LINE("subs r7, #1") \
    LINE("adds r1, r1, r7") \
    LINE("str r1, [sp, #CLAMP_RIGHT]") \
    LINE("ldr r1, =32b") \
    LINE("b 82b") \
    LINE(".ltorg")

/* clang-format on */

#endif
