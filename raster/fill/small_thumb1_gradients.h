/* Gradients of small triangles in Thumb-1: parts of the loops of fill/small_thumb1.c, whose frame is in small_thumb1.h. */
#ifndef TUILE_FILL_SMALL_THUMB1_GRADIENTS_H
#define TUILE_FILL_SMALL_THUMB1_GRADIENTS_H

#include "small_thumb1.h"

/* clang-format off */

/* r7: 2^31 - 1 divided by the area, r6: divide_area_by_table. */
#define RECIPROCAL \
    LINE("lsrs r0, r6, #9") \
    LINE("bne 76f") \
    LINE("lsls r1, r6, #2")         /* an area below 512: the table's, or one less for powers of two */ \
    LINE("ldr r7, [sp, #TABLE]") \
    LINE("ldr r7, [r7, r1]") \
    LINE("subs r1, r6, #1") \
    LINE("tst r1, r6") \
    LINE("bne 75f") \
    LINE("subs r7, #1") \
    LINE("b 75f") \
    LINE("73: subs r7, #1") \
    LINE("adds r3, r3, r6") \
    LINE("bmi 73b") \
    LINE("b 75f") \
    LINE("74: adds r7, #1") \
    LINE("subs r3, r3, r6") \
    LINE("cmp r3, r6") \
    LINE("bge 74b") \
    LINE("b 75f") \
    LINE("76: ldr r7, [sp, #SHIFTS]") \
    LINE("ldrb r0, [r7, r0]") \
    LINE("movs r1, r6") \
    LINE("lsrs r1, r0") \
    LINE("lsls r1, r1, #2") \
    LINE("ldr r2, [sp, #TABLE]") \
    LINE("ldr r1, [r2, r1]") \
    LINE("lsrs r1, r1, #9")         /* inverse */ \
    LINE("lsls r7, r1, #9") \
    LINE("lsrs r7, r0")             /* quotient */ \
    LINE("movs r2, r7") \
    LINE("muls r2, r6") \
    LINE("ldr r3, [sp, #ONES]") \
    LINE("subs r3, r3, r2")         /* rest */ \
    LINE("asrs r2, r3, #8") \
    LINE("muls r2, r1") \
    LINE("adds r0, #14") \
    LINE("asrs r2, r0") \
    LINE("adds r7, r7, r2") \
    LINE("muls r2, r6") \
    LINE("subs r3, r3, r2") \
    LINE("asrs r2, r3, #1") \
    LINE("muls r2, r1") \
    LINE("adds r0, #7") \
    LINE("asrs r2, r0") \
    LINE("adds r7, r7, r2") \
    LINE("muls r2, r6") \
    LINE("subs r3, r3, r2") \
    LINE("bmi 73b") \
    LINE("cmp r3, r6") \
    LINE("bge 74b") \
    LINE("75:")

/* r7 into its halves: r9 the lower, r12 the upper one. */
#define HALVES LINE("lsrs r6, r7, #16") LINE("mov r12, r6") LINE("uxth r7, r7") LINE("mov r9, r7")

/* Of the corners r0 and, from there on, r1, r2 what OF leaves of depth_light; r3 x1, r4 y1, r5 x2, r6 y2; r7 is lost. */
#define DEPTH_OF(R) LINE("lsrs " R ", " R ", #8")
#define LIGHT_OF(R) LINE("uxtb " R ", " R)
#define VALUES(OF) \
    LINE("add r7, sp, #CORNER0") \
    LINE("ldm r7!, {r0-r6}") \
    OF("r0") \
    OF("r1") \
    OF("r2") \
    LINE("subs r1, r1, r0") \
    LINE("subs r2, r2, r0")

/* Those of depth are put away. */
#define Z_KEPT LINE("add r7, sp, #Z0") LINE("stm r7!, {r0, r1, r2}")

/* Then r6 the area. */
#define AREA LINE("muls r5, r4") LINE("muls r3, r6") LINE("subs r6, r5, r3")

/* r1, r2: numerators of dx and dy of light; r4 that of the first corner. */
#define LIGHT_NUMERATORS \
    VALUES(LIGHT_OF) \
    LINE("muls r4, r2") \
    LINE("muls r6, r1") \
    LINE("muls r5, r1") \
    LINE("subs r1, r4, r6") \
    LINE("muls r3, r2") \
    LINE("subs r2, r5, r3") \
    LINE("mov r4, r0")

/* Likewise of depth. */
#define DEPTH_NUMERATORS \
    LINE("add r7, sp, #X1") \
    LINE("ldm r7!, {r0-r6}") \
    LINE("muls r1, r6") \
    LINE("muls r3, r5") \
    LINE("subs r1, r1, r3") \
    LINE("muls r2, r5") \
    LINE("muls r0, r6") \
    LINE("subs r2, r2, r0")

/* Are they 16 bits, as signed numbers? Others are left to C. */
#define NUMERATORS_SHORT \
    LINE("sxth r3, r1") \
    LINE("cmp r3, r1") \
    LINE("beq 54f") \
    LINE("b 77f") \
    LINE("54: sxth r3, r2") \
    LINE("cmp r3, r2") \
    LINE("beq 55f") \
    LINE("b 77f") \
    LINE("55:")

/* The first row is put away, and the way of those whose depths are far apart parts. */
#define NEAR_AREA \
    LINE("50: str r5, [sp, #FIRST]") \
    LINE("str r6, [sp, #PIXELS]") \
    LINE("ldr r7, [sp, #DEPTH]") \
    LINE("mov r0, r8") \
    LINE("subs r7, r7, r0") \
    LINE("str r7, [sp, #ROW]") \
    VALUES(DEPTH_OF) \
    Z_KEPT \
    LINE("ldr r7, [sp, #NEAR]") \
    LINE("adds r1, r1, r7") \
    LINE("adds r2, r2, r7") \
    LINE("orrs r1, r2") \
    LINE("lsrs r1, r1, #18") \
    LINE("beq 51f") \
    LINE("b 71f") \
    LINE("51:") \
    AREA \
    RECIPROCAL \
    HALVES

/* The sum of what is at the corner, in r4, and of what lies between it and the first centre: in r5 and r7 dx divided by 2^16 and
 * its lower half, times to_x, in A and B those of dy. To r5. */
#define AT_CENTRE(A, B) \
    LINE("ldr r0, [sp, #TO_Y]") \
    LINE("muls " A ", r0") \
    LINE("muls " B ", r0") \
    LINE("adds r5, r5, " A) \
    LINE("adds r7, r7, " B) \
    LINE("lsls r5, r5, #12") \
    LINE("lsrs r7, r7, #4") \
    LINE("adds r5, r5, r7") \
    LINE("adds r5, r5, r4")
#define TO_CENTRE(A, B) LINE("ldr r0, [sp, #TO_X]") LINE("muls " A ", r0") LINE("muls " B ", r0")

/* At the corner, with a half: r4. */
#define LIGHT_AT LINE("lsls r4, r4, #1") LINE("adds r4, #1") LINE("lsls r4, r4, #23")
#define DEPTH_AT LINE("adds r4, #128") LINE("lsls r4, r4, #8")

/* lr: light's dx; dy and what it is at the first centre are put away. */
#define LIGHTS \
    LIGHT_NUMERATORS \
    NUMERATORS_SHORT \
    LINE("mov r3, r9") \
    LINE("muls r3, r1") \
    LINE("mov r5, r12") \
    LINE("muls r5, r1") \
    LINE("asrs r6, r3, #3") \
    LINE("lsls r7, r5, #13") \
    LINE("adds r7, r7, r6") \
    LINE("mov lr, r7") \
    LINE("asrs r3, r3, #16") \
    LINE("adds r5, r5, r3") \
    LINE("asrs r5, r5, #3") \
    LINE("uxth r7, r7") \
    TO_CENTRE("r5", "r7") \
    LINE("mov r3, r9") \
    LINE("muls r3, r2") \
    LINE("mov r6, r12") \
    LINE("muls r6, r2") \
    LINE("asrs r2, r3, #3") \
    LINE("lsls r1, r6, #13") \
    LINE("adds r1, r1, r2") \
    LINE("str r1, [sp, #LIGHT_DY]") \
    LINE("asrs r3, r3, #16") \
    LINE("adds r6, r6, r3") \
    LINE("asrs r6, r6, #3") \
    LINE("uxth r1, r1") \
    LIGHT_AT \
    AT_CENTRE("r6", "r1") \
    LINE("str r5, [sp, #FAR_LIGHT]")

/* r5 m of the numerator N, in which a * h is left; A is lost. MORE: what is added to m. */
#define PRODUCT(N, A, B, MORE) \
    LINE("sxth " A ", " N) \
    LINE("subs " N ", " N ", " A) \
    LINE("asrs " N ", " N ", #16") \
    LINE("mov r5, r9") \
    LINE("muls r5, " N) \
    LINE("mov " B ", r9") \
    LINE("muls " B ", " A) \
    LINE("asrs " B ", " B ", #16") \
    LINE("adds r5, r5, " B) \
    LINE("mov " B ", r12") \
    LINE("muls " A ", " B) \
    LINE("adds r5, r5, " A) \
    MORE \
    LINE("muls " N ", " B)

/* r8: depth's dx, r12 what it is at the first centre; dy is put away. */
#define DEPTHS \
    DEPTH_NUMERATORS \
    PRODUCT("r1", "r3", "r6", ) \
    LINE("lsls r7, r1, #13") \
    LINE("asrs r3, r5, #3") \
    LINE("adds r7, r7, r3") \
    LINE("mov r8, r7") \
    LINE("asrs r5, r5, #16") \
    LINE("adds r1, r1, r5") \
    LINE("asrs r1, r1, #3") \
    LINE("uxth r7, r7") \
    TO_CENTRE("r1", "r7") \
    PRODUCT("r2", "r3", "r6", ) \
    LINE("lsls r6, r2, #13") \
    LINE("asrs r3, r5, #3") \
    LINE("adds r6, r6, r3") \
    LINE("str r6, [sp, #DEPTH_DY]") \
    LINE("asrs r5, r5, #16") \
    LINE("adds r5, r5, r2") \
    LINE("asrs r5, r5, #3") \
    LINE("uxth r6, r6") \
    DEPTH_AT \
    LINE("ldr r0, [sp, #TO_Y]") \
    LINE("muls r5, r0") \
    LINE("muls r6, r0") \
    LINE("adds r5, r5, r1") \
    LINE("adds r6, r6, r7") \
    LINE("lsls r5, r5, #12") \
    LINE("lsrs r6, r6, #4") \
    LINE("adds r5, r5, r6") \
    LINE("adds r5, r5, r4") \
    LINE("mov r12, r5")

/* A triangle whose depths are far apart: exact gradients, as divide_scaled has them, of numerators below 2^30; those beyond are
 * left to C. LIGHT: light's, END: what rows want of them, LEFT_TO_C: what of those that C has made. CALL: 1 for light. */
#define FAR(LIGHT, END, CALL, LEFT_TO_C) \
    LINE("71:") \
    VALUES(DEPTH_OF) \
    LINE("ldr r7, [sp, #NEAR]") \
    LINE("lsls r7, r7, #3") \
    LINE("adds r1, r1, r7") \
    LINE("adds r2, r2, r7") \
    LINE("orrs r1, r2") \
    LINE("lsrs r1, r1, #21") \
    LINE("beq 56f") \
    LINE("b 77f") \
    LINE("56:") \
    AREA \
    RECIPROCAL \
    LINE("movs r0, r7") \
    LINE("muls r0, r6") \
    LINE("movs r1, #1") \
    LINE("lsls r1, r1, #31") \
    LINE("subs r1, r1, r0") \
    LINE("muls r1, r7") \
    LINE("lsrs r1, r1, #16") \
    LINE("str r1, [sp, #FRACTION]") \
    LINE("str r6, [sp, #DIVISOR]") \
    HALVES \
    LIGHT \
    DEPTH_NUMERATORS \
    DEPTH_AT \
    FAR_GRADIENTS("64f", "mov r8, r7", "DEPTH_DY") \
    LINE("mov r12, r5") \
    END \
    LINE("b 19b") \
    LINE("77: add r0, sp, #CORNER0")     /* left to C */ \
    LINE("movs r1, #" CALL) \
    LINE("bl small_thumb1_far") \
    LINE("add r7, sp, #FAR_DEPTH") \
    LINE("ldm r7!, {r0-r5}") \
    LINE("mov r12, r0") \
    LINE("mov r8, r1") \
    LINE("str r2, [sp, #DEPTH_DY]") \
    LEFT_TO_C \
    END \
    LINE("b 19b") \
    /* r1: numerator of depth; r7 its gradient, r5 divided by 2^16; r2 and r4 are kept */ \
    LINE("64: movs r0, r1") \
    PRODUCT("r1", "r3", "r6", LINE("ldr r3, [sp, #FRACTION]") LINE("muls r3, r1") LINE("asrs r3, r3, #15") LINE("adds r5, r5, r3")) \
    LINE("lsls r7, r1, #13") \
    LINE("asrs r3, r5, #3") \
    LINE("adds r7, r7, r3") \
    LINE("asrs r5, r5, #16") \
    LINE("adds r5, r5, r1") \
    LINE("asrs r5, r5, #3") \
    LINE("lsls r1, r0, #12") \
    LINE("65: ldr r6, [sp, #DIVISOR]") \
    LINE("movs r3, r7") \
    LINE("muls r3, r6") \
    LINE("subs r1, r1, r3")         /* rest */ \
    LINE("bmi 67f") \
    LINE("cmp r1, r6") \
    LINE("bge 69f") \
    LINE("bx lr") \
    LINE("66: subs r7, #1") \
    LINE("adds r1, r1, r6") \
    LINE("bmi 67f") \
    LINE("bx lr") \
    LINE("67: uxth r3, r7") \
    LINE("cmp r3, #0") \
    LINE("bne 66b") \
    LINE("subs r5, #1") \
    LINE("b 66b") \
    LINE("68: subs r1, r1, r6") \
    LINE("cmp r1, r6") \
    LINE("bge 69f") \
    LINE("bx lr") \
    LINE("69: adds r7, #1") \
    LINE("uxth r3, r7") \
    LINE("cmp r3, #0") \
    LINE("bne 68b") \
    LINE("adds r5, #1") \
    LINE("b 68b")

/* Of r1 and r2 by function OF: KEEP has dx in r7, DY is the place of dy; r5 at the first centre, the corner's being r4. */
#define FAR_GRADIENTS(OF, KEEP, DY) \
    LINE("bl " OF) \
    LINE(KEEP) \
    LINE("uxth r7, r7") \
    TO_CENTRE("r5", "r7") \
    LINE("str r5, [sp, #FAR_DEPTH]") \
    LINE("str r7, [sp, #FAR_DEPTH_DX]") \
    LINE("movs r1, r2") \
    LINE("bl " OF) \
    LINE("str r7, [sp, #" DY "]") \
    LINE("movs r1, r5") \
    LINE("uxth r6, r7") \
    LINE("ldr r5, [sp, #FAR_DEPTH]") \
    LINE("ldr r7, [sp, #FAR_DEPTH_DX]") \
    AT_CENTRE("r1", "r6")

/* Likewise of light, |n| < 2^15. */
#define FAR_LIGHTS \
    LIGHT_NUMERATORS \
    NUMERATORS_SHORT \
    LIGHT_AT \
    FAR_GRADIENTS("63f", "str r7, [sp, #FAR_LIGHT_DX]", "LIGHT_DY") \
    LINE("str r5, [sp, #FAR_LIGHT]")
#define FAR_LIGHT_OF \
    LINE("63: mov r3, r9") \
    LINE("muls r3, r1") \
    LINE("mov r5, r12") \
    LINE("muls r5, r1") \
    LINE("ldr r6, [sp, #FRACTION]") \
    LINE("muls r6, r1") \
    LINE("asrs r6, r6, #18") \
    LINE("asrs r3, r3, #3") \
    LINE("adds r3, r3, r6") \
    LINE("lsls r7, r5, #13") \
    LINE("adds r7, r7, r3") \
    LINE("asrs r3, r3, #13") \
    LINE("adds r5, r5, r3") \
    LINE("asrs r5, r5, #3") \
    LINE("lsls r1, r1, #28") \
    LINE("b 65b")

/* clang-format on */

#endif
