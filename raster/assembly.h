/* Which loops a build has in assembly. Each has a C twin, which every other build runs and which tells what the result must be:
 * tests/emulators/twins.c compares both. -DTUILE_ASSEMBLY=0 leaves all assembly out.
 *
 * Thumb-2 with a division: Cortex-M3, M4, M7, M33. gcc keeps a frame pointer where it does not optimise, and the loops want all
 * registers. Instructions: ARMv7-M Architecture Reference Manual (DDI 0403), chapter A7.
 */
#ifndef TUILE_ASSEMBLY_H
#define TUILE_ASSEMBLY_H

#ifndef TUILE_ASSEMBLY
#define TUILE_ASSEMBLY 1
#endif

/* Could it be? What is laid out goes by this, so that twins agree about it. */
#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && defined(__thumb2__) && defined(__ARM_FEATURE_IDIV) && \
    defined(__ARM_FEATURE_UNALIGNED) && defined(__ARMEL__)
#define ASSEMBLY_THUMB_COULD 1
#else
#define ASSEMBLY_THUMB_COULD 0
#endif

#define ASSEMBLY_THUMB (TUILE_ASSEMBLY && ASSEMBLY_THUMB_COULD)

#endif
