/* Sides, the reciprocal of the area and gradients: parts of fill/textured_thumb1.c. */
#ifndef TUILE_FILL_TEXTURED_THUMB1_SET_UP_H
#define TUILE_FILL_TEXTURED_THUMB1_SET_UP_H

#include "textured_thumb1_parts.h"

/* clang-format off */

/* To r7 a side's slope, by the table (divide_side_by_table). SHIFT, a lower register, is lost; it is not X. */
#define SLOPE(SHIFT, X, Y) \
    LINE("lsls r7, " Y ", #3") \
    LINE("ldr " SHIFT ", [sp, #SLOPES]") \
    LINE("adds r7, r7, " SHIFT) \
    LINE("ldmia r7, {" SHIFT ", r7}") \
    LINE("muls r7, " X ", r7") \
    LINE("asrs r7, " SHIFT)

/* The sides of a triangle whose mid corner is (XM, YM), its lowest one (XL, YL): r0 rows below the bend, r1 those above, or of the
 * only part, r2, r3 left and right side in the first row, r4, r5 their slopes; r12 -rows. The side of the bend is BX, BS, the other
 * one OX, OS. r1: to_y, r8: start. FILLED: where to then. */
#define EDGES(XM, YM, XL, YL, BX, BS, OX, OS, FILLED) \
    SLOPE("r0", XL, YL) \
    LINE("mov r9, r7") \
    LINE("muls r7, r1, r7") \
    LINE("asrs r7, r7, #4") \
    LINE("add r7, r8") \
    LINE("mov r11, r7") \
    LINE("subs r6, r1, " YL) \
    LINE("asrs r6, r6, #4")                 /* -rows */ \
    LINE("ldr r0, [sp, #ROWS_LEFT]") \
    LINE("adds r0, r0, r6") \
    LINE("bmi 20f") \
    LINE("21: mov r12, r6") \
    LINE("subs " YL ", " YL ", " YM) \
    LINE("subs " XL ", " XL ", " XM) \
    LINE("subs r0, r1, " YM) \
    LINE("bpl 25f") \
    LINE("asrs r7, r0, #4")                 /* -rows above the bend */ \
    LINE("mov lr, r7") \
    LINE("subs r7, r7, r6")                 /* rows below it */ \
    LINE("ble 24f") \
    LINE("mov r10, r7") \
    LINE("lsls r0, r0, #28")                /* from the bend to the next centre */ \
    LINE("lsrs r0, r0, #28") \
    SLOPE("r6", XL, YL) \
    LINE("muls r0, r7, r0") \
    LINE("asrs r0, r0, #4") \
    LINE("lsls r6, " XM ", #16") \
    LINE("adds r0, r0, r6") \
    LINE("add r0, r8") \
    LINE("subs r0, r0, r7") \
    LINE("str r0, [sp, #NEXT_X]") \
    LINE("str r7, [sp, #NEXT_SLOPE]") \
    LINE("23:") \
    SLOPE("r6", XM, YM) \
    LINE("muls r1, r7, r1") \
    LINE("asrs r1, r1, #4") \
    LINE("add r1, r8") \
    LINE("movs " BX ", r1") \
    LINE("movs " BS ", r7") \
    LINE("mov " OX ", r11") \
    LINE("mov " OS ", r9") \
    LINE("mov r1, lr") \
    LINE("mov r0, r10") \
    LINE("b 26f") \
    LINE("20: subs r6, r6, r0")             /* it reaches below the tile */ \
    LINE("ldr r0, [sp, #BESIDE]") \
    LINE("cmp r0, #2") \
    LINE("beq 21b") \
    LINE("movs r0, #END / 4") \
    LINE("lsls r0, r0, #2") \
    LINE("bl 29b") \
    LINE("b 21b") \
    LINE("24: mov lr, r6")                  /* no rows below the bend */ \
    LINE("movs r6, #0") \
    LINE("mov r10, r6") \
    LINE("b 23b") \
    LINE("25:")                             /* none above it: r0 from it to the first centre */ \
    SLOPE("r6", XL, YL) \
    LINE("muls r0, r7, r0") \
    LINE("asrs r0, r0, #4") \
    LINE("lsls r6, " XM ", #16") \
    LINE("adds r0, r0, r6") \
    LINE("add r0, r8") \
    LINE("movs " BX ", r0") \
    LINE("movs " BS ", r7") \
    LINE("mov " OX ", r11") \
    LINE("mov " OS ", r9") \
    LINE("mov r1, r12") \
    LINE("movs r0, #0") \
    LINE("26: negs r1, r1") \
    LINE("27: asrs r6, r2, #20") \
    LINE("asrs r7, r3, #20") \
    LINE("cmp r6, r7") \
    LINE("blt " FILLED) \
    LINE("adds r2, r2, r4")                 /* an empty row */ \
    LINE("adds r3, r3, r5") \
    LINE("subs r1, r1, #1") \
    LINE("bne 27b") \
    LINE("movs r1, r0") \
    LINE("beq 28f") \
    LINE("movs r0, #0") \
    LINE("ldr " BX ", [sp, #NEXT_X]") \
    LINE("ldr " BS ", [sp, #NEXT_SLOPE]") \
    LINE("adds " BX ", " BX ", " BS) \
    LINE("b 27b") \
    LINE("28: b 10b")


/* To r4: reciprocal of the area (divide_area_by_table). */
#define RECIPROCAL \
    LINE("ldr r0, [sp, #AREA]") \
    LINE("lsrs r1, r0, #9") \
    LINE("beq 60f") \
    LINE("ldr r7, [sp, #SHIFTS]") \
    LINE("ldrb r2, [r7, r1]") \
    LINE("ldr r7, [sp, #TABLE]") \
    LINE("movs r3, r0") \
    LINE("lsrs r3, r2") \
    LINE("lsls r3, r3, #2") \
    LINE("ldr r3, [r7, r3]") \
    LINE("lsrs r3, r3, #9") \
    LINE("lsls r4, r3, #9") \
    LINE("lsrs r4, r2") \
    LINE("movs r5, r4") \
    LINE("muls r5, r0, r5") \
    LINE("ldr r6, [sp, #ONES]") \
    LINE("subs r6, r6, r5") \
    LINE("asrs r5, r6, #8") \
    LINE("muls r5, r3, r5") \
    LINE("adds r2, #14") \
    LINE("asrs r5, r2") \
    LINE("adds r4, r4, r5") \
    LINE("muls r5, r0, r5") \
    LINE("subs r6, r6, r5") \
    LINE("asrs r5, r6, #1") \
    LINE("muls r5, r3, r5") \
    LINE("adds r2, #7") \
    LINE("asrs r5, r2") \
    LINE("adds r4, r4, r5") \
    LINE("muls r5, r0, r5") \
    LINE("subs r6, r6, r5") \
    LINE("bmi 56f") \
    LINE("54: cmp r6, r0") \
    LINE("blt 57f") \
    LINE("adds r4, #1") \
    LINE("subs r6, r6, r0") \
    LINE("b 54b") \
    LINE("56: subs r4, #1") \
    LINE("adds r6, r6, r0") \
    LINE("bmi 56b") \
    LINE("b 57f") \
    LINE("60: ldr r7, [sp, #TABLE]")    /* below 512: the table's, less 1 for powers of two */ \
    LINE("lsls r1, r0, #2") \
    LINE("ldr r4, [r7, r1]") \
    LINE("subs r1, r0, #1") \
    LINE("ands r1, r0") \
    LINE("bne 57f") \
    LINE("subs r4, #1") \
    LINE("57: str r4, [sp, #RECIPROCAL]")

/* The product of a number of 28 bits and the reciprocal, whose halves are r1 and r3, over 2^19: it is NUMBER * 2^13 + LOW, NUMBER
 * then being the product of the upper halves, LOW that of all others. |LOW| < 2^26, since the area is 8 at least. T is free. */
#define DEPTH_PRODUCT(NUMBER, LOW, T) \
    LINE("uxth " T ", " NUMBER) \
    LINE("asrs " NUMBER ", " NUMBER ", #16") \
    LINE("movs " LOW ", r3") \
    LINE("muls " LOW ", " T ", " LOW) \
    LINE("lsrs " LOW ", " LOW ", #16") \
    LINE("muls " T ", r1, " T) \
    LINE("adds " LOW ", " LOW ", " T) \
    LINE("movs " T ", " NUMBER) \
    LINE("muls " T ", r3, " T) \
    LINE("adds " LOW ", " LOW ", " T) \
    LINE("asrs " LOW ", " LOW ", #3") \
    LINE("muls " NUMBER ", r1, " NUMBER)

/* textured_step: NUMBER by the factor whose halves are r1, r2; T and U are free. Of a sum below 2^31 in size: halves of NUMBER are
 * below 2^14 and 2^16, the factor is below 2^28. What is shifted out last rounds. */
#define STEP(NUMBER, T, U) \
    LINE("uxth " T ", " NUMBER) \
    LINE("asrs " NUMBER ", " NUMBER ", #16") \
    LINE("movs " U ", r2") \
    LINE("muls " U ", " T ", " U) \
    LINE("lsrs " U ", " U ", #16") \
    LINE("muls " T ", r1, " T) \
    LINE("adds " U ", " U ", " T) \
    LINE("movs " T ", " NUMBER) \
    LINE("muls " T ", r2, " T) \
    LINE("adds " U ", " U ", " T) \
    LINE("muls " NUMBER ", r1, " NUMBER) \
    LINE("asrs " U ", " U ", #16") \
    LINE("adcs " NUMBER ", " NUMBER ", " U)

/* Two determinants of differences A, B over the corners (X1, Y1), (X2, Y2): to RIGHT, and in place of A. */
#define DETERMINANTS(RIGHT, A, B, T, X1, Y1, X2, Y2) \
    LINE("movs " RIGHT ", " B) \
    LINE("muls " RIGHT ", " Y1 ", " RIGHT) \
    LINE("movs " T ", " A) \
    LINE("muls " T ", " Y2 ", " T) \
    LINE("subs " RIGHT ", " RIGHT ", " T) \
    LINE("muls " A ", " X2 ", " A) \
    LINE("muls " B ", " X1 ", " B) \
    LINE("subs " A ", " A ", " B)

/* Steps: r5 and r6 of s, right and down, r8 and r7 of t. */
#define MAP_OF_FACE \
    LINE("add r0, sp, #CORNERS") \
    LINE("ldmia r0!, {r2-r7}")          /* and s1, s2 */ \
    DETERMINANTS("r0", "r6", "r7", "r1", "r2", "r3", "r4", "r5") \
    LINE("ldr r1, [sp, #UP]") \
    LINE("lsls r0, r1") \
    LINE("lsls r6, r1") \
    LINE("mov r8, r0") \
    LINE("mov r9, r6") \
    LINE("ldr r6, [sp, #COORDINATES + 8]") \
    LINE("ldr r7, [sp, #COORDINATES + 12]") \
    DETERMINANTS("r0", "r6", "r7", "r1", "r2", "r3", "r4", "r5") \
    LINE("ldr r1, [sp, #UP]") \
    LINE("lsls r0, r1") \
    LINE("lsls r6, r1") \
    LINE("ldr r2, [sp, #RECIPROCAL]") \
    LINE("ldr r1, [sp, #LEVEL_DOWN]") \
    LINE("lsrs r2, r1") \
    LINE("lsrs r1, r2, #16") \
    LINE("uxth r2, r2") \
    STEP("r0", "r3", "r4") \
    STEP("r6", "r3", "r4") \
    LINE("mov r5, r8") \
    LINE("mov r7, r9") \
    STEP("r5", "r3", "r4") \
    STEP("r7", "r3", "r4") \
    /* the map: r0 t right, r6 t down, r5 s right, r7 s down */ \
    LINE("ldr r4, [sp, #FIRST_COORDINATES]") \
    LINE("sxth r3, r4") \
    LINE("asrs r4, r4, #16") \
    LINE("ldr r1, [sp, #S_INSIDE]") \
    LINE("ands r3, r1") \
    LINE("ldr r1, [sp, #FROM_CORNER]") \
    LINE("lsls r3, r3, #8") \
    LINE("asrs r3, r1") \
    LINE("lsls r4, r4, #8") \
    LINE("asrs r4, r1") \
    LINE("ldr r1, [sp, #TO_X]") \
    LINE("muls r1, r5, r1") \
    LINE("ldr r2, [sp, #TO_Y]") \
    LINE("muls r2, r7, r2") \
    LINE("adds r1, r1, r2") \
    LINE("asrs r1, r1, #4") \
    LINE("adds r3, r3, r1") \
    LINE("ldr r1, [sp, #TO_X]") \
    LINE("muls r1, r0, r1") \
    LINE("ldr r2, [sp, #TO_Y]") \
    LINE("muls r2, r6, r2") \
    LINE("adds r1, r1, r2") \
    LINE("asrs r1, r1, #4") \
    LINE("adds r4, r4, r1") \
    LINE("ldr r1, [sp, #T_UNIT]") \
    LINE("muls r0, r1, r0") \
    LINE("muls r6, r1, r6") \
    LINE("muls r4, r1, r4") \
    LINE("ldr r1, [sp, #S_UNIT]") \
    LINE("muls r5, r1, r5") \
    LINE("muls r7, r1, r7") \
    LINE("muls r3, r1, r3") \
    LINE("adds r0, r0, r5") \
    LINE("mov r11, r0") \
    LINE("adds r6, r6, r7") \
    LINE("str r6, [sp, #MAP_DY]") \
    LINE("adds r3, r3, r4") \
    LINE("mov r10, r3")

/* To r12 what depth is at the first corner, and r0. r3: depth and light there. */
#define DEPTH_AT_CORNER \
    LINE("ldr r3, [sp, #DEPTH_LIGHT]") \
    LINE("lsrs r1, r3, #8") \
    LINE("adds r1, #128")               /* half */ \
    LINE("lsls r1, r1, #8") \
    LINE("adds r0, r0, r1") \
    LINE("mov r12, r0")

/* r6, r7: differences of light, r9 the first corner's, which is the lowest byte of r3. */
#define LIGHT_DIFFERENCES \
    LINE("uxtb r3, r3") \
    LINE("add r0, sp, #LIGHTS") \
    LINE("ldmia r0!, {r6, r7}") \
    LINE("uxtb r6, r6") \
    LINE("subs r6, r6, r3") \
    LINE("uxtb r7, r7") \
    LINE("subs r7, r7, r3") \
    LINE("mov r9, r3")

/* r3 * 2^8 + r0, r2 * 2^8 + r6: dx and dy; r1 light at the first corner. To r3, and depth to r1. */
#define LIGHT_AT_CENTRE \
    LINE("ldr r7, [sp, #TO_Y]") \
    LINE("muls r2, r7, r2") \
    LINE("muls r6, r7, r6") \
    LINE("ldr r7, [sp, #TO_X]") \
    LINE("muls r3, r7, r3") \
    LINE("muls r0, r7, r0") \
    LINE("adds r3, r3, r2") \
    LINE("lsls r3, r3, #4") \
    LINE("adds r0, r0, r6") \
    LINE("asrs r0, r0, #4") \
    LINE("adds r3, r3, r0") \
    LINE("lsls r1, r1, #1") \
    LINE("adds r1, #5")                 /* half, and TEXTURED_BIAS */ \
    LINE("lsls r1, r1, #23") \
    LINE("adds r3, r3, r1") \
    LINE("mov r1, r12")

/* Depth, down in memory, right in r8, and at the first centre in r12. */
#define DEPTH_OF_FACE \
    DETERMINANTS("r0", "r2", "r3", "r1", "r4", "r5", "r6", "r7") \
    LINE("ldr r3, [sp, #RECIPROCAL]") \
    LINE("lsrs r1, r3, #16") \
    LINE("uxth r3, r3") \
    DEPTH_PRODUCT("r0", "r4", "r6") \
    DEPTH_PRODUCT("r2", "r5", "r6") \
    LINE("lsls r7, r0, #13") \
    LINE("adds r7, r7, r4") \
    LINE("mov r8, r7") \
    LINE("lsls r7, r2, #13") \
    LINE("adds r7, r7, r5") \
    LINE("str r7, [sp, #DEPTH_DY]") \
    LINE("ldr r1, [sp, #TO_X]") \
    LINE("ldr r3, [sp, #TO_Y]") \
    LINE("muls r0, r1, r0") \
    LINE("muls r2, r3, r2") \
    LINE("adds r0, r0, r2") \
    LINE("lsls r0, r0, #9") \
    LINE("muls r4, r1, r4") \
    LINE("muls r5, r3, r5") \
    LINE("adds r4, r4, r5") \
    LINE("asrs r4, r4, #4") \
    LINE("adds r0, r0, r4") \
    DEPTH_AT_CORNER

/* Light: right in r9, at the first centre in r3. A factor of 18 bits at most, by the lower 11 bits of the reciprocal and by the
 * others: what comes of the lower ones is below 2^26, over 2^3. */
#define LIGHT_OF_FACE \
    LIGHT_DIFFERENCES \
    LINE("add r0, sp, #CORNERS") \
    LINE("ldmia r0!, {r2-r5}") \
    DETERMINANTS("r0", "r6", "r7", "r1", "r2", "r3", "r4", "r5") \
    LINE("ldr r1, [sp, #RECIPROCAL]") \
    LINE("lsrs r2, r1, #11") \
    LINE("lsls r1, r1, #21") \
    LINE("lsrs r1, r1, #21") \
    LINE("movs r3, r0") \
    LINE("muls r3, r2, r3") \
    LINE("muls r0, r1, r0") \
    LINE("asrs r0, r0, #3") \
    LINE("muls r2, r6, r2") \
    LINE("muls r6, r1, r6") \
    LINE("asrs r6, r6, #3") \
    LINE("mov r1, r9") \
    LINE("lsls r4, r3, #8") \
    LINE("adds r4, r4, r0") \
    LINE("mov r9, r4") \
    LINE("lsls r5, r2, #8") \
    LINE("adds r5, r5, r6") \
    LINE("str r5, [sp, #LIGHT_DY]") \
    LIGHT_AT_CENTRE

/* Where depths are far apart gradients are exact, as divide_scaled has them: the reciprocal's fraction, of which the upper half or
 * less is enough, brings the quotient close, and its rest, modulo 2^32, puts it right. With |depths| < 2^20 and an area of 16 at
 * least sums stay below 2^31; others are left to C. Comes back by 58, as DEPTH_OF_FACE and LIGHT_OF_FACE do. r2, r3: depths. */
#define FAR_FACE \
    LINE("movs r6, r2") \
    LINE("movs r7, r3") \
    LINE("movs r0, #1") \
    LINE("lsls r0, r0, #20") \
    LINE("adds r1, r6, r0") \
    LINE("adds r0, r7, r0") \
    LINE("orrs r0, r1") \
    LINE("lsrs r0, r0, #21") \
    LINE("bne 62f") \
    LINE("ldr r1, [sp, #AREA]") \
    LINE("cmp r1, #16") \
    LINE("bge 63f") \
    LINE("62: b 77f") \
    LINE("63:") \
    LINE("ldr r4, [sp, #RECIPROCAL]") \
    LINE("movs r0, r4") \
    LINE("muls r0, r1, r0") \
    LINE("movs r2, #1") \
    LINE("lsls r2, r2, #31") \
    LINE("subs r2, r2, r0") \
    LINE("muls r2, r4, r2") \
    LINE("lsrs r2, r2, #16") \
    LINE("str r2, [sp, #FRACTION]") \
    LINE("add r0, sp, #CORNERS") \
    LINE("ldmia r0!, {r2-r5}") \
    DETERMINANTS("r0", "r6", "r7", "r1", "r2", "r3", "r4", "r5") \
    LINE("mov r9, r6") \
    LINE("ldr r2, [sp, #RECIPROCAL]") \
    LINE("lsrs r1, r2, #16") \
    LINE("uxth r2, r2") \
    LINE("bl 64f") \
    LINE("mov r8, r7") \
    LINE("mov r7, r9") \
    LINE("mov r9, r0") \
    LINE("str r4, [sp, #KEPT]") \
    LINE("movs r0, r7") \
    LINE("bl 64f") \
    LINE("str r7, [sp, #DEPTH_DY]") \
    LINE("ldr r1, [sp, #TO_X]")         /* LOW may be 28 bits here: by its lower 4, and the others */ \
    LINE("ldr r2, [sp, #TO_Y]") \
    LINE("lsls r3, r4, #28") \
    LINE("lsrs r3, r3, #28") \
    LINE("muls r3, r2, r3") \
    LINE("asrs r4, r4, #4") \
    LINE("muls r4, r2, r4") \
    LINE("muls r0, r2, r0") \
    LINE("ldr r5, [sp, #KEPT]") \
    LINE("lsls r6, r5, #28") \
    LINE("lsrs r6, r6, #28") \
    LINE("muls r6, r1, r6") \
    LINE("asrs r5, r5, #4") \
    LINE("muls r5, r1, r5") \
    LINE("mov r7, r9") \
    LINE("muls r7, r1, r7") \
    LINE("adds r0, r0, r7") \
    LINE("lsls r0, r0, #9") \
    LINE("adds r3, r3, r6") \
    LINE("lsrs r3, r3, #4") \
    LINE("adds r0, r0, r3") \
    LINE("adds r0, r0, r4") \
    LINE("adds r0, r0, r5") \
    DEPTH_AT_CORNER \
    /* light */ \
    LIGHT_DIFFERENCES \
    LINE("add r0, sp, #CORNERS") \
    LINE("ldmia r0!, {r2-r5}") \
    DETERMINANTS("r0", "r6", "r7", "r1", "r2", "r3", "r4", "r5") \
    LINE("str r6, [sp, #KEPT]") \
    LINE("ldr r1, [sp, #RECIPROCAL]") \
    LINE("lsrs r2, r1, #11") \
    LINE("lsls r1, r1, #21") \
    LINE("lsrs r1, r1, #21") \
    LINE("bl 65f") \
    LINE("mov r3, r9") \
    LINE("mov r9, r7") \
    LINE("ldr r6, [sp, #KEPT]") \
    LINE("add r5, sp, #KEPT") \
    LINE("stmia r5!, {r0, r3, r4}") \
    LINE("movs r0, r6") \
    LINE("bl 65f") \
    LINE("str r7, [sp, #LIGHT_DY]") \
    LINE("movs r6, r4") \
    LINE("movs r2, r0") \
    LINE("ldr r3, [sp, #KEPT]") \
    LINE("ldr r1, [sp, #KEPT + 4]") \
    LINE("ldr r0, [sp, #KEPT + 8]") \
    LIGHT_AT_CENTRE \
    LINE("b 58b") \
    /* r0: numerator of depth; r1, r2 halves of the reciprocal. r7: its gradient, r0 * 2^13 + r4. */ \
    LINE("64: lsls r5, r0, #12") \
    LINE("uxth r3, r0") \
    LINE("asrs r0, r0, #16") \
    LINE("movs r4, r2") \
    LINE("muls r4, r3, r4") \
    LINE("lsrs r4, r4, #16") \
    LINE("muls r3, r1, r3") \
    LINE("adds r4, r4, r3") \
    LINE("movs r3, r0") \
    LINE("muls r3, r2, r3") \
    LINE("adds r4, r4, r3") \
    LINE("ldr r3, [sp, #FRACTION]") \
    LINE("muls r3, r0, r3") \
    LINE("asrs r3, r3, #15") \
    LINE("adds r4, r4, r3") \
    LINE("asrs r4, r4, #3") \
    LINE("muls r0, r1, r0") \
    LINE("lsls r7, r0, #13") \
    LINE("adds r7, r7, r4") \
    LINE("66: ldr r3, [sp, #AREA]") \
    LINE("movs r6, r7") \
    LINE("muls r6, r3, r6") \
    LINE("subs r5, r5, r6")             /* rest */ \
    LINE("bmi 68f") \
    LINE("67: cmp r5, r3") \
    LINE("bge 69f") \
    LINE("bx lr") \
    LINE("68: subs r7, #1") \
    LINE("subs r4, #1") \
    LINE("adds r5, r5, r3") \
    LINE("bmi 68b") \
    LINE("bx lr") \
    LINE("69: adds r7, #1") \
    LINE("adds r4, #1") \
    LINE("subs r5, r5, r3") \
    LINE("b 67b") \
    /* r0: numerator of light; r2, r1 the reciprocal without its lower 11 bits, and those. r7: its gradient, r0 * 2^8 + r4. */ \
    LINE("65: lsls r5, r0, #28") \
    LINE("movs r4, r0") \
    LINE("muls r4, r1, r4") \
    LINE("asrs r4, r4, #3") \
    LINE("ldr r3, [sp, #FRACTION]") \
    LINE("lsrs r3, r3, #2") \
    LINE("muls r3, r0, r3") \
    LINE("asrs r3, r3, #16") \
    LINE("adds r4, r4, r3") \
    LINE("muls r0, r2, r0") \
    LINE("lsls r7, r0, #8") \
    LINE("adds r7, r7, r4") \
    LINE("b 66b") \
    LINE("77: add r0, sp, #LIGHTS")     /* left to C */ \
    LINE("ldmia r0!, {r1, r2}") \
    LINE("str r1, [r0, #4]") \
    LINE("str r2, [r0, #8]") \
    LINE("ldr r1, [sp, #TO_X]") \
    LINE("ldr r2, [sp, #TO_Y]") \
    LINE("bl textured_thumb_far") \
    LINE("add r0, sp, #DEPTH_LIGHT") \
    LINE("ldmia r0!, {r1, r2, r4}") \
    LINE("mov r8, r2") \
    LINE("str r4, [sp, #DEPTH_DY]") \
    LINE("add r0, sp, #COORDINATES") \
    LINE("ldmia r0!, {r3, r4, r5}") \
    LINE("mov r9, r4") \
    LINE("str r5, [sp, #LIGHT_DY]") \
    LINE("b 58b")

/* clang-format on */

#endif
