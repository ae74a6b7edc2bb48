#!/bin/sh
# Instructions of the bench's frames on an emulated processor, by line in OUT/TARGET/lines.txt and by function in
# OUT/functions-TARGET.txt; a hash of the pictures on standard output.
# Usage: run.sh OUT TARGET SCENE_PROGRAM MODEL WIDTH HEIGHT TILE_WIDTH TILE_HEIGHT SHADE MEMORY_BYTES
# TARGET: cortex-m0plus, cortex-m3, cortex-m4, cortex-m33 or rv32imac.
set -eu
here=$(dirname "$0")
out=$1 target=$2 program=$3 model=$4 width=$5 height=$6 tile_width=$7 tile_height=$8 shade=$9
shift 9
memory=$1
folder=$out/$target
mkdir -p "$folder"

case $target in
rv32imac)
    prefix=riscv64-unknown-elf- start=start_riscv.S flash=0x80000000 ram=0x81000000
    flags="-march=rv32imac -mabi=ilp32 -mcmodel=medany" qemu="qemu-system-riscv32 -M virt -bios none" ;;
*)
    prefix=arm-none-eabi- start=start_arm.S flash=0 ram=0x21000000
    flags="-mcpu=$target -mthumb -mfloat-abi=soft" cpu=$target board=mps2-an385
    case $target in
    cortex-m0plus) cpu=cortex-m3 ;; # whose instructions are among those of the M3: no board with an M0 has the memory
    cortex-m4) board=mps2-an386 ;;
    cortex-m33) board=mps2-an505 flash=0x10000000 ram=0x80000000 ;;
    esac
    qemu="qemu-system-arm -M $board -cpu $cpu" ;;
esac
case $shade in *gouraud) shading=TUILE_GOURAUD ;; *) shading=TUILE_FLAT ;; esac
case $shade in textured-*) effects=TUILE_SURFACES ;; *) effects=0 ;; esac

cc -shared -fPIC -O2 "$here/count.c" -o "$folder/count.so"
"$program" "$model" "$width" "$height" "$folder/model.tuile" "$folder/scene.h" >/dev/null
# The model takes no part in what is compiled again for each frame size.
for source in raster/*.c raster/*/*.c; do
    object=$folder/$(echo "$source" | tr / -).o
    if [ ! -f "$object" ] || [ -n "$(find raster -newer "$object" -name '*.[ch]' -print -quit)" ]; then
        # shellcheck disable=SC2086
        "${prefix}gcc" $flags -std=c11 -O2 -g -ffreestanding -ffunction-sections -fdata-sections -c "$source" -o "$object"
    fi
done
# shellcheck disable=SC2086
"${prefix}gcc" $flags -std=c11 -O2 -g -ffreestanding -fno-tree-loop-distribute-patterns -ffunction-sections -fdata-sections -nostdlib \
    -nostartfiles -Wl,--gc-sections -Wl,-T,"$here/guest.ld" -Wl,--defsym=FLASH=$flash -Wl,--defsym=RAM=$ram \
    -DSCENE="\"$(cd "$folder" && pwd)/scene.h\"" -DGUEST_MODEL="\"$folder/model.tuile\"" -DWIDTH="$width" -DHEIGHT="$height" \
    -DTILE_WIDTH="$tile_width" -DTILE_HEIGHT="$tile_height" -DSHADE=$shading -DEFFECTS=$effects -DMEMORY="$memory" \
    "$here/$start" "$here/guest.c" "$folder"/raster-*.o -lgcc -o "$folder/guest.elf"

"${prefix}nm" "$folder/guest.elf" | sort >"$folder/symbols.txt"
address() { awk -v name="$1" '$3 == name { print "0x" $1 }' "$folder/symbols.txt"; }
start_at=$(address program_start) end_at=$(address program_end)
$qemu -display none -monitor none -serial none -semihosting-config enable=on,target=native \
    -plugin "$folder/count.so,from=$(address guest_from),to=$(address guest_to),base=$start_at,bytes=$((end_at - start_at)),out=$folder/counts.txt" \
    -kernel "$folder/guest.elf" 2>&1 | grep -v '^qemu-system' || true
# Lines of count, function, file of the function, file of the line, line; as of lines.awk.
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
awk '{ self[$2] += $1 } END { for (f in self) printf "%12.0f %s\n", self[f] / 8, f }' "$folder/lines.txt" | sort -rn >"$out/functions-$target.txt"
