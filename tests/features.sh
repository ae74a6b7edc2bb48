#!/bin/sh
# -DTUILE_FEATURES=BITS leaves code out: a renderer without a feature links without that feature's files, draws what does not want it
# and refuses what does.
# Usage: features.sh FOLDER COMPILER FLAGS...
set -eu
folder=$1
shift
compiler=$*
mkdir -p "$folder"

# without NAME BIT FILES FIELDS: builds without the bit and the files; a configuration of the fields must be refused.
without() {
    cat >"$folder/main.c" <<C
#include "raster/tuile.h"
int main(void) {
    static const tuile_config_t plain = {.width = 64, .height = 64}, wanting = {.width = 64, .height = 64, $4};
    tuile_t *renderer;
    return tuile_init(&renderer, &plain, 0, 0, 0) != TUILE_ERROR_MEMORY || tuile_init(&renderer, &wanting, 0, 0, 0) != TUILE_ERROR_ARGUMENT;
}
C
    sources=
    for source in raster/*.c raster/*/*.c; do
        case " $3 " in *" $source "*) ;; *) sources="$sources $source" ;; esac
    done
    # shellcheck disable=SC2086
    $compiler -no-pie -DTUILE_FEATURES=$((0xff & ~$2)) -I. "$folder/main.c" $sources -o "$folder/without"
    "$folder/without" || { echo "features: without $1 (bit $2) another configuration is refused"; exit 1; }
    echo "features: $1 (bit $2) can be left out"
}

without resolve 64 "$(echo raster/resolve/*.c)" ".format = TUILE_GREY8"
