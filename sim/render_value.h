/* Values of tuile render's options that need more than a number. False and a message when they are wrong. */
#ifndef SIM_RENDER_VALUE_H
#define SIM_RENDER_VALUE_H

#include "options.h"

/* A text of six hexadecimal digits, RRGGBB; false, without a message, for any other. */
bool render_value_colour(const char *text, uint8_t colour[3]);
/* The same where more may follow that is no such digit; *text moves behind the six. */
bool render_value_next_colour(const char **text, uint8_t colour[3]);

/* RRGGBB */
bool render_value_background(options_t *options, uint8_t background[3]);

/* "single,box": tuile_warnock_t, or-ed. */
bool render_value_warnock(options_t *options, uint8_t *variants);

/* Hz in a text, "62.5M" or "500k", at most 1000M, rounded down; false, without a message, for any other. */
bool render_value_hz(const char *text, size_t *hz);
/* The same as an option's value; 0 is allowed. */
bool render_value_clock(options_t *options, size_t *hz);

/* An output name may hold one %d, with a width; without it all frames would have the same name. */
bool render_value_pattern(const char *option, const char *name, long frames);

/* Such a name, with the frame's number. */
void render_value_frame_name(char *name, size_t size, const char *pattern, unsigned frame);

#endif
