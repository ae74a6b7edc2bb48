/* Ctrl-C and its kin, for commands that must not leave a display lit or a device taken. */
#ifndef SIM_INTERRUPT_H
#define SIM_INTERRUPT_H

#include <stdbool.h>

/* Forgets what was seen before. From now on SIGINT, SIGTERM and SIGHUP are only remembered. A second one ends the program at once. */
void interrupt_catch(void);

/* The first of them since then, or 0. */
int interrupt_seen(void);

/* The exit code for it, as shells tell: 128 + its number. */
int interrupt_code(void);

#endif
