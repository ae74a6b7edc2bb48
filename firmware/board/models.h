/* The compiled models as they lie in flash: `tuile mesh` writes their sources at build time. A board links those that it uses. */
#ifndef TUILE_FIRMWARE_MODELS_H
#define TUILE_FIRMWARE_MODELS_H

#include "../scenes.h"

/* The words of the script's model; NULL when the build has none such. */
const uint32_t *models_find(const scene_script_t *script, size_t *size_bytes);

#endif
