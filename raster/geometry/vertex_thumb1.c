/* 161 instructions a vertex with light, where gcc 12 takes 286, 143 without. What the loop is made of does not fit in registers:
 * they are loaded in the order of transform_run_t (transform.h), from one of whose parts an address that is loaded along with them
 * leads to the next; what is kept for later is stored where a later load finds it.
 *
 * Rows. An entry is high * 2^15 + low, |low| <= 2^14, so that three products of low and what t leaves below 2^15 are less than
 * 2^31, and the sum is coarse * 2, with a bit more: right to 31 bits, which is what a coarse value has (transform_row_t), and W.
 *
 * Reciprocals (fixed_reciprocal of divide.h). floor((2^32 - 1) / d) for 2^15 <= d < 2^16, d the upper half of w, is at most one
 * less than a line over 128 numbers d, the chord of 2^32 / d. With rest = 2^32 - 1 - quotient * d, what the long
 * product leaves of 2^30 there is ((rest - ((quotient * l) >> 16)) >> 2) + 1, where l is the lower half of w; 2^16 of the
 * quotient's 17 bits give l itself. A loop over all 2^31 w has found each r equal, and below 2^31.
 *
 * Products, floor(a * r / 2^32): with a's lower half signed and its upper one, |a| <= 2^30, the products across are less than 2^30
 * each, and together with the upper half of the low one not more than 2^31 - 2^14.
 */
#include "../tune.h"

#include "vertex_thumb.h"

#include <stddef.h>

#include "../assembly.h"

#if ASSEMBLY_THUMB1

_Static_assert(offsetof(transform_run_t, light) == 4 && offsetof(transform_run_t, normals) == 16 &&
                   offsetof(transform_run_t, x) == 20 && offsetof(transform_run_t, y) == 52 && offsetof(transform_run_t, w) == 88 &&
                   offsetof(transform_run_t, at_x_row) == 120 && offsetof(transform_run_t, minus_y) == 128 &&
                   offsetof(transform_run_t, lights) == 152,
               "the order of the assembly");
_Static_assert(VERTEX_ANY_OUTSIDE == 1 && VERTEX_ANY_BEYOND == 2 && LIGHT_MIN == 2 && LIGHT_MAX == 253 &&
                   VERTEX_OUTSIDE == INT16_MIN,
               "numbers in the assembly");
/* A word of transform_run_t, from the register's address at the time: that of `from`. */
#define WORD(name, from) "n"(offsetof(transform_run_t, name) - offsetof(transform_run_t, from))

/* A line A - B * d over 128 numbers d, in 2^-15, modulo 2^32: the quotient is below 2^17. */
#define AT(i) (UINT64_C(32768) + 128 * (i))
#define SLOPE(i) (((UINT64_C(1) << 47) + AT(i) * AT((i) + 1) / 2) / (AT(i) * AT((i) + 1)))
#define LINE(i) \
    { (uint32_t)(((UINT64_C(1) << 47) - 1) / AT(i) + SLOPE(i) * AT(i)), (uint32_t)SLOPE(i) }
#define LINES4(i) LINE(i), LINE((i) + 1), LINE((i) + 2), LINE((i) + 3)
#define LINES16(i) LINES4(i), LINES4((i) + 4), LINES4((i) + 8), LINES4((i) + 12)
#define LINES64(i) LINES16(i), LINES16((i) + 16), LINES16((i) + 32), LINES16((i) + 48)
static const uint32_t lines[256][2] = {LINES64(0), LINES64(64), LINES64(128), LINES64(192)};

/* clang-format off */

/* r0 what is loaded next; r1 position, later p, q and r in r1, r2, r3. High registers: r8 ambient light; r9 lines, less the 256 of
 * them that no w has; r10 light; r11, r12 height and width of the region; lr what packs x and y, as they are counted from there. */

/* r5: twice the sum, coarse and a bit; r4, r6, r7 go. last: what is loaded with the last entry. */
#define ROW(last) \
    "ldmia r0!, {r4, r5, r6, r7}\n" /* low, high of t; low, high of the entry */ \
    "muls r6, r1, r6\n" \
    "muls r7, r1, r7\n" \
    "adds r4, r6\n" \
    "adds r5, r7\n" \
    "ldmia r0!, {r6, r7}\n" \
    "muls r6, r2, r6\n" \
    "muls r7, r2, r7\n" \
    "adds r4, r6\n" \
    "adds r5, r7\n" \
    last \
    "muls r6, r3, r6\n" \
    "muls r7, r3, r7\n" \
    "adds r4, r6\n" \
    "adds r5, r7\n" \
    "asrs r4, r4, #15\n" \
    "adds r5, r4\n" \
    "asrs r5, r5, #1\n"

/* a = floor(a * r / 2^32): r1, r2: lower, upper half of r; r3, r4 go. */
#define TIMES_RECIPROCAL(a) \
    "sxth r3, " a "\n" \
    "subs " a ", r3\n" \
    "asrs " a ", " a ", #16\n" \
    "movs r4, r3\n" \
    "muls r4, r1, r4\n" \
    "asrs r4, r4, #16\n" \
    "muls r3, r2, r3\n" \
    "adds r4, r3\n" \
    "movs r3, " a "\n" \
    "muls r3, r1, r3\n" \
    "adds r4, r3\n" \
    "asrs r4, r4, #16\n" \
    "muls " a ", r2, " a "\n" \
    "adds " a ", r4\n"

/* The loop lies in memory as first, last and middle part, so that each conditional branch reaches as far as it must, 254 bytes.
 *
 * From r1, at a position, to the quotient r4 and the rest r7 of d r6, w in r5. */
#define FIRST \
    "ldrh r2, [r1, #2]\n" \
    "ldrh r3, [r1, #4]\n" \
    "ldrh r4, [r1]\n" \
    "adds r1, #6\n" \
    "str r1, [r0, %[position]]\n" \
    "sxth r1, r4\n" \
    "sxth r2, r2\n" \
    "sxth r3, r3\n" \
    ROW("ldmia r0!, {r6, r7}\n") \
    "ldmia r0, {r0, r6}\n" \
    "lsls r5, r6\n" \
    "bpl 40b\n" \
    "41: lsrs r6, r5, #16\n" \
    "lsrs r4, r5, #23\n" \
    "lsls r4, r4, #3\n" \
    "add r4, r9\n" \
    "ldmia r4, {r4, r7}\n" \
    "muls r7, r6, r7\n" \
    "subs r4, r7\n" \
    "lsrs r4, r4, #15\n" \
    "movs r7, r6\n" \
    "muls r7, r4, r7\n" \
    "mvns r7, r7\n" \
    "bpl 20f\n" \
    "subs r4, #1\n" /* the line lies above the quotient */ \
    "adds r7, r6\n" \
    "b 20f\n"

/* r5: y as it is counted from the region; r6: X, r7: shift. */
#define MIDDLE \
    "20: uxth r5, r5\n" \
    "uxth r6, r4\n" \
    "muls r6, r5, r6\n" \
    "lsrs r6, r6, #16\n" \
    "subs r7, r5\n" \
    "subs r7, r6\n" \
    "asrs r7, r7, #2\n" \
    "adds r7, #1\n" \
    "lsrs r6, r4, #2\n" \
    "muls r7, r6, r7\n" \
    "asrs r7, r7, #14\n" \
    "lsls r4, r4, #14\n" \
    "adds r4, r7\n" \
    "str r4, [r0, %[r]]\n" \
    ROW("ldmia r0!, {r6, r7}\n") \
    "str r5, [r0, %[x]]\n" \
    ROW("ldmia r0, {r0, r6, r7}\n") \
    "ldrh r1, [r0, %[r_low]]\n" \
    "ldrh r2, [r0, %[r_low]+2]\n" \
    TIMES_RECIPROCAL("r5") \
    "ldmia r0!, {r4, r6, r7}\n" \
    "asrs r5, r7\n" /* carry: what rounds */ \
    "adcs r5, r4\n" \
    "cmp r5, r11\n" \
    "blo 30b\n" \
    TIMES_RECIPROCAL("r6") \
    "ldmia r0!, {r1, r2, r3}\n" \
    "asrs r6, r7\n" \
    "adcs r6, r2\n" \
    "31:\n" \
    BEYOND

/* A W whose leading one is not at the top: of the second octave, where the cluster has one. The next vertex is then the run's last,
 * so that what is changed here for this one is put back before another. Any W has a leading one, as in geometry/vertex.c. */
#define LOWER \
    "40: ldr r4, %[second]\n" \
    "cmp r4, #0\n" \
    "beq 44f\n" \
    "lsls r5, r5, #1\n" \
    "movs r6, r0\n" \
    "adds r6, %[below]\n" \
    "ldr r4, [r6, %[shift]]\n" \
    "subs r4, #1\n" \
    "str r4, [r6, %[shift]]\n" \
    "ldr r4, [r6, %[depth_shift]]\n" \
    "subs r4, #1\n" \
    "str r4, [r6, %[depth_shift]]\n" \
    "ldr r4, [r6, %[at]]\n" \
    "str r4, [r6, %[end]]\n" \
    "44: movs r4, #1\n" \
    "lsls r4, r4, #31\n" \
    "orrs r5, r4\n" \
    "b 41f\n"

#define RESTORE \
    "42: ldr r3, %[last]\n" \
    "cmp r1, r3\n" \
    "bne 43f\n" \
    "b 5f\n" \
    "43: " \
    "ldr r6, %[run]\n" \
    "adds r6, %[begin]\n" \
    "ldr r4, [r6, %[shift]]\n" \
    "adds r4, #1\n" \
    "str r4, [r6, %[shift]]\n" \
    "ldr r4, [r6, %[depth_shift]]\n" \
    "adds r4, #1\n" \
    "str r4, [r6, %[depth_shift]]\n" \
    "str r3, [r6, %[end]]\n" \
    "b 1f\n"

/* r5: x and y as they are stored; r6: the depth 8 places to the left. */
#define LAST \
    "30:\n" \
    TIMES_RECIPROCAL("r6") \
    "ldmia r0!, {r1, r2, r3}\n" \
    "asrs r6, r7\n" \
    "adcs r6, r2\n" \
    "cmp r6, r12\n" \
    "bhs 31f\n" \
    "lsls r5, r5, #16\n" \
    "adds r5, r6\n" \
    "add r5, lr\n" \
    "10: lsrs r1, r3\n" \
    "lsls r6, r1, #8\n"

/* y or x beyond the region, or x negative: r1 r, r2 what x has less, r5 y, r6 x. */
#define BEYOND \
    "subs r6, r2\n" \
    "ldr r7, [r0, %[region]]\n" \
    "movs r2, #2\n" \
    "ldrsh r2, [r7, r2]\n" \
    "adds r5, r2\n" \
    "movs r2, #0\n" \
    "ldrsh r2, [r7, r2]\n" \
    "subs r2, r6, r2\n" \
    "ldrh r4, [r7, %[region_width]]\n" \
    "cmp r2, r4\n" \
    "bhs 32f\n" \
    "movs r2, #2\n" \
    "ldrsh r2, [r7, r2]\n" \
    "subs r2, r5, r2\n" \
    "cmp r2, r11\n" \
    "blo 35f\n" \
    "32: ldr r4, [r0, %[any]]\n" \
    "movs r2, #2\n" \
    "orrs r4, r2\n" \
    "str r4, [r0, %[any]]\n" \
    "movs r4, #1\n" \
    "lsls r4, r4, #15\n" \
    "subs r4, #32\n" \
    "ldr r2, [r7, %[guard_x]]\n" \
    "subs r2, r6, r2\n" \
    "subs r2, #16\n" \
    "cmp r2, r4\n" \
    "bhs 33f\n" \
    "ldr r2, [r7, %[guard_y]]\n" \
    "subs r2, r5, r2\n" \
    "subs r2, #16\n" \
    "cmp r2, r4\n" \
    "blo 35f\n" \
    "33: movs r4, #3\n" \
    "str r4, [r0, %[any]]\n" \
    "movs r5, #1\n" \
    "lsls r5, r5, #15\n" \
    "movs r1, #0\n" \
    "b 10b\n" \
    "35: lsls r5, r5, #16\n" \
    "uxth r6, r6\n" \
    "adds r5, r6\n" \
    "b 10b\n"

/* What is in high registers all along, and what else the assembly reads. */
#define RUN(...) \
    const void *const last = run->end; \
    register const void *r0 __asm__("r0") = run->lights; \
    register const int16_t *r1 __asm__("r1") = positions; \
    register vertex_t *r2 __asm__("r2") = out; \
    register uint32_t r8 __asm__("r8") = transform->ambient; \
    register uintptr_t r9 __asm__("r9") = (uintptr_t)lines - sizeof lines; \
    register uint32_t r11 __asm__("r11") = transform->region_height; \
    register uint32_t r12 __asm__("r12") = width; \
    register uint32_t lr __asm__("lr") = pack; \
    __asm__ volatile(".syntax unified\n" __VA_ARGS__ \
                     : "+r"(r0), "+r"(r1), "+r"(r2) \
                     : "r"(r8), "r"(r9), "r"(r11), "r"(r12), "r"(lr), [position] WORD(position, w), [r] WORD(r, x), [x] WORD(at_x, y), [r_low] WORD(r, minus_y), \
                       [region] WORD(region, lights), [any] WORD(any, lights), [out] WORD(out, w), \
                       [region_width] "n"(offsetof(transform_t, region_width) - offsetof(transform_t, region_x)), \
                       [guard_x] "n"(offsetof(transform_t, guard_x) - offsetof(transform_t, region_x)), \
                       [guard_y] "n"(offsetof(transform_t, guard_y) - offsetof(transform_t, region_x)), [second] "m"(second), \
                       [last] "m"(last), [run] "m"(run), [below] WORD(minus_y, x), [begin] WORD(minus_y, at_w), \
                       [shift] WORD(shift, minus_y), [depth_shift] WORD(depth_shift, minus_y), [at] WORD(position, minus_y), \
                       [end] WORD(end, minus_y) \
                     : "r3", "r4", "r5", "r6", "r7", "r10", "cc", "memory")

static TUILE_NOINLINE void run_lit(const transform_t *transform, const int16_t *positions, vertex_t *out, uint32_t width,
                                   uint32_t pack, uint32_t second) {
    const transform_run_t *const run = &transform->run;
    RUN("b 1f\n" RESTORE LOWER
        "3: mov r3, r8\n"
        "b 2f\n"
        "4: movs r3, #253\n"
        "b 2f\n"
        "1: ldmia r0, {r0, r3, r4, r5, r6}\n"
        "str r2, [r0, %[out]]\n"
        "lsrs r7, r1, #1\n" /* three bytes for six */
        "ldrsb r2, [r6, r7]\n"
        "muls r3, r2, r3\n"
        "adds r7, #1\n"
        "ldrsb r2, [r6, r7]\n"
        "muls r4, r2, r4\n"
        "adds r3, r4\n"
        "adds r7, #1\n"
        "ldrsb r2, [r6, r7]\n"
        "muls r5, r2, r5\n"
        "adds r3, r5\n"
        "asrs r3, r3, #13\n"
        "bmi 3b\n"
        "add r3, r8\n"
        "cmp r3, #253\n"
        "bhi 4b\n"
        "2: mov r10, r3\n" FIRST LAST
        "add r6, r10\n"
        "ldmia r0, {r0, r1, r2, r3}\n"
        "stmia r2!, {r5, r6}\n"
        "cmp r1, r3\n"
        "bne 1b\n"
        "b 42b\n" MIDDLE
        "5:\n");
}

static TUILE_NOINLINE void run_unlit(const transform_t *transform, const int16_t *positions, vertex_t *out, uint32_t width,
                                     uint32_t pack, uint32_t second) {
    const transform_run_t *const run = &transform->run;
    RUN("b 1f\n" RESTORE LOWER
        "1: str r2, [r0, %[out]]\n" FIRST LAST
        "adds r6, #2\n"
        "ldmia r0, {r0, r1, r2, r3}\n"
        "stmia r2!, {r5, r6}\n"
        "cmp r1, r3\n"
        "bne 1b\n"
        "b 42b\n" MIDDLE
        "5:\n");
}

/* clang-format on */

static transform_run_entry_t run_entry(int32_t m) {
    const int32_t low = (int32_t)(((uint32_t)m + 0x4000u) & 0x7fffu) - 0x4000;
    return (transform_run_entry_t){low, (m >> 15) + (low < 0)};
}

static transform_run_row_t run_row(const transform_row_t *row) {
    return (transform_run_row_t){
        {(int32_t)(row->t & 0x7fff), (int32_t)(uint32_t)((uint64_t)row->t >> 15)},
        {run_entry(row->m[0]), run_entry(row->m[1]), run_entry(row->m[2])},
    };
}

static transform_run_row_y_t run_row_y(const transform_row_t *row) {
    const transform_run_row_t y = run_row(row);
    return (transform_run_row_y_t){y.t, {y.m[0], y.m[1]}, NULL, y.m[2]};
}

void vertex_thumb_make(transform_t *transform) {
    transform->run = (transform_run_t){.light = {transform->lights[0][0], transform->lights[0][1], transform->lights[0][2]},
                                       .x = run_row(&transform->x),
                                       .y = run_row_y(&transform->y),
                                       .w = run_row(&transform->w),
                                       .minus_y = -transform->region_y,
                                       .minus_x = transform->region_x < 0 ? 0 : -transform->region_x};
}

unsigned vertex_thumb(transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out,
                      const vertex_octave_t *octave) {
    transform_run_t *const run = &transform->run;
    run->at_w = &run->w;
    run->at_x_row = &run->x;
    run->y.at_minus_y = &run->minus_y;
    run->lights = normals ? (const void *)run : &run->w;
    run->region = &transform->region_x;
    run->normals = (uintptr_t)normals - (uintptr_t)positions / 2;
    run->zeros = octave->zeros;
    run->shift = octave->shift;
    run->depth_shift = octave->depth_shift;
    run->end = positions + (size_t)3 * count;
    run->any = 0;
    /* x of the region counts from where it is not negative, so that no borrow gets from x into y where both are packed. */
    const int32_t left = -run->minus_x, width = transform->region_x + transform->region_width - left;
    const uint32_t pack = ((uint32_t)transform->region_y << 16) + (uint32_t)left;
    if (normals) {
        run_lit(transform, positions, out, width > 0 ? (uint32_t)width : 0, pack, octave->second);
    } else {
        run_unlit(transform, positions, out, width > 0 ? (uint32_t)width : 0, pack, octave->second);
    }
    return run->any;
}

#endif
