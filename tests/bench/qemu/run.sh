#!/bin/sh
# Instructions of the bench's frames on an emulated processor, by line in OUT/lines.txt, as of lines.awk; a hash of the pictures on standard
# output.
# In the environment: ROOT, the folder whose raster/ is counted; GUEST, where its objects are for each target; PLUGIN,
# tests/emulators/count.c.
# Usage: run.sh OUT TARGET SCENE_PROGRAM MODEL WIDTH HEIGHT TILE_WIDTH TILE_HEIGHT SHADE MEMORY_BYTES [METHOD]
set -eu
here=$(dirname "$0")
. "$here/target.sh"
folder=$1 name=$2 program=$3 model=$4 width=$5 height=$6 tile_width=$7 tile_height=$8 shade=$9
target "$name"
objects=$(cd "$ROOT" && find raster -name '*.c' ! -path 'raster/compact/*' | sort | sed "s|^|$GUEST/$name/|; s/c$/o/")
shift 9
memory=$1
method=TUILE_$(echo "${2:-zbuffer}" | tr '[:lower:]' '[:upper:]')
case $shade in *gouraud) shading=TUILE_GOURAUD ;; *) shading=TUILE_FLAT ;; esac
case $shade in textured-*) effects=TUILE_SURFACES ;; *) effects=0 ;; esac

"$program" "$model" "$width" "$height" "$folder/model.tuile" "$folder/scene.h" >/dev/null
# shellcheck disable=SC2086 # $objects is words
sh "$here/cc.sh" "$name" -fno-tree-loop-distribute-patterns -nostdlib -nostartfiles -Wl,--gc-sections -Wl,-T,"$here/guest.ld" \
    -Wl,--defsym=FLASH="$flash" -Wl,--defsym=RAM="$ram" -DSCENE="\"$(cd "$folder" && pwd)/scene.h\"" -DGUEST_MODEL="\"$folder/model.tuile\"" \
    -DWIDTH="$width" -DHEIGHT="$height" -DTILE_WIDTH="$tile_width" -DTILE_HEIGHT="$tile_height" -DSHADE=$shading -DEFFECTS=$effects \
    -DMETHOD="$method" -DMEMORY="$memory" "$here/$start" "$ROOT/tests/bench/qemu/guest.c" $objects -lgcc -o "$folder/guest.elf"

"${prefix}nm" "$folder/guest.elf" >"$folder/symbols.txt"
address() { awk -v name="$1" '$3 == name { print "0x" $1 }' "$folder/symbols.txt"; }
rm -f "$folder/counts.txt"
start_at=$(address program_start) end_at=$(address program_end)
# shellcheck disable=SC2086 # $qemu is words
timeout 600 $qemu -display none -monitor none -serial none -semihosting-config enable=on,target=native \
    -plugin "file=$PLUGIN,from=$(address guest_from),to=$(address guest_to),base=$start_at,bytes=$((end_at - start_at)),out=$folder/counts.txt" \
    -kernel "$folder/guest.elf" 2>&1 | tee "$folder/qemu.txt" | grep -v '^qemu-system' || true
[ -s "$folder/counts.txt" ] || { echo "QEMU has counted nothing:" && cat "$folder/qemu.txt"; } >&2
[ -s "$folder/counts.txt" ]
awk '{ print "0x" $1 }' "$folder/counts.txt" | "${prefix}addr2line" -f -i -a -e "$folder/guest.elf" | awk '
    function flush(i, at) {
        if (n == 0) return
        at = 1
        while (at < n && (file[at] ~ /\/(fixed|tuile)\.h$/ || file[at] == "??")) at++
        print name[n], file[n], file[at], line[at]
    }
    /^0x/ { flush(); n = 0; next }
    { name[++n] = $1; getline; sub(/ .*/, ""); split($0, part, ":"); file[n] = part[1]; line[n] = part[2] }
    END { flush() }' | paste -d" " "$folder/counts.txt" - | cut -d" " -f2- >"$folder/lines.txt"
