/* The one place that knows how a colour looks on the wire. */
#include "frame.h"

void resolve_tile(const tuile_t *t) { (void)t; }
