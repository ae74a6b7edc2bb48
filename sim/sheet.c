#include "sheet.h"

#include <string.h>

static void paste(const sim_picture_t *picture, sim_picture_t *onto, uint32_t x, uint32_t y) {
    for (uint32_t row = 0; row < picture->height; row++) {
        memcpy(sim_picture_at(onto, x, y + row), sim_picture_at(picture, 0, row), 3u * (size_t)picture->width);
    }
}

int sim_sheet(const sim_picture_t *pictures, uint32_t count, const sim_sheet_config_t *config, sim_picture_t *out,
              sim_error_t *error) {
    uint32_t columns = config->columns, rows, cell_width = 0, cell_height = 0;
    uint64_t width, height;

    *out = (sim_picture_t){0};
    if (count == 0) { return sim_fail(error, "a contact sheet of no pictures"); }
    for (uint32_t i = 0; i < count; i++) {
        if (!pictures[i].rgb) { return sim_fail(error, "picture %u of the contact sheet is empty", i + 1); }
        cell_width = pictures[i].width > cell_width ? pictures[i].width : cell_width;
        cell_height = pictures[i].height > cell_height ? pictures[i].height : cell_height;
    }
    if (config->half_size) {
        cell_width = (cell_width + 1) / 2;
        cell_height = (cell_height + 1) / 2;
    }
    while (config->columns == 0 && columns * columns < count && columns < SIM_PICTURE_MAX_PX) {
        columns++;
    }
    columns = columns > count ? count : columns;
    rows = (count - 1) / columns + 1;
    width = (uint64_t)columns * ((uint64_t)cell_width + config->margin_px) + config->margin_px;
    height = (uint64_t)rows * ((uint64_t)cell_height + config->margin_px) + config->margin_px;
    if (width > SIM_PICTURE_MAX_PX || height > SIM_PICTURE_MAX_PX) {
        return sim_fail(error, "a contact sheet of %u pictures in %u columns is too large: at most %u pixels a side", count,
                        columns, SIM_PICTURE_MAX_PX);
    }
    if (sim_picture_create(out, (uint32_t)width, (uint32_t)height, error)) { return -1; }
    for (size_t i = 0; i < (size_t)width * height; i++) {
        memcpy(out->rgb + 3 * i, config->background, 3);
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t x = config->margin_px + i % columns * (cell_width + config->margin_px);
        uint32_t y = config->margin_px + i / columns * (cell_height + config->margin_px);
        sim_picture_t half = {0};
        if (config->half_size && sim_picture_halve(&pictures[i], &half, error)) {
            sim_picture_free(out);
            return -1;
        }
        paste(config->half_size ? &half : &pictures[i], out, x, y);
        sim_picture_free(&half);
    }
    return 0;
}
