#include "panels.h"

#include "../hal/panels/gc9a01.h"
#include "../hal/panels/ili9341.h"
#include "../hal/panels/ili9488.h"
#include "../hal/panels/sh1106.h"
#include "../hal/panels/ssd0323.h"
#include "../hal/panels/ssd1306.h"
#include "../hal/panels/ssd1322.h"
#include "../hal/panels/ssd1351.h"
#include "../hal/panels/st7735.h"
#include "../hal/panels/st7789.h"
#include "../hal/panels/st7796.h"
#include "chips/gc9a01.h"
#include "chips/ili9341.h"
#include "chips/ili9488.h"
#include "chips/sh1106.h"
#include "chips/ssd0323.h"
#include "chips/ssd1306.h"
#include "chips/ssd1322.h"
#include "chips/ssd1351.h"
#include "chips/st7735.h"
#include "chips/st7789.h"
#include "chips/st7796.h"

#include <string.h>

const sim_panel_t sim_panels[] = {
    {&tuile_ili9341, "ILI9341", sim_ili9341_create},
    {&tuile_st7789_240x320, "ST7789", sim_st7789_240x320_create},
    {&tuile_st7789_240x240, "ST7789", sim_st7789_240x240_create},
    {&tuile_st7789_135x240, "ST7789", sim_st7789_135x240_create},
    {&tuile_st7789_170x320, "ST7789", sim_st7789_170x320_create},
    {&tuile_st7789_172x320, "ST7789", sim_st7789_172x320_create},
    {&tuile_st7789_240x280, "ST7789", sim_st7789_240x280_create},
    {&tuile_st7735_128x160, "ST7735", sim_st7735_128x160_create},
    {&tuile_st7735_128x160_green, "ST7735", sim_st7735_128x160_green_create},
    {&tuile_st7735_128x128, "ST7735", sim_st7735_128x128_create},
    {&tuile_st7735_80x160, "ST7735", sim_st7735_80x160_create},
    {&tuile_st7735_80x160_0, "ST7735", sim_st7735_80x160_0_create},
    {&tuile_gc9a01, "GC9A01", sim_gc9a01_create},
    {&tuile_ili9488, "ILI9488", sim_ili9488_create},
    {&tuile_st7796, "ST7796S", sim_st7796_create},
    {&tuile_ssd1351, "SSD1351", sim_ssd1351_create},
    {&tuile_ssd1351_128x96, "SSD1351", sim_ssd1351_128x96_create},
    {&tuile_ssd1306_128x64, "SSD1306", sim_ssd1306_128x64_create},
    {&tuile_ssd1306_128x32, "SSD1306", sim_ssd1306_128x32_create},
    {&tuile_sh1106, "SH1106", sim_sh1106_create},
    {&tuile_ssd1322, "SSD1322", sim_ssd1322_create},
    {&tuile_ssd0323, "SSD0323", sim_ssd0323_create},
};

const size_t sim_panel_count = sizeof sim_panels / sizeof sim_panels[0];

const sim_panel_t *sim_panel_find(const char *name) {
    for (size_t i = 0; i < sim_panel_count; i++) {
        if (strcmp(sim_panels[i].panel->name, name) == 0) { return &sim_panels[i]; }
    }
    return NULL;
}
