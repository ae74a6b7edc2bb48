/* One button that bounces: short and long presses from looks at its level, however far apart they are. */
#ifndef TUILE_FIRMWARE_BUTTON_H
#define TUILE_FIRMWARE_BUTTON_H

#include <stdbool.h>
#include <stdint.h>

#define BUTTON_BOUNCE_US 20000u /* after a change the level is not looked at for so long */
#define BUTTON_LONG_US 600000u

typedef enum button_event {
    BUTTON_NOTHING = 0,
    BUTTON_SHORT = 1, /* let go before it was long */
    BUTTON_LONG = 2,  /* still held, and told once */
} button_event_t;

/* Begins as {0}. A button that is held down at the first look is told only when it has been let go and pressed again. */
typedef struct button {
    bool looked, down, told, changed; /* told: this press; changed: since_us says when last, and that is not long ago */
    uint32_t since_us;
} button_t;

/* To be called often, with the level and the time, which wraps. */
button_event_t button_look(button_t *button, bool pressed, uint32_t now_us);

#endif
