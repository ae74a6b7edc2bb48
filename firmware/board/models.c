#include "models.h"

#include "../../raster/geometry/model.h"

extern const uint32_t model_cube[], model_room[], model_spider[], model_bunny[], model_model[];

/* In the order of scenes[]. */
static const uint32_t *const words[] = {
#if SCENES & SCENE_CUBE
    model_cube,
#endif
#if SCENES & SCENE_ROOM
    model_room,
#endif
#if SCENES & SCENE_SPIDER
    model_spider,
#endif
#if SCENES & SCENE_BUNNY
    model_bunny,
#endif
#if SCENES & SCENE_MODEL
    model_model,
#endif
};

const uint32_t *models_find(const scene_script_t *script, size_t *size_bytes) {
    for (unsigned i = 0; i < scene_count; i++) {
        if (scenes[i] == script) {
            *size_bytes = words[i][MODEL_AT_SIZE / 4]; /* little-endian, as all targets of this folder are */
            return words[i];
        }
    }
    *size_bytes = 0;
    return NULL;
}
