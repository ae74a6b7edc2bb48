/* SH1106: 128 x 64 of 132 x 64, one bit a pixel, 4-wire serial interface. Data sheet V2.3. */
#ifndef TUILE_HAL_PANELS_SH1106_H
#define TUILE_HAL_PANELS_SH1106_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_sh1106;

#endif
