/* Models with a second key frame, made from compiled ones by hand. */
#ifndef TESTS_SUPPORT_MORPH_H
#define TESTS_SUPPORT_MORPH_H

#include "models.h"

/* What a vertex becomes in the second key frame: position in steps, and the normals of vertices or faces. */
typedef void (*morph_position_fn)(const tuile_model_t *model, const int16_t from[3], int16_t to[3]);
typedef void (*morph_normal_fn)(const int8_t from[3], int8_t to[3]);

/* A copy with a second key frame; its clusters are as large as the model and never face away. normal NULL: normals stay. */
void morph_add(model_compiled_t *out, const model_compiled_t *from, morph_position_fn position, morph_normal_fn normal);

/* A copy whose only key frame is what the functions make of the first one, in the same clusters. */
void morph_apply(model_compiled_t *out, const model_compiled_t *from, morph_position_fn position, morph_normal_fn normal);

#endif
