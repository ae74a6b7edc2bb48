/* Included first by the files of the hot paths. gcc's -O2 does three things that loops as short as those of small faces pay for: it
 * computes the final values of loop variables behind the loop with multiplications, packs stores of edge states into vectors, and
 * keeps common subexpressions alive in registers that the span loop needs. In the source rather than in a makefile, so that
 * whoever builds raster/ gets it; it changes no result. (Reference scene: 2.75 -> 2.55 M instructions, DESIGN.md.)
 */
#ifndef TUILE_TUNE_H
#define TUILE_TUNE_H

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-tree-scev-cprop", "no-tree-slp-vectorize", "no-tree-pre")
#endif

#endif
