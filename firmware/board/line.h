/* Lines of text for board_tell, put together from words and numbers. */
#ifndef TUILE_FIRMWARE_LINE_H
#define TUILE_FIRMWARE_LINE_H

#include <stddef.h>
#include <stdint.h>

typedef struct line {
    char text[96]; /* what does not fit is cut off */
    uint8_t used;
} line_t;

/* Each puts a space before what it appends, unless the line is empty. */
void line_word(line_t *line, const char *word);
void line_number(line_t *line, uint32_t number);

/* The value of name in "name=value name=value", up to the next space; NULL when it is not there. */
const char *line_option(const char *options, const char *name);

/* The number that text begins with; `usual` for NULL. */
uint32_t line_value(const char *text, uint32_t usual);

#endif
