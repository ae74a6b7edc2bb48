/* The commands of `tuile`, each a main of its own: arguments without the command's name, exit code back. */
#ifndef SIM_COMMANDS_H
#define SIM_COMMANDS_H

enum { EXIT_USAGE = 2 };

int command_render(int count, char **arguments);
int command_panels(int count, char **arguments);
int command_mcus(int count, char **arguments);
int command_displays(int count, char **arguments);
int command_card(int count, char **arguments);
int command_scene(int count, char **arguments);
int command_mesh(int count, char **arguments);
int command_font(int count, char **arguments);
int command_faces(int count, char **arguments);
int command_coverage(int count, char **arguments);

/* "tuile: text" and a newline on stderr; returns the exit code 1. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
int command_fail(const char *format, ...);

/* A bar on stderr, when that is a terminal; done = of ends it. */
void command_progress(unsigned done, unsigned of);

/* Flushes stdout; a full disk or closed pipe is an error like any other. Returns the exit code. */
int command_finish(void);

#endif
