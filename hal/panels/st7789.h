/* ST7789: up to 240 x 320, RGB565, RGB444 or RGB666, 4-line serial interface; the glasses that are sold with it, all of them IPS.
 * Data sheet ST7789V V1.0. Modules without a chip select line want SPI mode 3. */
#ifndef TUILE_HAL_PANELS_ST7789_H
#define TUILE_HAL_PANELS_ST7789_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_st7789_240x320;
extern const TUILE_FLASH tuile_panel_t tuile_st7789_240x240;
extern const TUILE_FLASH tuile_panel_t tuile_st7789_135x240;
extern const TUILE_FLASH tuile_panel_t tuile_st7789_170x320;
extern const TUILE_FLASH tuile_panel_t tuile_st7789_172x320;
extern const TUILE_FLASH tuile_panel_t tuile_st7789_240x280;

#endif
