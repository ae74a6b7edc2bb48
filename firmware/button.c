#include "button.h"

/* A change counts at once, so that a press is seen even if looks are as far apart as it is long; what bounces behind it does not.
 */
button_event_t button_look(button_t *button, bool pressed, uint32_t now_us) {
    const uint32_t passed_us = now_us - button->since_us;

    if (!button->looked) { *button = (button_t){.looked = true, .down = pressed, .told = pressed}; }
    if (button->changed && passed_us < BUTTON_BOUNCE_US) { return BUTTON_NOTHING; }
    if (pressed != button->down) {
        const bool is_short = button->down && !button->told;

        *button = (button_t){.looked = true, .down = pressed, .changed = true, .since_us = now_us};
        return is_short ? BUTTON_SHORT : BUTTON_NOTHING;
    }
    if (button->down && !button->told && passed_us >= BUTTON_LONG_US) {
        button->told = true;
        return BUTTON_LONG;
    }
    if (!button->down) { button->changed = false; } /* else, once time has wrapped, it would seem to have been just now */
    return BUTTON_NOTHING;
}
