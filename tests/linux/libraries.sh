#!/bin/sh
# Copies the shared libraries that arm64 programs load, and those that these load, from a tree of unpacked packages.
# Usage: libraries.sh TREE OUT-FOLDER PROGRAM...
set -eu
tree=$1
out=$2
shift 2
mkdir -p "$out"
while [ $# -gt 0 ]; do
    found=
    for library in $(readelf -d "$@" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | sort -u) ld-linux-aarch64.so.1; do
        [ -e "$out/$library" ] && continue
        path=$(find "$tree/lib" "$tree/usr/lib" -name "$library" -print -quit)
        [ -n "$path" ] || { echo "libraries: $library is in no package" && exit 1; }
        cp -L "$path" "$out/$library"
        found="$found $out/$library"
    done
    # shellcheck disable=SC2086 # a list of paths
    set -- $found
done
