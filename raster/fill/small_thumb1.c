/* Set-up and rows of small triangles in Thumb-1, the loops of fill/small_thumb.h for Cortex-M0 and M0+. The numbers are those of
 * fill/small.h, to the bit.
 *
 * Eight registers do arithmetic, and the others only move, add and compare: so what is added alone stays there, as the sides, the
 * gradients along a row, and depth and light in column 0. All else is at the stack pointer, in an order that lets a stage load
 * what it wants with one instruction. As in Thumb-2, sides come first, and gradients are made of faces that cover a centre.
 *
 * Products. The reciprocal of an area has 31 bits, upper half h and lower half l. A numerator of depth, |n| < 2^28, is a * 2^16 +
 * b with b signed; then
 *     floor(n * r / 2^16) = a * h * 2^16 + m,   m = a * l + b * h + floor(b * l / 2^16),   |m| < 2^28 + 2^30 + 2^15,
 * and a numerator of light is b alone, or else the face is left to small_thumb1_far. What that is times a pixel's fraction is
 * wanted modulo 2^32 behind a shift by 4: of it divided by 2^16 and of its lower half (small_at).
 */
#include "../tune.h"

#include "../assembly.h"

#if ASSEMBLY_THUMB1

#include "small_thumb1_gradients.h"

/* A numerator of fill/gradient.h by the area: one copy of much code for what is rare. */
static TUILE_NOINLINE int64_t quotient(int64_t numerator, int32_t area, bool near, unsigned unit_bits) {
    const int32_t reciprocal = divide_area(area);
    return near ? fixed_mul_wide((int32_t)numerator, reciprocal) >> (31 - unit_bits)
                : divide_floor46(fixed_shift_left64(numerator, unit_bits), area, reciprocal);
}

/* Of depth or of light, by unit_bits. */
static TUILE_NOINLINE gradient_t gradient_any(const small_thumb1_far_t *f, int32_t c1, int32_t c2, bool near, unsigned unit_bits) {
    const int32_t area = f->x2 * f->y1 - f->x1 * f->y2;
    return (gradient_t){quotient(fixed_mul_wide(c2, f->y1) - fixed_mul_wide(c1, f->y2), area, near, unit_bits),
                        quotient(fixed_mul_wide(c1, f->x2) - fixed_mul_wide(c2, f->x1), area, near, unit_bits)};
}

void small_thumb1_far(small_thumb1_far_t *face, uint32_t gouraud) {
    const vertex_t v0 = {0, 0, face->corner0};
    const int32_t z0 = (int32_t)(face->corner0 >> 8), light0 = (int32_t)(face->corner0 & 0xff);
    const int32_t z1 = (int32_t)(face->corner1 >> 8) - z0, z2 = (int32_t)(face->corner2 >> 8) - z0;
    const bool near = triangle_depths_near(z1, z2);
    gradient_t g = gradient_any(face, z1, z2, near, 12);
    face->depth = (uint32_t)small_at(g, triangle_depth_of(&v0), (small_int_t)face->to_x, (small_int_t)face->to_y);
    face->depth_dx = (uint32_t)g.dx;
    face->depth_dy = (uint32_t)g.dy;
    if (!gouraud) { return; }
    g = gradient_any(face, (int32_t)(face->corner1 & 0xff) - light0, (int32_t)(face->corner2 & 0xff) - light0, near, 28);
    face->light = (uint32_t)small_at(g, triangle_light_of(&v0), (small_int_t)face->to_x, (small_int_t)face->to_y);
    face->light_dx = (uint32_t)g.dx;
    face->light_dy = (uint32_t)g.dy;
}

/* clang-format off */

#define SHIFTS_4(shift) shift, shift, shift, shift
#define SHIFTS_16(shift) SHIFTS_4(shift), SHIFTS_4(shift), SHIFTS_4(shift), SHIFTS_4(shift)
#define SHIFTS_64(shift) SHIFTS_16(shift), SHIFTS_16(shift), SHIFTS_16(shift), SHIFTS_16(shift)
const uint8_t small_thumb1_shifts[512] = {
    0, 1, 2, 2, SHIFTS_4(3), SHIFTS_4(4), SHIFTS_4(4), SHIFTS_16(5), SHIFTS_16(6), SHIFTS_16(6), SHIFTS_64(7),
    SHIFTS_64(8), SHIFTS_64(8), SHIFTS_64(9), SHIFTS_64(9), SHIFTS_64(9), SHIFTS_64(9),
};

#define ADDRESS LINE("lsls r0, r0, #3")

/* From column 0 of the row above; 31: from the first row's on. */
#define ROWS(SPAN_OF, ENTRY) \
    UNIFIED \
    LINE("30: mov r7, sp") \
    LINE("ldm r7, {r0, r1, r2, r5, r6, r7}") \
    LINE("add r10, r0") \
    LINE("add r11, r1") \
    LINE("add r12, r2") \
    LINE("add lr, r5") \
    LINE("adds r7, r7, r6") \
    LINE("str r7, [sp, #ROW]") \
    SPAN_OF(ENTRY) \
    LINE("mov r1, r8") \
    LINE("muls r1, r5") \
    LINE("add r1, r12") \
    LINE("mov r2, r9") \
    LINE("muls r2, r5") \
    LINE("add r2, lr") \
    LINE("lsls r0, r5, #1") \
    LINE("adds r0, r0, r7") \
    LINE("b 34f") \
    LINE("33: adds r0, #2") \
    LINE("add r1, r8") \
    LINE("add r2, r9") \
    LINE("34: ldrh r5, [r0]") \
    LINE("lsrs r7, r1, #16") \
    LINE("cmp r7, r5") \
    LINE("bls 36f") \
    LINE("strh r7, [r0]") \
    LINE("lsrs r7, r2, #26") \
    LINE("lsls r7, r7, #1") \
    LINE("ldrh r7, [r3, r7]") \
    LINE("strh r7, [r0, r4]") \
    ENDS

/* r8 and r9 dx, r12 and lr depth and light in column 0, r3 the ramp, r4 from a pixel's depth to its colour. */
ASSEMBLY_FUNCTION void small_thumb_gouraud(small_run_t *run) {
    (void)run;
    __asm__ volatile(UNIFIED
        FRAME
        LINE(".equ LIGHT_DY, 12")
        LINE(".equ STRIDE, 16")
        ENTER
        FACE(ADDRESS, )
        CORNERS(LINE("beq 90b"))
        DIFFERENCES(NEAR_X)
        CENTRE
        BENDS_LEFT(ADDRESS));

    __asm__ volatile(UNIFIED BENDS_RIGHT(ADDRESS) NEAR_AREA LIGHTS);

    __asm__ volatile(UNIFIED
        DEPTHS
        LINE("mov r9, lr")
        LINE("19: ldr r2, [sp, #FAR_LIGHT]")
        LINE("mov lr, r2")
        LINE("add r7, sp, #ROW")
        LINE("ldm r7!, {r3, r5, r6}")
        LINE("mov r7, r3")
        LINE("ldr r3, [sp, #RAMP]")
        LINE("ldr r4, [sp, #COLOUR]")
        LINE("ldr r0, [sp, #ROWS_AT]")
        LINE("mov pc, r0"));

    __asm__ volatile(ROWS(SPAN, "31") ROWS(SPAN_CLAMPED, "32"));

    __asm__ volatile(UNIFIED
        FAR(FAR_LIGHTS, LINE("ldr r7, [sp, #FAR_LIGHT_DX]") LINE("mov r9, r7"), "1", LINE("str r5, [sp, #LIGHT_DY]"))
        FAR_LIGHT_OF
        BESIDE(, ADDRESS));
}

/* clang-format on */

#endif
