/* Pixels as a panel reads them off the wire, for the formats that no simulated chip takes: written from what the formats are said
 * to be (raster/tuile.h), not from how the renderer makes them. */
#ifndef SIM_WIRE_H
#define SIM_WIRE_H

#include "../raster/tuile.h"
#include "picture.h"

/* Puts a tile in its place. Components are widened to 8 bits by repeating their upper bits below, as the ILI9341 does. -1 and one
 * line in error when the tile reaches out of the picture, has another number of bytes than its pixels take, or begins within a
 * byte. */
int wire_paste(const sim_picture_t *picture, uint8_t format, const tuile_tile_t *tile, sim_error_t *error);

/* What a tile's place is a multiple of, in pixels, so that no byte belongs to two tiles. format: one that has pixels. */
void wire_unit(uint8_t format, unsigned *columns, unsigned *rows);

#endif
