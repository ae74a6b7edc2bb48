/* tuile: the simulator and its tools. */
#include "commands.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>

static const char usage[] =
    "Usage: tuile COMMAND ...\n"
    "\n"
    "  tuile render MODEL [options]       draw a model on a display, or on a simulated panel as pictures\n"
    "  tuile panels                       the panels that there are\n"
    "  tuile mcus                         the microcontrollers whose pace can be predicted\n"
    "  tuile displays                     what is attached, and why it cannot be used if so\n"
    "  tuile card [options]               a test card: which way is up, the order of the colours, the border\n"
    "  tuile scene [NAME] [options]       a scene of the list that boards draw\n"
    "  tuile mesh IN -o OUT.c|OUT.tuile   compile a model for flash\n"
    "  tuile font FONT.bdf -o OUT.c        compile a bitmap font for flash\n"
    "  tuile faces SCENE                  the visible face of each pixel of a text scene\n"
    "  tuile coverage W H < FILE          the pixels of polygons given in 1/16 pixel\n"
    "\n"
    "  tuile COMMAND --help               the options of a command\n";

int main(int count, char **arguments) {
    static const struct {
        const char *name;
        int (*run)(int count, char **arguments);
    } commands[] = {
        {"render", command_render},     {"panels", command_panels}, {"displays", command_displays}, {"card", command_card},
        {"scene", command_scene},       {"mesh", command_mesh},     {"font", command_font},         {"faces", command_faces},
        {"coverage", command_coverage}, {"mcus", command_mcus},
    };
    (void)signal(SIGPIPE, SIG_IGN); /* a closed pipe is reported as a write error */
    if (count < 2) {
        (void)fputs(usage, stderr);
        return EXIT_USAGE;
    }
    if (strcmp(arguments[1], "--help") == 0 || strcmp(arguments[1], "-h") == 0 || strcmp(arguments[1], "help") == 0) {
        (void)fputs(usage, stdout);
        return command_finish();
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (strcmp(arguments[1], commands[i].name) == 0) { return commands[i].run(count - 2, arguments + 2); }
    }
    (void)command_fail("unknown command '%s'; `tuile --help` lists them", arguments[1]);
    return EXIT_USAGE;
}
