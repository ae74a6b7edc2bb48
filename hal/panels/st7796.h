/* ST7796S: 320 x 480, RGB565 or RGB666, 4-line serial interface. Data sheet V1.0. */
#ifndef TUILE_HAL_PANELS_ST7796_H
#define TUILE_HAL_PANELS_ST7796_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_st7796;

#endif
