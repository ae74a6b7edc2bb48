#!/bin/sh
# Counts instructions by callgrind and prints a table and build/bench/bench.json. Called by `make bench`.
# METHOD and VARIANT in the environment are handed on to the program.
# Usage: bench.sh BENCH_PROGRAM OUTPUT_FOLDER WIDTHxHEIGHT TILE... -- MODEL...
set -eu
. "$(dirname "$0")/count.sh"
program=$1 out=$2 size=$3
shift 3
tiles=
while [ "$1" != -- ]; do
    tiles="$tiles $1"
    shift
done
shift
mkdir -p "$out"
rows=$out/rows.txt
: >"$rows"
width=${size%x*} height=${size#*x}
for model in "$@"; do
    for tile in $tiles; do
        for shade in ${SHADES:-flat gouraud textured-gouraud}; do
            memory=${MEMORY:-4194304}
            count "$out" "$program" "$model" "$width" "$height" "${tile%x*}" "${tile#*x}" "$shade" "$memory" \
                "${METHOD:-zbuffer}" "${VARIANT:-0}"
            faces=$(figure "$out" faces)
            frames=$(figure "$out" frames)
            # Self cost of each function, summed by phase. The line after "calls=" is what the callee cost: not ours.
            awk -v frames="$frames" -v faces="$faces" -v model="$(basename "$model" | sed 's/\..*//')" -v tile="$tile" \
                -v shade="$shade" -v width="$width" -v height="$height" '
                function name(text) {
                    if (match(text, /^\([0-9]+\)/)) {
                        id = substr(text, RSTART, RLENGTH)
                        rest = substr(text, RLENGTH + 2)
                        if (rest != "") names[id] = rest
                        return names[id]
                    }
                    return text
                }
                function phase(f) {
                    if (f ~ /^(vertex_|perspective|orthographic)/) return "vertex"
                    if (f ~ /^(surface_fill_|stage_|texture_|fetch_|store|shade_box|triangle_fill[a-z_]*|triangle_paint_[agf][a-z]*|triangle_skip|bend|fill_rows|polygon_start|polygon_fill|polygon_paint|polygon_paint_start|polygon_skip|polygon_span|span_|chains_|polygon_chain|sorted_crossings|side_start|ring_point|polygon_crossing)/) return "span"
                    if (f ~ /^(zbuffer_clear|shade_clear|frame_fill_words|tile_clear)/ || f ~ /memset/) return "clear"
                    if (f ~ /^resolve_tile/) return "resolve"
                    return "setup"
                }
                /^fn=/ { current = name(substr($0, 4)); sub(/\x27[0-9]+$/, "", current); next }
                /^cfn=/ { name(substr($0, 5)); next }
                /^calls=/ { getline; next }
                /^[0-9+*-]+ [0-9]+$/ { cost[phase(current)] += $2; self[current] += $2; total += $2 }
                END {
                    printf "%s %d %d %s %s %d %.0f %.0f %.0f %.0f %.0f %.0f\n", model, width, height, tile, shade, faces, total / frames,
                        cost["vertex"] / frames, cost["setup"] / frames, cost["span"] / frames, cost["clear"] / frames, cost["resolve"] / frames
                    for (f in self) printf "%12.0f %s\n", self[f] / frames, f | "sort -rn > " functions
                }' functions="$out/functions.txt" "$out/callgrind.out" >>"$rows"
        done
    done
done
awk 'BEGIN { printf "%-10s %-9s %-8s %-8s %7s %12s %10s %10s %10s %10s %10s\n", "model", "window", "tile", "shade", "faces",
             "instructions", "vertex", "setup", "span", "clear", "resolve" }
     { printf "%-10s %-9s %-8s %-8s %7d %12d %10d %10d %10d %10d %10d\n", $1, $2 "x" $3, $4, $5, $6, $7, $8, $9, $10, $11, $12 }' "$rows"
awk -v method="${METHOD:-zbuffer}" 'BEGIN { print "[" }
     { printf "%s  {\"target\": \"x86-64\", \"model\": \"%s\", \"width\": %d, \"height\": %d, \"tile\": \"%s\", \"method\": \"" method "\", \"shade\": \"%s\", \"faces\": %d, \"instructions\": %d, \"phases\": {\"vertex\": %d, \"setup\": %d, \"span\": %d, \"clear\": %d, \"resolve\": %d}}",
       (NR > 1 ? ",\n" : ""), $1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12 }
     END { print "\n]" }' "$rows" >"$out/bench.json"
