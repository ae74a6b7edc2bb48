/* The order of the painter's algorithm, for the method of that name and for whoever has faces that nothing else puts in order. */
#ifndef TUILE_VISIBILITY_PAINTER_H
#define TUILE_VISIBILITY_PAINTER_H

#include "../frame/frame.h"

/* What painter_order must find between vertices and records. */
size_t painter_room_bytes(uint32_t records);

/* Puts records first ... end - 1 into the order in which they are to be painted, farthest first. Faces that cross or hide one
 * another in a cycle are cut: record_count grows by as many pieces, `end` by as many, and the records behind move up. Buckets must
 * be filled again (bin_again) afterwards. FRAME_FULL when there is no room, or a negative error. */
int painter_order(tuile_t *t, uint32_t first, uint32_t end);

#endif
