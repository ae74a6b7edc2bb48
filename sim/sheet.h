/* Contact sheets: many pictures on one. */
#ifndef SIM_SHEET_H
#define SIM_SHEET_H

#include <stdbool.h>

#include "picture.h"

/* Zero = default. */
typedef struct sim_sheet_config {
    uint32_t columns;      /* 0 = as many as make the grid about square */
    uint32_t margin_px;    /* around and between the pictures */
    bool half_size;        /* each picture halved, by the mean of 2 x 2 */
    uint8_t background[3]; /* red, green, blue */
} sim_sheet_config_t;

/* Lays count pictures out row by row, each at the top left of a cell as large as the largest of them. out is the caller's to free.
 * -1 and one line in error when there is none, one is empty, or the sheet would exceed SIM_PICTURE_MAX_PX. */
int sim_sheet(const sim_picture_t *pictures, uint32_t count, const sim_sheet_config_t *config, sim_picture_t *out,
              sim_error_t *error);

#endif
