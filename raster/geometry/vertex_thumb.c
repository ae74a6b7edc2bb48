/* 57 instructions a vertex with light, where gcc 12 takes 95, 48 without. What the loop is made of does not fit in registers: they
 * are loaded by the row, five to seven with one instruction, in the order of transform_run_t (transform.h). Sums are made 16 places
 * to the left, so that their upper word is the coarse value, and of light twice: usat ends at 2^n - 1, so it ends LIGHT_MAX with 2
 * added. r of geometry/vertex.c is below 2^31, so products with it are signed ones.
 */
#include "../tune.h"

#include "vertex_thumb.h"

#include <stddef.h>

#include "../assembly.h"

#if ASSEMBLY_THUMB2

#define AT_LIGHT 96
#define GUARD_BEHIND_LIGHT 20
#define ANY_BEHIND_LIGHT 28
_Static_assert(offsetof(transform_run_t, light) == AT_LIGHT &&
                   offsetof(transform_run_t, guard_x) == AT_LIGHT + GUARD_BEHIND_LIGHT &&
                   offsetof(transform_run_t, any) == AT_LIGHT + ANY_BEHIND_LIGHT,
               "offsets in the assembly");
_Static_assert(VERTEX_ANY_OUTSIDE == 1 && VERTEX_ANY_BEYOND == 2 && LIGHT_MIN == 2 && LIGHT_MAX == 253 &&
                   VERTEX_OUTSIDE == INT16_MIN && GUARD_SPAN - 2 * GUARD_MARGIN == 0x7fe0,
               "numbers in the assembly");

/* clang-format off */

/* r0 run, r1 positions, r2 normals, or the end where there are none, r3 out.
 * Down to depths: r4 x, r5 y, r6 z, each 16 places to the left; r7 r. */
#define PROJECT \
    "1: ldr r5, [r1], #4\n" \
    "ldrh r6, [r1], #2\n" \
    "ldmia r0!, {r7, r8, r9, r10, r11, r12, lr}\n" /* w, zeros, ones */ \
    "lsls r4, r5, #16\n" \
    "bfc r5, #0, #16\n" \
    "lsls r6, r6, #16\n" \
    "smlal r10, r11, r7, r4\n" \
    "smlal r10, r11, r8, r5\n" \
    "smlal r10, r11, r9, r6\n" \
    "lsl r11, r11, r12\n" \
    "orr r11, r11, #0x80000000\n" \
    "lsr r7, r11, #16\n" /* fixed_reciprocal */ \
    "udiv r7, lr, r7\n" \
    "lsls r7, r7, #14\n" \
    "umull r8, r9, r11, r7\n" \
    "rsb r9, r9, #0x40000000\n" \
    "lsr r8, r7, #16\n" \
    "mul r8, r8, r9\n" \
    "add r7, r7, r8, asr #14\n" \
    "ldmia r0!, {r8, r9, r10, r11, r12}\n" /* x */ \
    "smlal r11, r12, r8, r4\n" \
    "smlal r11, r12, r9, r5\n" \
    "smlal r11, r12, r10, r6\n" \
    "smull r8, lr, r12, r7\n" \
    "ldmia r0!, {r8, r9, r10, r11, r12}\n" /* y */ \
    "smlal r11, r12, r8, r4\n" \
    "smlal r11, r12, r9, r5\n" \
    "smlal r11, r12, r10, r6\n" \
    "smull r8, r5, r12, r7\n" \
    "ldmia r0!, {r4, r6, r8, r9, r10, r11, r12}\n" /* half ... region_height; r0: at light */ \
    "add lr, lr, r4\n" \
    "adds r5, r5, r4\n" \
    "asr lr, lr, r6\n" \
    "asrs r5, r5, r6\n" \
    "lsr r7, r7, r8\n" \
    "sub r9, lr, r9\n" \
    "sub r11, r5, r11\n" \
    "cmp r9, r10\n" \
    "it lo\n" \
    "cmplo r11, r12\n" \
    "bhs 3f\n" \
    "2: bfi lr, r5, #16, #16\n"

/* A vertex beyond the region, where r4, r6 and r8 ... r12 are free. */
#define BEYOND \
    "3: ldr r12, [r0, %[any]]\n" \
    "ldrd r8, r9, [r0, %[guard]]\n" \
    "movw r6, #0x7fe0\n" \
    "orr r12, r12, #2\n" \
    "sub r8, lr, r8\n" \
    "sub r9, r5, r9\n" \
    "cmp r8, r6\n" \
    "it lo\n" \
    "cmplo r9, r6\n" \
    "itttt hs\n" \
    "orrhs r12, r12, #1\n" \
    "movhs lr, #0x8000\n" \
    "movhs r5, #0\n" \
    "movhs r7, #0\n" \
    "str r12, [r0, %[any]]\n" \
    "b 2b\n"

static TUILE_NOINLINE void run_lit(transform_run_t *run, const int16_t *positions, const int8_t *normals, vertex_t *out) {
    register transform_run_t *r0 __asm__("r0") = run;
    register const int16_t *r1 __asm__("r1") = positions;
    register const int8_t *r2 __asm__("r2") = normals;
    register vertex_t *r3 __asm__("r3") = out;
    __asm__ volatile(PROJECT
        "ldrsb r9, [r2], #1\n"
        "ldrsb r10, [r2], #1\n"
        "ldrsb r11, [r2], #1\n"
        "ldmia r0, {r4, r5, r6, r8, r12}\n"
        "mul r4, r4, r9\n"
        "mla r4, r5, r10, r4\n"
        "mla r4, r6, r11, r4\n"
        "usat r4, #10, r4, asr #13\n"
        "add r4, r4, r8\n"
        "usat r4, #8, r4\n"
        "subs r4, #2\n"
        "subs r0, %[light]\n"
        "add r4, r4, r7, lsl #8\n"
        "strd lr, r4, [r3], #8\n"
        "cmp r3, r12\n"
        "bne 1b\n"
        "b 4f\n" BEYOND "4:\n"
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)
        : [light] "n"(AT_LIGHT), [guard] "n"(GUARD_BEHIND_LIGHT), [any] "n"(ANY_BEHIND_LIGHT)
        : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}

static TUILE_NOINLINE void run_unlit(transform_run_t *run, const int16_t *positions, vertex_t *out) {
    register transform_run_t *r0 __asm__("r0") = run;
    register const int16_t *r1 __asm__("r1") = positions;
    register const vertex_t *r2 __asm__("r2") = run->end;
    register vertex_t *r3 __asm__("r3") = out;
    __asm__ volatile(PROJECT
        "lsls r7, r7, #8\n"
        "subs r0, %[light]\n"
        "adds r7, #2\n"
        "strd lr, r7, [r3], #8\n"
        "cmp r3, r2\n"
        "bne 1b\n"
        "b 4f\n" BEYOND "4:\n"
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)
        : [light] "n"(AT_LIGHT), [guard] "n"(GUARD_BEHIND_LIGHT), [any] "n"(ANY_BEHIND_LIGHT)
        : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}

/* clang-format on */

static transform_run_row_t run_row(const transform_row_t *row) {
    const uint64_t t = (uint64_t)row->t << 16;
    return (transform_run_row_t){{row->m[0], row->m[1], row->m[2]}, (uint32_t)t, (uint32_t)(t >> 32)};
}

void vertex_thumb_make(transform_t *transform) {
    transform->run = (transform_run_t){.w = run_row(&transform->w),
                                       .ones = UINT32_MAX,
                                       .x = run_row(&transform->x),
                                       .y = run_row(&transform->y),
                                       .region_x = transform->region_x,
                                       .region_width = transform->region_width,
                                       .region_y = transform->region_y,
                                       .region_height = transform->region_height,
                                       .light = {transform->lights[0][0], transform->lights[0][1], transform->lights[0][2]},
                                       .ambient = transform->ambient + 2,
                                       .guard_x = transform->guard_x + GUARD_MARGIN,
                                       .guard_y = transform->guard_y + GUARD_MARGIN};
}

unsigned vertex_thumb(transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out,
                      const vertex_octave_t *octave) {
    transform_run_t *const run = &transform->run;
    run->zeros = octave->zeros;
    run->half = octave->half;
    run->shift = octave->shift;
    run->depth_shift = octave->depth_shift;
    run->end = out + count;
    run->any = 0;
    if (normals) {
        run_lit(run, positions, normals, out);
    } else {
        run_unlit(run, positions, out);
    }
    return run->any;
}

#endif
