/* SSD1351: 128 x 128 or 128 x 96, RGB565, 4-wire serial interface. Data sheet Rev 1.5. */
#ifndef TUILE_HAL_PANELS_SSD1351_H
#define TUILE_HAL_PANELS_SSD1351_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_ssd1351;
extern const TUILE_FLASH tuile_panel_t tuile_ssd1351_128x96;

#endif
