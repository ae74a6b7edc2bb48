#!/bin/sh
# Instructions of a frame of many instances, and of those among them that are seen. Called by `make bench-instances`.
# Usage: instances.sh PROGRAM OUT SIDE MODEL...
set -eu
. "$(dirname "$0")/count.sh"
program=$1 out=$2 side=$3
shift 3
mkdir -p "$out"
for model in "$@"; do
    count "$out" "$program" "$model" "$side" seen
    seen=$(awk '/^totals:/ { print $2 }' "$out/callgrind.out")
    count "$out" "$program" "$model" "$side"
    all=$(awk '/^totals:/ { print $2 }' "$out/callgrind.out")
    outside=$(figure "$out" outside)
    echo "$(basename "$model"): $(figure "$out" instances) instances, $outside outside: $all instructions; without these $seen;" \
        "$(((all - seen) / outside)) for each that is outside"
done
