/* The loop of face_plain.c: 20 instructions for a face that is turned away, about 59 for one that is kept, where gcc 12 takes 26
 * and 80. Corners are read again where the topmost has been found, in the order that they have from there on, so that none is
 * moved; records are stored as words. What the loop wants seldom lies on the stack.
 */
#include "../tune.h"

#include "face_thumb.h"

#include <stddef.h>

#include "../assembly.h"

#if ASSEMBLY_THUMB2

typedef struct face_pair {
    uint32_t first, second;
} face_pair_t;

/* What is written, and what is read two at a time. */
typedef struct face_run {
    face_pair_t bucket; /* its first pixel row; rows of a tile */
    face_pair_t base;   /* slot of the cluster's first vertex; material */
    uint16_t *list, *buckets;
    uint32_t degenerate, outside;
} face_run_t;

typedef struct face_sun {
    face_pair_t light, last; /* x, y; z, ambient light with 2 added */
    const int8_t *normals;   /* where those of faces at address 0 were */
} face_sun_t;

_Static_assert(offsetof(record_t, v0) == 2 && offsetof(record_t, d1) == 4 && offsetof(record_t, d2) == 5 &&
                   offsetof(record_t, material) == 6 && offsetof(record_t, light) == 7 && sizeof(record_t) == 8 &&
                   offsetof(record_surface_t, source) == 8 && sizeof(record_surface_t) == 12,
               "records in the assembly");
_Static_assert(SHORT_SIDE == 512 && LIGHT_MAX == 253, "numbers in the assembly");

/* r0 faces, behind the one that is looked at; r1 x, r2 y of the vertices; r3 record; r4 number; r5 longest; r6 end.
 * The area; then r11, r12, lr: y of the corners, and the length of sides in r9. DSP: x and y are subtracted at once; what is in the
 * upper half of lengths does not count. */
#if defined(__ARM_FEATURE_DSP)
#define LENGTHS 0xffffu
#define AREA                      \
    "1: ldrb r8, [r0], #4\n"      \
    "ldrb r9, [r0, #-3]\n"        \
    "ldrb r10, [r0, #-2]\n"       \
    "ldr r11, [r1, r8, lsl #3]\n" \
    "ldr r12, [r1, r9, lsl #3]\n" \
    "ldr lr, [r1, r10, lsl #3]\n" \
    "ssub16 r9, r12, r11\n"       \
    "ssub16 r10, lr, r11\n"       \
    "smusdx r8, r10, r9\n"        \
    "cmp r8, #0\n"                \
    "ble 7f\n"                    \
    "asr r11, r11, #16\n"         \
    "asr r12, r12, #16\n"         \
    "asr lr, lr, #16\n"           \
    "add r9, r9, #256\n"          \
    "add r10, r10, #256\n"        \
    "orr r9, r9, r10\n"
#else
#define LENGTHS UINT32_MAX
#define AREA                           \
    "1: ldrb r8, [r0], #4\n"           \
    "ldrb r9, [r0, #-3]\n"             \
    "ldrb r10, [r0, #-2]\n"            \
    "ldrsh r11, [r2, r8, lsl #3]\n"    \
    "ldrsh r8, [r1, r8, lsl #3]\n"     \
    "ldrsh r12, [r2, r9, lsl #3]\n"    \
    "ldrsh r9, [r1, r9, lsl #3]\n"     \
    "ldrsh lr, [r2, r10, lsl #3]\n"    \
    "ldrsh r10, [r1, r10, lsl #3]\n"   \
    "sub r9, r9, r8\n"   /* xb - xa */ \
    "sub r10, r10, r8\n" /* xc - xa */ \
    "sub r8, r12, r11\n"               \
    "sub r7, lr, r11\n"                \
    "mul r8, r10, r8\n"                \
    "mls r8, r9, r7, r8\n"             \
    "cmp r8, #0\n"                     \
    "ble 7f\n"                         \
    "add r9, r9, #256\n"               \
    "add r10, r10, #256\n"             \
    "orr r9, r9, r10\n"
#endif

/* r7, r8, r10: the corners from the topmost on; lr, r12: its y and the lowest corner's, 7 added; r11: the row. */
#define TOPMOST              \
    "cmp r12, r11\n"         \
    "blt 2f\n"               \
    "cmp lr, r11\n"          \
    "blt 3f\n"               \
    "cmp r12, lr\n"          \
    "it lt\n"                \
    "movlt r12, lr\n"        \
    "add lr, r11, #7\n"      \
    "add r12, r12, #7\n"     \
    "ldrb r7, [r0, #-4]\n"   \
    "ldrb r8, [r0, #-3]\n"   \
    "ldrb r10, [r0, #-2]\n"  \
    "4: asr r11, lr, #4\n"   \
    "cmp r11, r12, asr #4\n" \
    "bge 8f\n"               \
    "sub r12, r12, lr\n"     \
    "orrs r5, r5, r9\n"      \
    "orr r5, r5, r12\n"

/* r12: the bucket. Then the record's words r9 and r8. */
#define RECORD                   \
    "ldrd r9, lr, %[bucket]\n"   \
    "ldr r12, %[list]\n"         \
    "sub r9, r11, r9\n"          \
    "cmp r9, lr\n"               \
    "bhs 5f\n"                   \
    "6: ldrd r11, lr, %[base]\n" \
    "subs r8, r8, r7\n"          \
    "sub r10, r10, r7\n"         \
    "ldrb r9, [r0, #-1]\n"       \
    "uxtb r8, r8\n"              \
    "bfi r8, r10, #8, #8\n"      \
    "add r9, r9, lr\n"           \
    "bfi r8, r9, #16, #8\n"      \
    "ldrh r9, [r12]\n"           \
    "add r7, r7, r11\n"          \
    "adds r4, #1\n"              \
    "orr r9, r9, r7, lsl #16\n"  \
    "strh r4, [r12]\n"

#define LIGHT                                                                          \
    "ldr r10, %[normals]\n"                                                            \
    "sub r12, r0, r0, lsr #2\n" /* three bytes for four, both behind the face's own */ \
    "add r12, r12, r10\n"                                                              \
    "ldrd r11, lr, %[light]\n"                                                         \
    "ldrsb r10, [r12, #-3]\n"                                                          \
    "ldrsb r7, [r12, #-2]\n"                                                           \
    "mul r11, r11, r10\n"                                                              \
    "ldrsb r10, [r12, #-1]\n"                                                          \
    "mla r11, lr, r7, r11\n"                                                           \
    "ldrd r7, lr, %[last]\n"                                                           \
    "mla r11, r7, r10, r11\n"                                                          \
    "usat r11, #10, r11, asr #13\n"                                                    \
    "add r11, r11, lr\n"                                                               \
    "usat r11, #8, r11\n"                                                              \
    "sub r11, r11, #2\n"                                                               \
    "orr r8, r8, r11, lsl #24\n"

/* What is rare: 2, 3: another corner is the topmost; 5: another bucket; 7: turned away; 8: no row. */
#define REST                      \
    "cmp r0, r6\n"                \
    "bne 1b\n"                    \
    "b 9f\n"                      \
    "7: bne 0f\n"                 \
    "ldr r7, %[degenerate]\n"     \
    "adds r7, #1\n"               \
    "str r7, %[degenerate]\n"     \
    "0: cmp r0, r6\n"             \
    "bne 1b\n"                    \
    "b 9f\n"                      \
    "2: cmp r12, lr\n"            \
    "bgt 10f\n"                   \
    "cmp r11, lr\n"               \
    "it lt\n"                     \
    "movlt r11, lr\n"             \
    "add lr, r12, #7\n"           \
    "add r12, r11, #7\n"          \
    "ldrb r7, [r0, #-3]\n"        \
    "ldrb r8, [r0, #-2]\n"        \
    "ldrb r10, [r0, #-4]\n"       \
    "b 4b\n"                      \
    "10: mov r12, r11\n"          \
    "3: add lr, lr, #7\n"         \
    "add r12, r12, #7\n"          \
    "ldrb r7, [r0, #-2]\n"        \
    "ldrb r8, [r0, #-4]\n"        \
    "ldrb r10, [r0, #-3]\n"       \
    "b 4b\n"                      \
    "5: udiv r11, r11, lr\n"      \
    "ldr r12, %[buckets]\n"       \
    "mul r9, r11, lr\n"           \
    "add r12, r12, r11, lsl #1\n" \
    "strd r9, lr, %[bucket]\n"    \
    "str r12, %[list]\n"          \
    "b 6b\n"                      \
    "8: ldr r7, %[outside]\n"     \
    "adds r7, #1\n"               \
    "str r7, %[outside]\n"        \
    "b 0b\n"                      \
    "9:\n"

/* The loop; `storing` puts r9 and r8 at r3, which it moves on to the next record. The operands are what else is read. */
#define RUN(shading, storing, ...)                                                                                      \
    register const uint8_t *r0 __asm__("r0") = cluster->faces;                                                          \
    register const int16_t *r1 __asm__("r1") = &cluster->vertices->x;                                                   \
    register const int16_t *r2 __asm__("r2") = &cluster->vertices->y;                                                   \
    register uint8_t *r3 __asm__("r3") = at;                                                                            \
    register uint32_t r4 __asm__("r4") = t->record_count;                                                               \
    register uint32_t r5 __asm__("r5") = 0;                                                                             \
    register const uint8_t *r6 __asm__("r6") = cluster->faces + (size_t)4 * count;                                      \
    __asm__ volatile(AREA TOPMOST RECORD shading storing REST                                                           \
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3), "+r"(r4), "+r"(r5), "+r"(r6), [bucket] "+m"(run.bucket), \
                       [list] "+m"(run.list), [degenerate] "+m"(run.degenerate), [outside] "+m"(run.outside)            \
                     : [base] "m"(run.base), [buckets] "m"(run.buckets), __VA_ARGS__                                    \
                     : "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");                                    \
    face_binned(t, count, r4, run.degenerate, run.outside, r5 &LENGTHS)

TUILE_INLINE face_run_t run_of(const tuile_t *t, const frame_cluster_t *cluster) {
    return (face_run_t){.bucket = {(uint32_t)t->pass_first * t->config.tile_height, t->config.tile_height},
                        .base = {(uint32_t)(cluster->vertices - t->vertices), t->material_base},
                        .list = &t->buckets[t->pass_first],
                        .buckets = t->buckets,
                        .degenerate = 0,
                        .outside = 0};
}

static TUILE_NOINLINE void run_smooth(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    face_run_t run = run_of(t, cluster);
    uint8_t *const at = t->arena_end - (size_t)(t->record_count + 1) * sizeof(record_t);
    RUN("", "strd r9, r8, [r3], #-8\n", "m"(run.base));
}

static TUILE_NOINLINE void run_flat(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    face_run_t run = run_of(t, cluster);
    uint8_t *const at = t->arena_end - (size_t)(t->record_count + 1) * sizeof(record_t);
    const uintptr_t faces = (uintptr_t)cluster->faces;
    const vertex_sun_t sun = vertex_sun(&t->transform);
    const face_sun_t given = {{(uint32_t)sun.x, (uint32_t)sun.y},
                              {(uint32_t)sun.z, (uint32_t)sun.ambient + 2},
                              (const int8_t *)((uintptr_t)cluster->face_normals - (faces - faces / 4))};
    RUN(LIGHT, "strd r9, r8, [r3], #-8\n", [light] "m"(given.light), [last] "m"(given.last), [normals] "m"(given.normals));
}

static TUILE_NOINLINE void run_surface(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    face_run_t run = run_of(t, cluster);
    uint8_t *const at = t->arena_end - (size_t)(t->record_count + 1) * sizeof(record_surface_t);
    const uint32_t source = t->source;
    RUN("",
        "ldr r10, %[source]\n"
        "str r10, [r3, #8]\n"
        "strd r9, r8, [r3], #-12\n",
        [source] "m"(source));
}

bool face_thumb(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    return face_thumb_by(t, cluster, count, run_flat, run_smooth, run_surface);
}

#endif
