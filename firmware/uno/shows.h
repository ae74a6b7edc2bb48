/* What the Uno can show, for its programs: a turning cube and a small room, by z-buffer and by display tree, on an SSD1306 of 128
 * x 64.
 *
 * The views of the frames stand in flash beside the models (raster/compact/compact.h). Between a picture and the next one the
 * display keeps what it shows, so no frame buffer is needed: a tile is drawn, sent and forgotten. */
#ifndef FIRMWARE_UNO_SHOWS_H
#define FIRMWARE_UNO_SHOWS_H

#include "../../raster/compact/compact.h"
#include "tell.h"

/* An event, to whoever listens. */
void uno_tell(uno_event_t event, uint8_t a, uint8_t b);

/* The end, which is told with a code. */
_Noreturn void uno_park(uint8_t code);

/* Each parks with the code 1 when the display or the renderer reports an error. uno_open comes first. */
void uno_open(void);
void uno_choose(uint8_t number);

/* Draws frame 0 ... UNO_FRAMES - 1 of the chosen show and sends it. `over`, which may be NULL, may change a tile before it is sent.
 */
void uno_frame(uint8_t number, uint8_t frame, void (*over)(const tuile_tile_t *tile));

#endif
