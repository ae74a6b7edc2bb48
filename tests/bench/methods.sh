#!/bin/sh
# The five methods over the scenes of FOLDER/NAME.tuile and, with a display tree, FOLDER/NAME-tree.tuile: a table as README.md has it,
# also in OUT/methods.md. A method that the renderer does not have, or a tree that is not there, is a "-". Called by
# `make bench-methods`.
# Usage: methods.sh BENCH_PROGRAM OUT FOLDER WIDTHxHEIGHT TILE NAME[@EYE@AT@FOV]...
set -eu
. "$(dirname "$0")/count.sh"
program=$1 out=$2 models=$3 size=$4 tile=$5
shift 5
mkdir -p "$out"
rows=$out/methods.txt
: >"$rows"

# Bytes of a model, and of its tree; 4 bytes at 100 of the header are the words of the tree.
size_of() { wc -c <"$1" | tr -d ' '; }
tree_of() { echo $((4 * $(od -An -tu4 -j100 -N4 "$1"))); }

for scene in "$@"; do
    name=${scene%%@*}
    view=
    [ "$name" = "$scene" ] || view=$(echo "${scene#*@}" | tr '@' ' ')
    for method in zbuffer scanline warnock painter tree; do
        model=$models/$name.tuile
        [ $method != tree ] || model=$models/$name-tree.tuile
        for shade in flat gouraud; do
            code=3
            # shellcheck disable=SC2086 # $view is three words
            [ ! -f "$model" ] || { code=0; count "$out" "$program" "$model" "${size%x*}" "${size#*x}" "${tile%x*}" "${tile#*x}" $shade \
                "${MEMORY:-33554432}" $method 0 $view || code=$?; }
            [ $code = 0 ] || [ $code = 3 ] || exit $code
            if [ $code = 3 ]; then
                echo "$name $method $shade - - - - - - -" >>"$rows"
                continue
            fi
            cp "$out/callgrind.out" "$out/callgrind-$name-$method-$shade.out"
            total=$(awk '/^totals:/ { print $2 }' "$out/callgrind.out")
            tree=-
            [ $method != tree ] || tree=$(tree_of "$model")
            echo "$name $method $shade $(figure "$out" faces) $((total / $(figure "$out" frames))) $(figure "$out" beside)" \
                "$(figure "$out" overdraw) $(size_of "$model") $tree" \
                "$(($(figure "$out" passes) / $(figure "$out" frames)))" >>"$rows"
            grep "more than" "$out/run.txt" >&2 || true
        done
    done
done

{
    echo "| scene | method | flat | Gouraud | RAM, KB | overdraw | flash, KB | tree, KB |"
    echo "|---|---|---|---|---|---|---|---|"
    awk '
        function millions(n) { return n == "-" ? "-" : sprintf("%.3f", n / 1e6) }
        function kilo(n) { return n == "-" ? "-" : sprintf("%.1f", n / 1024) }
        $3 == "flat" { flat = $5; beside = $6; next }
        {
            printf "| %s | %s | %s | %s | %s%s | %s | %s | %s |\n", $1 == last ? "" : $4 == "-" ? $1 : $1 ", " $4 " faces", $2,
                millions(flat), millions($5), kilo(($6 > beside) ? $6 : beside), (($10 > 1) ? " in " $10 " passes" : ""),
                $2 == "warnock" && $7 != "-" ? "1" : $7, kilo($8), kilo($9)
            last = $1
        }' "$rows"
} | tee "$out/methods.md"
