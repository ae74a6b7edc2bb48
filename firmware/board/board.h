/* What a board gives to the programs of this folder. Each function is the board's own, in firmware/BOARD/. */
#ifndef TUILE_FIRMWARE_BOARD_H
#define TUILE_FIRMWARE_BOARD_H

#include "../../hal/display.h"
#include "../scenes.h"

/* How a program ended: the code that an emulator's harness or a debugger finds. */
typedef enum board_code {
    BOARD_DONE = 0,
    BOARD_FAILED = 1, /* the renderer, the display or a scene reported an error; the last line told says which */
    BOARD_HARD_FAULT = 64,
    BOARD_STACK_GUARD = 65, /* the stack has grown into the words below the room that it has */
    BOARD_ASSERT = 66,
} board_code_t;

#define BOARD_CHECK(condition) ((condition) ? (void)0 : board_park(BOARD_ASSERT))

/* The panel and its bus, which is open; for tuile_display_init. They last as long as the program. */
const tuile_display_config_t *board_display(void);

/* The renderer's memory, 8-byte aligned. */
void *board_block(size_t *size_bytes);

/* The compiled model of a script of the list. */
const void *board_model(const scene_script_t *script, size_t *size_bytes);

/* A line to whoever listens, without its end. */
void board_tell(const char *line);

/* A frame has been shown and told: returns when whoever listens has looked at it. */
void board_shown(void);

/* What the program was started with, "name=value name=value", "" without: at most size_bytes with the zero behind it. */
void board_options(char *text, size_t size_bytes);

/* Microseconds, once board_display has been called; it wraps. Called every five minutes at least, it misses none. */
uint32_t board_clock_us(void);

/* Is the button pressed? It bounces (firmware/button.h). Never, where there is none. */
bool board_button(void);

/* Bytes of stack used at most since the start, and the room that there is. Both 0 where nobody has painted it. Parks with
 * BOARD_STACK_GUARD when the guard is gone. */
size_t board_stack_used(void);
size_t board_stack_room(void);

/* On purpose, to see that it is reported: BOARD_HARD_FAULT or BOARD_STACK_GUARD. Does not return if that works. */
void board_break(board_code_t code);

/* The end: stops here, with the code where it can be found. */
_Noreturn void board_park(board_code_t code);

#endif
