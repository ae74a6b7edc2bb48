/* SSD0323, and SSD1325, which takes the same commands: 128 x 64 of 128 x 80, 16 greys, 4-wire serial interface. */
#ifndef TUILE_HAL_PANELS_SSD0323_H
#define TUILE_HAL_PANELS_SSD0323_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_ssd0323;

#endif
