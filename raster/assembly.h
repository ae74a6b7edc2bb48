/* Which loops a build has in assembly, or in C for one set of instructions. Each has its C twin, which every other build runs and
 * which tells what the result must be: tests/emulators/twins.c compares both. -DTUILE_ASSEMBLY=0 leaves all assembly out.
 *
 * Two sets of instructions, each in files of its own, behind the same functions:
 *     Thumb-2 with a division, NAME_thumb.c: Cortex-M3, M4, M7, M33 (ARMv7-M Architecture Reference Manual, DDI 0403, chapter A7);
 *     Thumb-1, NAME_thumb1.c: Cortex-M0, M0+ (ARMv6-M Architecture Reference Manual, DDI 0419, chapter A6): eight registers for
 *     arithmetic, products of 32 bits, no division.
 * And one in C that names instructions: SSE2, NAME_sse2.c: x86-64, all of which have it.
 * gcc keeps a frame pointer where it does not optimise, and the loops want all registers.
 */
#ifndef TUILE_ASSEMBLY_H
#define TUILE_ASSEMBLY_H

#ifndef TUILE_ASSEMBLY
#define TUILE_ASSEMBLY 1
#endif

/* Could it be? What is laid out goes by this, so that twins agree about it. */
#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && defined(__thumb2__) && defined(__ARM_FEATURE_IDIV) && \
    defined(__ARM_FEATURE_UNALIGNED) && defined(__ARMEL__)
#define ASSEMBLY_THUMB2_COULD 1
#else
#define ASSEMBLY_THUMB2_COULD 0
#endif
#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && defined(__ARM_ARCH_6M__) && defined(__ARMEL__)
#define ASSEMBLY_THUMB1_COULD 1
#else
#define ASSEMBLY_THUMB1_COULD 0
#endif

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__SSE2__)
#define ASSEMBLY_SSE2_COULD 1
#else
#define ASSEMBLY_SSE2_COULD 0
#endif

#define ASSEMBLY_SSE2 (TUILE_ASSEMBLY && ASSEMBLY_SSE2_COULD)
#define ASSEMBLY_THUMB2 (TUILE_ASSEMBLY && ASSEMBLY_THUMB2_COULD)
#define ASSEMBLY_THUMB1 (TUILE_ASSEMBLY && ASSEMBLY_THUMB1_COULD)

/* Of a function that is all assembly. At a word, since adr counts from words: with -Os gcc sets functions at half words. */
#define ASSEMBLY_FUNCTION __attribute__((naked, noipa, aligned(4)))

/* By loop. */
#define ASSEMBLY_VERTICES (ASSEMBLY_THUMB2 || ASSEMBLY_THUMB1)
#define ASSEMBLY_FACES (ASSEMBLY_THUMB2 || ASSEMBLY_THUMB1)
#define ASSEMBLY_SMALL (ASSEMBLY_THUMB2 || ASSEMBLY_THUMB1)
#define ASSEMBLY_TEXTURED (ASSEMBLY_THUMB2 || ASSEMBLY_THUMB1)

#endif
