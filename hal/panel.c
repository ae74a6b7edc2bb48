#include "panel.h"

tuile_panel_view_t tuile_panel_view(const tuile_panel_t *panel, unsigned rotation) {
    unsigned mode = panel->rotation[rotation & 3u];
    unsigned x = panel->offset_x, y = panel->offset_y;
    uint8_t align_x = panel->align_x ? panel->align_x : 1, align_y = panel->align_y ? panel->align_y : 1;

    if (mode & TUILE_MADCTL_MX) { x = (unsigned)panel->ram_width - panel->view_width - panel->offset_x; }
    if (mode & TUILE_MADCTL_MY) { y = (unsigned)panel->ram_height - panel->view_height - panel->offset_y; }
    if (mode & TUILE_MADCTL_MV) {
        return (tuile_panel_view_t){(uint16_t)y, (uint16_t)x, panel->view_height, panel->view_width, align_y, align_x};
    }
    return (tuile_panel_view_t){(uint16_t)x, (uint16_t)y, panel->view_width, panel->view_height, align_x, align_y};
}
