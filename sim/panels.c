#include "panels.h"

#include "../hal/panels/ili9341.h"
#include "chips/ili9341.h"

#include <string.h>

const sim_panel_t sim_panels[] = {
    {&tuile_ili9341, "ILI9341", sim_ili9341_create},
};

const size_t sim_panel_count = sizeof sim_panels / sizeof sim_panels[0];

const sim_panel_t *sim_panel_find(const char *name) {
    for (size_t i = 0; i < sim_panel_count; i++) {
        if (strcmp(sim_panels[i].panel->name, name) == 0) { return &sim_panels[i]; }
    }
    return NULL;
}
