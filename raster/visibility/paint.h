/* Painting: faces over one another, without depth. For methods that know the order (painter, tree) or the place (Warnock). */
#ifndef TUILE_VISIBILITY_PAINT_H
#define TUILE_VISIBILITY_PAINT_H

#include "../frame/frame.h"

/* All records of tile row `row` into the tile, in the order of their numbers: the last one is seen. */
int paint_draw_tile(tuile_t *t, uint16_t row);

/* One record, in an immediate pass. */
void paint_draw_now(tuile_t *t, uint32_t number);

/* What of a record's face lies in pixels left ... right - 1, top ... bottom - 1 of the window, all inside the tile. */
void paint_rectangle(tuile_t *t, uint32_t number, int32_t left, int32_t top, int32_t right, int32_t bottom);

#endif
