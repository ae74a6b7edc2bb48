/* ILI9341: 240 x 320, RGB565 or RGB666, 4-line serial interface. Data sheet V1.11. */
#ifndef TUILE_HAL_PANELS_ILI9341_H
#define TUILE_HAL_PANELS_ILI9341_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_ili9341;

#endif
