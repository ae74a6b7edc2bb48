/* Traffic for a simulated panel, written as text. */
#ifndef TESTS_SUPPORT_WIRE_SCRIPT_H
#define TESTS_SUPPORT_WIRE_SCRIPT_H

#include "board.h"

/* "2A:00 00" is a command with parameters (D/C high), "+12 34" data, "@5" a pause of 5 ms, "R0" and "R1" the reset line; all but
 * the first have a semicolon before them. Plays up to the first error, and returns it. The bus has to be a blocking one. */
int wire_play(board_t *board, const char *script);

#endif
