#include "interrupt.h"

#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t seen;

static void remember(int number) { seen = number; }

void interrupt_catch(void) {
    seen = 0;
    /* RESETHAND: the second has the system's own effect. No RESTART: a pause ends at once. */
    struct sigaction action = {.sa_handler = remember, .sa_flags = (int)SA_RESETHAND};
    (void)sigemptyset(&action.sa_mask);
    (void)sigaction(SIGINT, &action, NULL);
    (void)sigaction(SIGTERM, &action, NULL);
    (void)sigaction(SIGHUP, &action, NULL);
}

int interrupt_seen(void) { return seen; }

int interrupt_code(void) { return 128 + seen; }
