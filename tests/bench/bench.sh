#!/bin/sh
# Counts instructions, on this machine by callgrind and on others by QEMU (qemu/run.sh), and prints a table and OUT/bench.json. Called by
# `make bench`. Emulated targets draw by the z-buffer, in the first of the tiles.
# In the environment: TARGETS, SHADES, MEMORY (bytes); METHOD and VARIANT are handed on to the program.
# Usage: bench.sh BENCH_PROGRAM TURNTABLE_PROGRAM OUT WIDTHxHEIGHT TILE... -- MODEL...
set -eu
here=$(dirname "$0")
. "$here/count.sh"
program=$1 turntable=$2 out=$3 size=$4
shift 4
tiles=
while [ "$1" != -- ]; do
    tiles="$tiles $1"
    shift
done
shift
first=$(echo "$tiles" | awk '{ print $1 }')
mkdir -p "$out"
rows=$out/rows.txt
: >"$rows"
width=${size%x*} height=${size#*x}
memory=${MEMORY:-4194304}
method=${METHOD:-zbuffer}
# Which lines of fill/small.h are rows and pixels: see there.
small=$(awk '/^\/\* ---- rows and pixels/ { first = NR } /^\/\* ---- set-up/ { last = NR } END { print first "-" last }' raster/fill/small.h)

phases() { awk -v frames=8 -v small="$small" -f "$here/phases.awk"; }

row() { # TARGET MODEL TILE SHADE: the phases from standard input
    read -r figures
    echo "$(basename "$2" | sed 's/\..*//') $1 $4 $size $3 $method $(figure "$out" faces) $figures" >>"$rows"
}

for model in "$@"; do
    for tile in $tiles; do
        for shade in ${SHADES:-flat gouraud textured-gouraud}; do
            count "$out" "$program" "$model" "$width" "$height" "${tile%x*}" "${tile#*x}" "$shade" "$memory" "$method" "${VARIANT:-0}"
            awk -f "$here/lines.awk" "$out/callgrind.out" >"$out/lines.txt"
            awk '{ self[$2] += $1 } END { for (f in self) printf "%12.0f %s\n", self[f] / 8, f }' "$out/lines.txt" | sort -rn >"$out/functions.txt"
            phases <"$out/lines.txt" | row x86-64 "$model" "$tile" "$shade"
            [ "$tile" = "$first" ] && [ "$method" = zbuffer ] || continue
            for target in ${TARGETS:-}; do
                [ "$target" != x86-64 ] || continue
                sh "$here/qemu/run.sh" "$out" "$target" "$turntable" "$model" "$width" "$height" "${tile%x*}" "${tile#*x}" "$shade" "$memory" \
                    >"$out/hash-$target.txt"
                phases <"$out/$target/lines.txt" | row "$target" "$model" "$tile" "$shade"
                cmp -s "$out/hash-$target.txt" "$out/hash.txt" || echo "$target draws another picture: $model $shade" >&2
            done
        done
    done
done

awk 'BEGIN { format = "%-10s %-13s %-17s %-8s %-8s %6s %9s %8s %8s %8s %8s %8s %8s %8s\n"
             printf format, "model", "target", "shade", "window", "tile", "faces", "total", "vertex", "cull", "setup", "span", "clear", "resolve", "helpers" }
     { printf format, $1, $2, $3, $4, $5, $7, $8, $9, $10, $11, $12, $13, $14, $15 }' "$rows"
awk 'BEGIN { print "[" }
     { printf "%s  {\"model\": \"%s\", \"target\": \"%s\", \"shade\": \"%s\", \"size\": \"%s\", \"tile\": \"%s\", \"method\": \"%s\", \"faces\": %d, \"phases\": {\"vertex\": %d, \"cull\": %d, \"setup\": %d, \"span\": %d, \"clear\": %d, \"resolve\": %d, \"helpers\": %d}, \"total\": %d}",
       (NR > 1 ? ",\n" : ""), $1, $2, $3, $4, $5, $6, $7, $9, $10, $11, $12, $13, $14, $15, $8 }
     END { print "\n]" }' "$rows" >"$out/bench.json"
