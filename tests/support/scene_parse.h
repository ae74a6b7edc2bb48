/* Text scenes as they are read, before anything is compiled or drawn. */
#ifndef TESTS_SUPPORT_SCENE_PARSE_H
#define TESTS_SUPPORT_SCENE_PARSE_H

#include "../../sim/scene_text.h"

/* Fails the test when the text is refused. To be released with scene_text_free. */
scene_text_t scene_parse(const char *text);

double scene_number_value(scene_number_t number);

#endif
