/* Arrays that grow. */
#include "stages.h"

#include <string.h>

bool mesh_reserve(void *array, size_t *capacity, size_t count, size_t item_bytes) {
    if (count <= *capacity) { return true; }
    size_t wanted = *capacity < 64 ? 64 : *capacity;
    while (wanted < count) {
        if (wanted > SIZE_MAX / 2) { return false; }
        wanted *= 2;
    }
    if (wanted > SIZE_MAX / item_bytes) { return false; }
    void *old;
    memcpy(&old, array, sizeof old);
    void *grown = realloc(old, wanted * item_bytes);
    if (!grown) { return false; }
    memcpy(array, &grown, sizeof grown);
    *capacity = wanted;
    return true;
}
