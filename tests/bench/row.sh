#!/bin/sh
# Counts the frames of the bench once: on this machine by callgrind, on others by QEMU (qemu/run.sh). Prints one line of names and
# numbers: what the frames were, and their instructions by phase (phases.awk). OUT/functions.txt has them by function.
# Exit code 3: the renderer does not have the method, or not with this model.
# In the environment: ROOT, the folder whose raster/ is counted; for others than x86-64 what qemu/run.sh wants beside it.
# Usage: row.sh OUT TARGET BENCH_PROGRAM SCENE_PROGRAM MODEL WIDTHxHEIGHT TILE SHADE MEMORY_BYTES METHOD
set -eu
here=$(dirname "$0")
. "$here/count.sh"
out=$1 target=$2 program=$3 scene=$4 model=$5 size=$6 tile=$7 shade=$8 memory=$9
shift 9
method=$1
width=${size%x*} height=${size#*x}
mkdir -p "$out"
# Which lines of fill/small.h are rows and pixels: see there; and which statements of its twins in assembly, where there are any.
small=$(awk '/^\/\* ---- rows and pixels/ { first = NR } /^\/\* ---- set-up/ { last = NR } END { print first "-" last }' \
    "$ROOT/raster/fill/small.h")
thumb=$(cd "$ROOT/raster/fill" && for file in *_thumb*.c; do
    [ ! -f "$file" ] || awk -v file="$file" '/^ *__asm__ volatile\(ROWS/ { print "/" file " " FNR ";" }' "$file"
done | tr -d '\n')

if [ "$target" = x86-64 ]; then
    count "$out" "$program" "$model" "$width" "$height" "${tile%x*}" "${tile#*x}" "$shade" "$memory" "$method" || exit $?
    awk -f "$here/lines.awk" "$out/callgrind.out" >"$out/lines.txt"
else
    code=0
    "$program" "$model" "$width" "$height" "${tile%x*}" "${tile#*x}" "$shade" "$memory" "$method" >"$out/run.txt" || code=$?
    [ $code = 0 ] || exit $code
    sh "$here/qemu/run.sh" "$out" "$target" "$scene" "$model" "$width" "$height" "${tile%x*}" "${tile#*x}" "$shade" "$memory" "$method" \
        >"$out/hash.txt"
    if [ "$(cat "$out/hash.txt")" != "$(grep '^hash ' "$out/run.txt")" ]; then
        echo "$target draws another picture than this machine: $model $shade $method: $(cat "$out/hash.txt")" >&2
        exit 1
    fi
fi
frames=$(figure "$out" frames)
awk -v frames="$frames" '{ self[$2] += $1 } END { for (f in self) printf "%12.0f %s\n", self[f] / frames, f }' "$out/lines.txt" |
    sort -rn >"$out/functions.txt"
awk -v frames="$frames" -v small="$small" -v thumb="$thumb" -f "$here/phases.awk" "$out/lines.txt" | {
    read -r total vertex cull setup span clear resolve helpers ours
    [ "$total" -gt 0 ] || { echo "nothing was counted" >&2; exit 1; }
    echo "faces $(figure "$out" faces) frames $frames passes $(figure "$out" passes) vertices $(figure "$out" vertices)" \
        "peak $(figure "$out" peak) total $total vertex $vertex cull $cull setup $setup span $span clear $clear resolve $resolve" \
        "helpers $helpers raster $ours"
}
rm -f "$out/callgrind.out" "$out/guest.elf" "$out/model.tuile" "$out/counts.txt" "$out/symbols.txt" "$out/scene.h"
