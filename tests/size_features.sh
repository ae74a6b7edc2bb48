#!/bin/sh
# What each feature adds to a z-buffer renderer on Cortex-M3, in bytes of code and constants, by gcc -Os: built by itself (with what it
# builds on), and all of them together.
# Usage: size_features.sh FOLDER COMPILER-PREFIX FLAGS...
set -eu
. "$(dirname "$0")/size_link.sh"
size_open "$1"
shift

# row NAME BITS BASE ROOTS [FLAGS]: BASE is the size without it.
row() {
    size_link "features-$2$5" cortex-m3 "$4" "$compiler" $flags -DTUILE_METHODS=1 -DTUILE_FEATURES="$2" $5
    if [ "$3" = 0 ]; then printf '%-44s %8s\n' "$1" "$bytes"; else printf '%-44s %8s\n' "$1" "+$((bytes - $3))"; fi
}

compiler=$1
shift
flags=$*
only565=-DTUILE_FORMATS=3
row 'z-buffer, flat and Gouraud, RGB565' 0 0 '' $only565
plain=$bytes
row 'key frames (morph)' 128 "$plain" '' $only565
row 'all formats and dithering' 64 "$plain" '' ''
formats=$bytes
row 'anti-aliasing, with all formats' 320 "$formats" '' ''
row 'deferred shading' 1 "$plain" '' $only565
surfaces=$bytes
row 'textures, on deferred shading' 3 "$surfaces" '' $only565
row 'coloured light, highlights, vertex colours' 5 "$surfaces" '' $only565
row 'fog' 9 "$surfaces" '' $only565
row 'transparency, sprites' 17 "$surfaces" '' $only565
layers=$bytes
row 'lines, edges of faces' 49 "$layers" '' $only565
row 'overlay: shapes' 0 "$plain" 'tuile_draw_rectangle tuile_draw_line tuile_draw_disc tuile_draw_arc' $only565
row 'overlay: text' 0 "$plain" 'tuile_font_open tuile_text' $only565
row 'all' 0x1ff 0 '' ''
exit $status
