#include "scene_parse.h"

#include "check.h"

scene_text_t scene_parse(const char *text) {
    scene_text_t scene;
    sim_error_t error = {""};
    if (scene_text_parse(&scene, text, strlen(text), "scene", &error) < 0) { fail_msg("%s\n%s", error.text, text); }
    return scene;
}

double scene_number_value(scene_number_t number) { return (double)number.numerator / (double)number.denominator; }
