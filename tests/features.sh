#!/bin/sh
# -DTUILE_FEATURES=BITS leaves code out: a renderer without a feature links without that feature's files, draws what does not want it
# and refuses what does.
# Usage: features.sh FOLDER COMPILER FLAGS...
set -eu
folder=$1
shift
compiler=$*
mkdir -p "$folder"
roots= # what draws frames; what a board calls besides may want more files
for symbol in tuile_model_open tuile_init tuile_begin tuile_next tuile_seek tuile_end tuile_wanted tuile_pick; do
    roots="$roots -Wl,-u,$symbol"
done

# without NAME DEFINITION FILES FIELDS: builds without the files; a configuration of the fields must be refused.
without() {
    cat >"$folder/main.c" <<C
#include "raster/tuile.h"
int main(void) {
    static const tuile_config_t plain = {.width = 64, .height = 64}, wanting = {.width = 64, .height = 64, $4};
    tuile_t *renderer;
    return tuile_init(&renderer, &plain, 0, 0, 0) != TUILE_ERROR_MEMORY || tuile_init(&renderer, &wanting, 0, 0, 0) != TUILE_ERROR_ARGUMENT;
}
C
    build "$1" "$2" "$3"
}

# The same of an instance with the fields in a scene.
without_in_scene() {
    cat >"$folder/main.c" <<C
#include "raster/tuile.h"
static uint64_t block[4096];
int main(void) {
    static const tuile_config_t config = {.width = 64, .height = 64, .tile_height = 4};
    static const tuile_model_t model = {.cluster_vertices_max = 3, .corners_max = 3};
    static const tuile_instance_t plain = {.model = &model}, wanting = {.model = &model, $4};
    tuile_scene_t scene = {.instances = &plain, .instance_count = 1};
    tuile_t *renderer;
    if (tuile_init(&renderer, &config, block, sizeof block, 0) || tuile_begin(renderer, &scene) || tuile_end(renderer, 0)) { return 1; }
    scene.instances = &wanting;
    return tuile_begin(renderer, &scene) != TUILE_ERROR_EFFECTS;
}
C
    build "$1" "$2" "$3"
}

# The same of a scene with the fields, for a renderer with surfaces.
without_in_frame() {
    cat >"$folder/main.c" <<C
#include "raster/tuile.h"
static uint64_t block[8192];
int main(void) {
    static const tuile_config_t config = {.width = 64, .height = 64, .tile_height = 4, .effects = TUILE_SURFACES};
    static const tuile_light_t point = {.kind = TUILE_LIGHT_POINT, .intensity = 255, .range = 65536};
    static const tuile_scene_t plain = {.ambient = 255}, wanting = {.ambient = 255, $4};
    tuile_t *renderer;
    (void)point;
    if (tuile_init(&renderer, &config, block, sizeof block, 0) || tuile_begin(renderer, &plain) || tuile_end(renderer, 0)) { return 1; }
    return tuile_begin(renderer, &wanting) != TUILE_ERROR_EFFECTS;
}
C
    build "$1" "$2" "$3"
}

build() {
    sources=
    for source in raster/*.c raster/*/*.c; do
        case " $3 " in *" $source "*) ;; *) sources="$sources $source" ;; esac
    done
    # shellcheck disable=SC2086
    $compiler -no-pie -ffunction-sections -fdata-sections -Wl,--gc-sections $roots -D$2 -I. "$folder/main.c" $sources -o "$folder/without"
    "$folder/without" || { echo "features: without $1 ($2) the wrong ones are refused"; exit 1; }
    echo "features: $1 can be left out"
}

without surfaces TUILE_FEATURES=0x1e0 "raster/frame/shade.c $(echo raster/surface/*.c)" ".effects = TUILE_SURFACES"
without resolve TUILE_FEATURES=0x0bf "$(echo raster/resolve/*.c)" ".format = TUILE_GREY8"
without samples TUILE_FEATURES=0x0ff "raster/resolve/mean.c" ".aa = TUILE_AA_2X2"
without formats TUILE_FORMATS=0x001 "" ".format = TUILE_RGB332"
without "colours of one bit and of eight" TUILE_FORMATS=0x0fff "" ".format = TUILE_RGB111"
without_in_scene "key frames" TUILE_FEATURES=0x17f "$(echo raster/frame/morph.c raster/geometry/morph.c raster/scene/*.c)" ".morph = 1"
without_in_frame lights TUILE_FEATURES=0x1fb "raster/frame/lights.c raster/geometry/lamp.c raster/surface/light.c" ".lights = &point, .light_count = 1"
without_in_frame fog TUILE_FEATURES=0x1f7 "raster/surface/fog.c raster/surface/fog_stage.c" ".fog = {TUILE_FOG_LINEAR, {0}, 0, 65536}"
without overlays TUILE_FEATURES=0x1ff "$(echo raster/overlay/*.c)" ".overlay = (tuile_overlay_fn)8"
without layers TUILE_FEATURES=0x3cf "$(echo raster/layer/*.c)" ".effects = TUILE_LAYERS"
without lines TUILE_FEATURES=0x3df "raster/layer/line.c" ".effects = TUILE_LAYERS, .edges = TUILE_EDGES_FRONT"
