#include "ids.h"

#include <string.h>

int ids_draw(tuile_t *renderer, const tuile_scene_t *scene, uint32_t *ids) {
    const size_t width = tuile_config(renderer)->width;
    tuile_tile_t tile;
    int result = tuile_begin(renderer, scene);
    if (result) { return result; }
    while ((result = tuile_next(renderer, &tile)) == 1) {
        for (unsigned y = 0; y < tile.height; y++) {
            memcpy(ids + (size_t)(tile.y + y) * width + tile.x, tile.bytes + 4u * (size_t)y * tile.width, 4u * (size_t)tile.width);
        }
    }
    (void)tuile_end(renderer, NULL);
    return result;
}
