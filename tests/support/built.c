#include "built.h"

#include "check.h"

built_t built_load(const char *path, const mesh_options_t *options) {
    built_t built;
    sim_error_t error = {""};
    if (mesh_load(path, 0, options, &built.bytes, &built.size, &built.report, &error) != 0) { fail_msg("%s", error.text); }
    return built;
}
