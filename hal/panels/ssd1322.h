/* SSD1322: 256 x 64 of 480 x 128, 16 greys, 4-wire serial interface. Data sheet Rev 1.2. */
#ifndef TUILE_HAL_PANELS_SSD1322_H
#define TUILE_HAL_PANELS_SSD1322_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_ssd1322;

#endif
