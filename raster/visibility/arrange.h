/* The order of rigid objects among themselves, for the display tree: each knows its own faces, none knows the others. */
#ifndef TUILE_VISIBILITY_ARRANGE_H
#define TUILE_VISIBILITY_ARRANGE_H

#include "../frame/frame.h"

#define ARRANGE_FIRST 0x8000u /* in t->instance_order: the first instance of its group */

/* Fills t->instance_order with all instances of the scene, from back to front, in groups: no plane was found that parts the members
 * of a group of more than one, or they overlap in a circle. Members come in ascending order. scratch: n * n + 4 n bytes for n
 * instances, n > 1. Returns the number of instances in groups of more than one, or TUILE_ERROR_MEMORY and t->wanted_bytes. */
int arrange_instances(tuile_t *t, uint8_t *scratch, size_t size_bytes);

#endif
