/* ILI9488: 320 x 480, RGB666 or 8 colours, 4-line serial interface, which takes no 16-bit pixels. Data sheet V1.00. */
#ifndef TUILE_HAL_PANELS_ILI9488_H
#define TUILE_HAL_PANELS_ILI9488_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_ili9488;

#endif
