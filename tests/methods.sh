#!/bin/sh
# -DTUILE_METHODS=BITS leaves the code of other methods out: the renderer then refers to the named ones only.
# Usage: methods.sh OBJECT COMPILER FLAGS...
set -eu
object=$1
shift
bit=1
for method in zbuffer scanline warnock painter tree; do
    "$@" -DTUILE_METHODS=$bit -c raster/frame/frame.c -o "$object"
    found=$(nm -u "$object" | awk '$2 ~ /^visibility_/ { print $2 }' | tr '\n' ' ')
    [ "$found" = "visibility_$method " ] || { echo "methods: TUILE_METHODS=$bit refers to $found"; exit 1; }
    bit=$((bit * 2))
done
echo "methods: each of the five can be built alone"
