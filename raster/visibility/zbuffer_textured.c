#include "../tune.h"
#if defined(__GNUC__) && !defined(__clang__)
/* 2 % fewer on Cortex-M: what is used in loops over rows and pixels stays in registers. no-tree-sink: 0.7 % on M0+. */
#pragma GCC optimize("no-ivopts", "no-tree-sink")
#if defined(__x86_64__)
#pragma GCC optimize("no-gcse", "ira-region=one") /* 1 % fewer here, 1 % more there */
#endif
#endif

#include "zbuffer_textured.h"

#include "../assembly.h"
#include "smalls_sse2.h"
#include "smalls_textured.h"

void smalls_textured(tuile_t *t, walk_t *walk, uint32_t limit) {
    if (ASSEMBLY_TEXTURED && t->config.shade == TUILE_GOURAUD) {
        smalls_textured_thumb(t, walk, limit);
    } else if (ASSEMBLY_SSE2 && t->config.shade == TUILE_GOURAUD) {
        smalls_textured_sse2(t, walk, limit);
    } else {
        smalls_draw(t, walk, limit, SMALL_TEXTURED);
    }
}

int zbuffer_textured_tile(tuile_t *t, uint16_t row) {
    rows_draw_tile(t, row, ROWS_TEXTURED);
    return FRAME_OK;
}

void zbuffer_textured_now(tuile_t *t, uint32_t number) {
    t->textured_source = UINT16_MAX; /* slots are used again */
    rows_draw_now(t, number, ROWS_TEXTURED);
}
