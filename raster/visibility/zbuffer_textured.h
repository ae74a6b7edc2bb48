/* The z-buffer where faces are drawn with their texture at once, as far as they may be: the others are drawn as numbers. */
#ifndef TUILE_VISIBILITY_ZBUFFER_TEXTURED_H
#define TUILE_VISIBILITY_ZBUFFER_TEXTURED_H

#include "rows.h"

int zbuffer_textured_tile(tuile_t *t, uint16_t row);
void zbuffer_textured_now(tuile_t *t, uint32_t number);

#endif
