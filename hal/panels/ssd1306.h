/* SSD1306: 128 x 64 or 128 x 32, one bit a pixel, 4-wire serial interface. Data sheet Rev 1.1. */
#ifndef TUILE_HAL_PANELS_SSD1306_H
#define TUILE_HAL_PANELS_SSD1306_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_ssd1306_128x64;
extern const TUILE_FLASH tuile_panel_t tuile_ssd1306_128x32;

#endif
