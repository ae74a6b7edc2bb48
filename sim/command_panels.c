/* tuile panels: the panels that --panel and --display know. */
#include "commands.h"
#include "panels.h"
#include "render_format.h"

#include <stdio.h>
#include <string.h>

static void print_panel(const sim_panel_t *module) {
    const tuile_panel_t *panel = module->panel;
    char formats[128] = "", size[24];
    for (unsigned i = 0; i < panel->format_count; i++) {
        const size_t used = strlen(formats);
        (void)snprintf(formats + used, sizeof formats - used, "%s%s", i ? ", " : "",
                       render_format_name((uint8_t)(panel->formats[i].wire - 1)));
    }
    (void)snprintf(size, sizeof size, "%ux%u%s", panel->view_width, panel->view_height, panel->round ? " round" : "");
    (void)printf("%-22s %-8s %-14s %5.1f %5.1f  %s\n", panel->name, module->chip, size, panel->rated_pixel_clock_hz / 1e6,
                 panel->pixel_clock_hz / 1e6, formats);
}

int command_panels(int count, char **arguments) {
    if (count == 1 && strcmp(arguments[0], "--help") == 0) {
        (void)printf(
            "Usage: tuile panels\n\n"
            "Lists the panels: name, chip, size in pixels, clock for pixels in MHz as rated by the data sheet and as usual,\n"
            "formats on the wire, the default first.\n");
        return command_finish();
    }
    if (count > 0) {
        (void)command_fail("panels: takes no arguments, but got %s", arguments[0]);
        return EXIT_USAGE;
    }
    (void)printf("%-22s %-8s %-14s %11s  %s\n", "name", "chip", "size", "rated usual", "formats");
    for (size_t i = 0; i < sim_panel_count; i++) {
        print_panel(&sim_panels[i]);
    }
    return command_finish();
}
