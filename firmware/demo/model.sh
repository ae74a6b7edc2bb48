#!/bin/sh
# A model of one's own for a board: MODEL, MAX_FACES and TREE (1: with a display tree) come by the environment.
#
#   model.sh compile TUILE FOLDER                      FOLDER/model.tuile and model.c; left alone if nothing has changed
#   model.sh link TUILE FOLDER BOARD ELF COMMAND ...   runs the command, which links ELF; where the model is too big, says by how much
#   model.sh ram TUILE FOLDER BOARD PANEL BYTES        whether a renderer with so many bytes can draw it on the panel
set -eu
what=$1
tuile=$2
folder=$3
tree=
if [ "${TREE:-0}" != 0 ]; then tree=--tree; fi

# mesh FACES OUT: FACES at most, "" for all.
mesh() {
    "$tuile" mesh "$MODEL" --no-textures $tree ${1:+--max-faces "$1"} -o "$2"
}

compile() {
    mkdir -p "$folder"
    mesh "${MAX_FACES:-}" "$folder/new.tuile" >"$folder/report"
    if cmp -s "$folder/new.tuile" "$folder/model.tuile" && [ -e "$folder/model.c" ]; then
        rm "$folder/new.tuile"
    else
        mv "$folder/new.tuile" "$folder/model.tuile"
        "$tuile" mesh "$folder/model.tuile" -o "$folder/model.c" --name model_model >/dev/null
    fi
    echo "  mesh $MODEL: $(faces) faces, $(bytes "$folder/model.tuile") bytes; textures are left out, boards are built without them"
}

bytes() { wc -c <"$1" | tr -d ' '; }

# Of the last report.
faces() { sed -n 's/.*vertices [0-9]*, faces \([0-9]*\).*/\1/p' "$folder/report"; }

# The most faces with which the model takes no more bytes than $1, found by trying; nothing when even few are too many.
fitting_faces() {
    now=$(faces)
    size=$(bytes "$folder/model.tuile")
    for _ in 1 2 3 4 5 6; do
        [ "$1" -gt 0 ] || return 0
        now=$(awk -v n="$now" -v size="$size" -v most="$1" 'BEGIN {
            n = int(n * most / size * 0.98); for (unit = 1; unit * 100 <= n; unit *= 10); print n - n % unit }')
        [ "$now" -ge 4 ] || return 0
        mesh "$now" "$folder/try.tuile" >/dev/null 2>&1 || return 0
        size=$(bytes "$folder/try.tuile")
        if [ "$size" -le "$1" ]; then
            echo "$now"
            return 0
        fi
    done
}

# too_big BOARD OVER: it is so many bytes too big for the flash.
too_big() {
    size=$(bytes "$folder/model.tuile")
    fits=$(fitting_faces $((size - $2)))
    rm -f "$folder/try.tuile"
    echo "$1: $MODEL takes $size bytes of flash, $2 more than there are${fits:+; $fits faces fit: add MAX_FACES=$fits (--max-faces)}" >&2
    exit 1
}

link() {
    board=$1
    elf=$2
    shift 2
    rm -f "$elf"
    if "$@" 2>"$folder/link"; then return 0; fi
    over=$(sed -n "s/.*region .\(FLASH\|flash\)' overflowed by \([0-9]*\) bytes.*/\2/p" "$folder/link" | sort -n | tail -1)
    if [ -n "$over" ]; then too_big "$board" "$over"; fi
    cat "$folder/link" >&2
    exit 1
}

ram() {
    # The simulator's own structures are a little larger, so that what it can draw the board can.
    if told=$("$tuile" scene model --model "$folder/model.tuile" --panel "$2" --memory "$3" --frames 32 2>&1); then return 0; fi
    least=$(printf '%s' "$told" | sed -n 's/.*too few.* \([0-9][0-9]*\) \(are wanted\|would do\).*/\1/p')
    if [ -n "$least" ]; then
        echo "$1: to draw $MODEL takes $least bytes of RAM, $((least - $3)) more than the renderer has; fewer corners a face, or MAX_FACES=N" >&2
    else
        echo "$1: $told" >&2
    fi
    exit 1
}

shift 3
case $what in
compile) compile ;;
link) link "$@" ;;
ram) ram "$@" ;;
esac
