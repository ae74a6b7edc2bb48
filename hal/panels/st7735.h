/* ST7735R and ST7735S: up to 132 x 162, RGB565, RGB444 or RGB666, 4-line serial interface. Data sheets ST7735R V0.2, ST7735S V1.1.
 *
 * Nothing tells the modules apart but their look: pins on the module choose how much memory the chip has, the glass sits anywhere
 * on it, and the order of the colours and the inversion go with the maker. Where colours or edges are wrong, try another, or copy
 * one and change offset, TUILE_MADCTL_BGR in rotation_base, or inverted. */
#ifndef TUILE_HAL_PANELS_ST7735_H
#define TUILE_HAL_PANELS_ST7735_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_st7735_128x160;       /* memory of 128 x 160: "red tab" */
extern const TUILE_FLASH tuile_panel_t tuile_st7735_128x160_green; /* memory of 132 x 162, offset 2, 1: "green tab" */
extern const TUILE_FLASH tuile_panel_t tuile_st7735_128x128; /* memory of 132 x 132, offset 2, 1 (2, 3 with MX and MY): 1.44 inch */
extern const TUILE_FLASH tuile_panel_t tuile_st7735_80x160;  /* 132 x 162, offset 26, 1: IPS of 0.96 inch, blue first */
extern const TUILE_FLASH tuile_panel_t tuile_st7735_80x160_0; /* 128 x 160, offset 24, 0: the same size, red first, not inverted */

#endif
