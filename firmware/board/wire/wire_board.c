/* What boards have in common that have no panel and no button, and stand in an emulator: the wire goes to a file (wire_file.h), and
 * all that is told, asked and ended goes through semihosting. */
#include "../board.h"
#include "../models.h"
#include "../semihosting.h"
#include "../wire_file.h"

const void *board_model(const scene_script_t *script, size_t *size_bytes) { return models_find(script, size_bytes); }

bool board_button(void) { return false; }

void board_tell(const char *line) {
    if (wire_file_tell(line)) { board_park(BOARD_FAILED); }
}

void board_shown(void) {} /* the file is looked at when all is over */

void board_options(char *text, size_t size_bytes) { semihosting_options(text, size_bytes); }

void board_park(board_code_t code) { semihosting_exit(code); }
