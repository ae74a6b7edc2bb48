/* GC9A01: 240 x 240, round, RGB565, RGB444 or RGB666, 4-line serial interface. Data sheet GC9A01A V1.0. */
#ifndef TUILE_HAL_PANELS_GC9A01_H
#define TUILE_HAL_PANELS_GC9A01_H

#include "../panel.h"

extern const TUILE_FLASH tuile_panel_t tuile_gc9a01;

#endif
