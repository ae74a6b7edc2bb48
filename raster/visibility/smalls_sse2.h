/* smalls_draw of rows.h for textured faces with light at their corners, on x86-64: in C with SSE2. Both give the same bits. */
#ifndef TUILE_VISIBILITY_SMALLS_SSE2_H
#define TUILE_VISIBILITY_SMALLS_SSE2_H

#include "rows.h"

void smalls_textured_sse2(tuile_t *t, walk_t *walk, uint32_t limit);

#endif
