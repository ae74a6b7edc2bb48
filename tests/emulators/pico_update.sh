#!/bin/sh
# Frames of which the Pico sends only what has changed: its panel shows what it would show without, the wire carries just the bytes that
# the simulator says, and where the wire is what takes longest, frames are the shorter for it. Then programs that do it wrongly, each of
# which must be found out.
# Usage: pico_update.sh BUILD PANEL_FRAMES   COMPILE and LINK, of the environment: the commands, with all objects but update.o.
set -eu
build=$1
panel_frames=$2
here=$(dirname "$0")
out=$build/emulators/pico-update
panel=st7789-240x320
mkdir -p "$out"

fail() {
    echo "pico: update: $*" >&2
    exit 1
}

# run PROGRAM NAME OPTIONS: the program's lines in NAME.txt, those of its panel in NAME.frames.
run() {
    node "$here/rp2040.mjs" --modules "$build/emulators" --program "$1" --trace "$out/trace" \
        --options "panel=$panel frames=8 method=zbuffer $3" >"$out/$2.txt" 2>&1 &&
        "$panel_frames" "$out/trace" "$panel" "$build/firmware/models" 8 >"$out/$2.frames" 2>&1
}

# On the wire after the first frame, whose bytes are those of the start as well.
wire() { awk '$1 == "frame" && $4 > 0 { sum += $NF } END { print sum + 0 }' "$out/$1.frames"; }

# predicted SCENE OPTIONS: what the simulator says of the same.
predicted() {
    scene=$1
    shift
    "$build/tuile" scene "$scene" --models "$build/firmware/models" --panel "$panel" --frames 8 "$@" | awk '$1 == "wire:" { print $6 }'
}

# sound PROGRAM NAME OPTIONS BYTES
sound() {
    : >"$out/$2.frames"
    run "$1" "$2" "$3" || { cat "$out/$2.txt" "$out/$2.frames" | tail -1 | cut -c -120; return 1; }
    [ "$(wire "$2")" = "$4" ] || { echo "$3: $(wire "$2") bytes on the wire, not $4"; return 1; }
}

cube="scene=cube clock=15 columns=80 rows=16"
room="scene=room rows=16"
cube_bytes=$(predicted cube --tile 80x16 --update 16)
room_bytes=$(predicted room --tile 240x16 --update 16)
program=$build/firmware/pico/frames.elf
sound "$program" whole "$cube" "$(predicted cube --tile 80x16)" || fail "see $out"
sound "$program" cube "$cube update=16" "$cube_bytes" || fail "see $out"
sound "$program" room "$room update=16" "$room_bytes" || fail "see $out"
for scene in spider bunny; do
    sound "$program" $scene "scene=$scene rows=16 update=16" "$(predicted $scene --tile 240x16 --update 16)" || fail "see $out"
done

# Of what the wire saves, frames have at least 85 %: the rest goes into sums, and into more windows.
awk '$1 == "frame" && $4 > 0 {
         for (i = 6; i < NF; i++) { if ($i == "ms") ms[FILENAME] += $(i + 1) / 7; if ($i == "wire") bits[FILENAME] += $(i + 1) / 7 }
     }
     END {
         whole = ARGV[1]; less = ARGV[2]
         printf "update: a frame of the cube at 12.5 MHz %.1f ms, of which the wire takes %.1f; what has changed of it %.1f and %.1f\n",
             ms[whole], bits[whole], ms[less], bits[less]
         exit !(bits[less] < bits[whole] * 0.75 && ms[whole] - ms[less] >= 0.85 * (bits[whole] - bits[less]))
     }' "$out/whole.txt" "$out/cube.txt" || fail "frames do not become shorter: $out/whole.txt, $out/cube.txt"
echo "update: $(wire cube) of $(wire whole) bytes on the wire, as the simulator says; 32 frames equal its whole ones"

# mutant NAME SED-EXPRESSION
mutant() {
    sed -e "$2" firmware/update.c >"$out/$1.c"
    if cmp -s "$out/$1.c" firmware/update.c; then fail "$1: nothing was changed"; fi
    $COMPILE -c "$out/$1.c" -o "$out/$1.o"
    $LINK "$out/$1.o" -lgcc -o "$out/$1.elf"
    if told=$(sound "$out/$1.elf" "$1" "$cube update=16" "$cube_bytes" && sound "$out/$1.elf" "$1" "$room update=16" "$room_bytes"); then
        fail "$1 was not noticed"
    fi
    echo "update: $1: $told"
}

mutant last_line_not_summed 's/; lines > 0; lines--/; lines > 1; lines--/'
mutant end_of_line_not_summed 's/while (at < end)/while (false)/; s/end - at >= 4;/end - at >= 4 \&\& false;/; s/end - at >= 16;/end - at >= 32;/'
mutant sum_not_kept 's/\*sum = summing ? \(.*\) : 0;/const uint32_t now = \1; if (before == 0) { *sum = now; }/'
mutant window_misplaced 's/tile->x + run->from, tile->y/tile->x, tile->y/'
mutant window_of_the_whole_tile 's/run->end - run->from, tile->height)/tile->width - run->from, tile->height)/'
mutant tile_skipped_though_it_changed 's/tuile_changes_touch(update->changes, x, y, width, height)/(x == 80 \&\& y > 64)/'
mutant not_moved_together 's/if (count < layout->line_bytes)/if (false)/'
mutant gaps_always_bridged 's/return run_bytes(layout, tile, &gap) <= .*/return run_bytes(layout, tile, \&gap) + update->window_bytes > 0;/'
