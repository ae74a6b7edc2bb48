/* The loop of face_plain.c: 27 instructions for a face that is turned away, 68 or 74 for one that is kept, 57 on the average of a
 * model, where gcc 12 takes 90. Corners are read again where the topmost has been found, in the order that they have from there on.
 * The head of a bucket is the last record as long as faces go into one: it is read and written only when they change to another.
 */
#include "../tune.h"

#include "face_thumb.h"

#include <stddef.h>

#include "../assembly.h"

#if ASSEMBLY_THUMB1

/* What does not fit in registers: it lies on the stack. */
typedef struct face_run {
    uint8_t *record; /* behind the next one */
    uint32_t number; /* records */
    uint32_t before; /* how many there were */
    uint32_t bucket; /* where it begins, 1/16 pixel: of the face before; 1 << 30: there is none */
    int32_t begin;   /* the same, but for the first face */
    uint16_t *list;  /* of that bucket */
    uint32_t degenerate, outside, large;
    /* Flat shading; surfaces. */
    const int8_t *normals; /* where those of faces at address 0 were */
    vertex_sun_t sun;
    uint32_t source;
} face_run_t;

_Static_assert(offsetof(vertex_t, x) == 0 && offsetof(vertex_t, y) == 2 && sizeof(vertex_t) == 8, "vertices in the assembly");
_Static_assert(offsetof(record_t, next) == 0 && offsetof(record_t, v0) == 2 && offsetof(record_t, d1) == 4 &&
                   offsetof(record_t, d2) == 5 && offsetof(record_t, material) == 6 && offsetof(record_t, light) == 7 &&
                   sizeof(record_t) == 8 && offsetof(record_surface_t, source) == 8 && sizeof(record_surface_t) == 12,
               "records in the assembly");
_Static_assert(SHORT_SIDE == 512 && LIGHT_MAX == 253, "numbers in the assembly");

/* clang-format off */

/* r0 the face; r1 vertices. High registers: r9 half of SHORT_SIDE; r10 slot of the cluster's first vertex; r11 rows of a tile,
 * 1/16 pixel; r12 end of the faces; lr material. */

/* r2 y of the first corner; r3, r4 how far the others are below it; r5, r6 how far to the right, in the lower half. */
#define AREA \
    "1: ldrb r2, [r0]\n" \
    "lsls r2, r2, #3\n" \
    "ldr r2, [r1, r2]\n" \
    "ldrb r3, [r0, #1]\n" \
    "lsls r3, r3, #3\n" \
    "ldr r3, [r1, r3]\n" \
    "ldrb r4, [r0, #2]\n" \
    "lsls r4, r4, #3\n" \
    "ldr r4, [r1, r4]\n" \
    "subs r5, r3, r2\n" \
    "subs r6, r4, r2\n" \
    "asrs r2, r2, #16\n" \
    "asrs r3, r3, #16\n" \
    "asrs r4, r4, #16\n" \
    "subs r3, r2\n" \
    "subs r4, r2\n" \
    "sxth r7, r6\n" \
    "muls r7, r3, r7\n" \
    "mov r8, r7\n" \
    "sxth r7, r5\n" \
    "muls r7, r4, r7\n" \
    "cmp r8, r7\n" \
    "ble 7f\n"

/* r4, r6, r7: the corners from the topmost on; r2 its y, with 7 added, r3 the height; r5 what the lengths of sides have in their bits. */
#define TOPMOST \
    "add r5, r9\n" \
    "add r6, r9\n" \
    "orrs r5, r6\n" \
    "movs r7, r3\n" \
    "orrs r7, r4\n" \
    "bmi 2f\n" \
    "cmp r3, r4\n" \
    "bge 10f\n" \
    "movs r3, r4\n" \
    "10: ldrb r4, [r0]\n" \
    "ldrb r6, [r0, #1]\n" \
    "ldrb r7, [r0, #2]\n" \
    "4: adds r2, #7\n" \
    "orrs r5, r3\n" \
    "adds r3, r2\n" \
    "eors r3, r2\n" \
    "lsrs r3, r3, #4\n" \
    "beq 8f\n" \
    "lsls r5, r5, #16\n" \
    "lsrs r5, r5, #25\n" \
    "bne 9f\n"

/* r3: the record; r5: its number. */
#define RECORD(bytes) \
    "11: ldr r3, %[bucket]\n" \
    "subs r3, r2, r3\n" \
    "cmp r3, r11\n" \
    "bhs 5f\n" \
    "ldr r3, %[record]\n" \
    "subs r3, " bytes "\n" \
    "ldr r5, %[number]\n" \
    "strh r5, [r3]\n" \
    "6: str r3, %[record]\n" \
    "adds r5, #1\n" \
    "str r5, %[number]\n" \
    "subs r6, r4\n" \
    "strb r6, [r3, #4]\n" \
    "subs r7, r4\n" \
    "strb r7, [r3, #5]\n" \
    "add r4, r10\n" \
    "strh r4, [r3, #2]\n" \
    "ldrb r4, [r0, #3]\n" \
    "add r4, lr\n"

/* 2: another corner is the topmost; 5: another bucket; 7: turned away; 8: no row; 9: a large face. */
#define REST(bytes) \
    "0: adds r0, #4\n" \
    "cmp r0, r12\n" \
    "bne 1b\n" \
    "b 14f\n" \
    "7: beq 12f\n" \
    "adds r0, #4\n" \
    "cmp r0, r12\n" \
    "bne 1b\n" \
    "b 14f\n" \
    "12: ldr r7, %[degenerate]\n" \
    "adds r7, #1\n" \
    "str r7, %[degenerate]\n" \
    "b 0b\n" \
    "8: ldr r7, %[outside]\n" \
    "adds r7, #1\n" \
    "str r7, %[outside]\n" \
    "b 0b\n" \
    "9: str r5, %[large]\n" \
    "b 11b\n" \
    "2: cmp r3, r4\n" \
    "bgt 3f\n" \
    "adds r2, r3\n" \
    "negs r3, r3\n" \
    "adds r4, r3\n" \
    "cmp r3, r4\n" \
    "bge 13f\n" \
    "movs r3, r4\n" \
    "13: ldrb r4, [r0, #1]\n" \
    "ldrb r6, [r0, #2]\n" \
    "ldrb r7, [r0]\n" \
    "b 4b\n" \
    "3: adds r2, r4\n" \
    "negs r4, r4\n" \
    "adds r3, r4\n" \
    "cmp r3, r4\n" \
    "bge 13f\n" \
    "movs r3, r4\n" \
    "13: ldrb r4, [r0, #2]\n" \
    "ldrb r6, [r0]\n" \
    "ldrb r7, [r0, #1]\n" \
    "b 4b\n" \
    "5: ldr r5, %[list]\n" \
    "mov r8, r4\n" \
    "ldr r4, %[number]\n" \
    "ldr r3, %[before]\n" \
    "cmp r3, r4\n" \
    "beq 13f\n" \
    "strh r4, [r5]\n" \
    "13: ldr r3, %[begin]\n" \
    "mov r4, r11\n" \
    "b 16f\n" \
    "15: adds r3, r4\n" \
    "adds r5, #2\n" \
    "16: cmp r2, r3\n" \
    "bge 15b\n" \
    "17: subs r3, r4\n" \
    "subs r5, #2\n" \
    "cmp r2, r3\n" \
    "blt 17b\n" \
    "str r3, %[begin]\n" \
    "str r3, %[bucket]\n" \
    "str r5, %[list]\n" \
    "ldrh r5, [r5]\n" \
    "ldr r3, %[record]\n" \
    "subs r3, " bytes "\n" \
    "strh r5, [r3]\n" \
    "ldr r5, %[number]\n" \
    "mov r4, r8\n" \
    "b 6b\n" \
    "14:\n"

/* The loop; `last` puts what is left into the record at r3, from the material r4 on, and a light; `bytes` long, "#8". The operands
 * are what else is read. */
#define RUN(bytes, last, ...) \
    register const uint8_t *r0 __asm__("r0") = cluster->faces; \
    register const vertex_t *r1 __asm__("r1") = cluster->vertices; \
    register uint32_t r9 __asm__("r9") = SHORT_SIDE / 2; \
    register uint32_t r10 __asm__("r10") = (uint32_t)(cluster->vertices - t->vertices); \
    register uint32_t r11 __asm__("r11") = t->config.tile_height * 16u; \
    register const uint8_t *r12 __asm__("r12") = cluster->faces + (size_t)4 * count; \
    register uint32_t lr __asm__("lr") = t->material_base; \
    __asm__ volatile(".syntax unified\n" AREA TOPMOST RECORD(bytes) last REST(bytes) \
                     : "+r"(r0), [number] "+m"(run.number), [list] "+m"(run.list), \
                       [degenerate] "+m"(run.degenerate), [outside] "+m"(run.outside), [large] "+m"(run.large) \
                     : "r"(r1), "r"(r9), "r"(r10), "r"(r11), "r"(r12), "r"(lr), [record] "m"(run.record), [before] "m"(run.before), [bucket] "m"(run.bucket), \
                       [begin] "m"(run.begin), __VA_ARGS__ \
                     : "r2", "r3", "r4", "r5", "r6", "r7", "r8", "cc", "memory"); \
    run_end(t, &run, count)

/* clang-format on */

/* Not all of it, which the compiler would clear by a function. */
TUILE_INLINE void run_begin(face_run_t *run, const tuile_t *t) {
    const uint32_t number = t->record_count;
    run->record = t->arena_end - (size_t)number * t->record_bytes;
    run->number = run->before = number;
    run->bucket = UINT32_C(1) << 30;
    run->begin = t->pass_first * t->config.tile_height * 16;
    run->list = &t->buckets[t->pass_first];
    run->degenerate = run->outside = run->large = 0;
}

TUILE_INLINE void run_end(tuile_t *t, const face_run_t *run, unsigned count) {
    if (run->number != run->before) { *run->list = (uint16_t)run->number; }
    face_binned(t, count, run->number, run->degenerate, run->outside, run->large ? SHORT_SIDE : 0);
}

static TUILE_NOINLINE void run_smooth(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    face_run_t run;
    run_begin(&run, t);
    RUN("#8",
        "uxtb r4, r4\n"
        "strh r4, [r3, #6]\n",
        "m"(run.number));
}

static TUILE_NOINLINE void run_surface(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    face_run_t run;
    run_begin(&run, t);
    run.source = t->source;
    RUN("#12",
        "uxtb r4, r4\n"
        "strh r4, [r3, #6]\n"
        "ldr r5, %[source]\n"
        "str r5, [r3, #8]\n",
        [source] "m"(run.source));
}

/* Three bytes of a normal for four of a face. */
static TUILE_NOINLINE void run_flat(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    face_run_t run;
    run_begin(&run, t);
    const uintptr_t faces = (uintptr_t)cluster->faces;
    run.normals = (const int8_t *)((uintptr_t)cluster->face_normals - (faces - faces / 4));
    run.sun = vertex_sun(&t->transform);
    RUN("#8",
        "strb r4, [r3, #6]\n"
        "ldr r2, %[normals]\n"
        "lsrs r4, r0, #2\n"
        "subs r4, r0, r4\n"
        "ldrsb r5, [r2, r4]\n"
        "ldr r6, %[x]\n"
        "muls r6, r5, r6\n"
        "adds r4, #1\n"
        "ldrsb r5, [r2, r4]\n"
        "ldr r7, %[y]\n"
        "muls r7, r5, r7\n"
        "adds r6, r7\n"
        "adds r4, #1\n"
        "ldrsb r5, [r2, r4]\n"
        "ldr r7, %[z]\n"
        "muls r7, r5, r7\n"
        "adds r6, r7\n"
        "ldr r5, %[ambient]\n"
        "asrs r6, r6, #13\n"
        "bmi 18f\n"
        "adds r5, r6\n"
        "cmp r5, #253\n"
        "bls 18f\n"
        "movs r5, #253\n"
        "18: strb r5, [r3, #7]\n",
        [normals] "m"(run.normals), [x] "m"(run.sun.x), [y] "m"(run.sun.y), [z] "m"(run.sun.z), [ambient] "m"(run.sun.ambient));
}

bool face_thumb(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    return face_thumb_by(t, cluster, count, run_flat, run_smooth, run_surface);
}

#endif
