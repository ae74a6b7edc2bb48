#!/bin/sh
# Holds assembly against its C twins in QEMU, for each target.
# Usage: twins.sh OUT NAME 'SOURCE...' 'WRAPPED...' TARGET... : tests/emulators/twins_NAME.c; the sources of raster/ that are built
# once as they are and once without assembly; the functions that the test wraps, to see that they are called.
set -eu
here=$(dirname "$0")
qemu_folder=$here/../bench/qemu
out=$1 name=$2 sources=$3 wrapped=$4
shift 4
for target; do
    . "$qemu_folder/target.sh"
    target "$target"
    folder=$out/$name-$target
    mkdir -p "$folder"
    objects=
    for source in $sources; do
        object=$folder/$(echo "$source" | tr / _ | sed 's/c$/o/')
        sh "$qemu_folder/cc.sh" "$target" -c "$source" -o "$object"
        sh "$qemu_folder/cc.sh" "$target" -DTUILE_ASSEMBLY=0 -c "$source" -o "$object.plain"
        "${prefix}nm" "$object.plain" | awk '$2 ~ /^[TRD]$/ { print $3, "c_" $3 }' >"$folder/names"
        "${prefix}objcopy" --redefine-syms="$folder/names" "$object.plain" "$object.c.o"
        objects="$objects $object $object.c.o"
    done
    wraps=
    for function in $wrapped; do wraps="$wraps -Wl,--wrap=$function"; done
    # shellcheck disable=SC2086 # words
    sh "$qemu_folder/cc.sh" "$target" -Wall -Wextra -Werror -fno-tree-loop-distribute-patterns -nostdlib -nostartfiles -Wl,--gc-sections -Wl,-T,"$qemu_folder/guest.ld" \
        -Wl,--defsym=FLASH="$flash" -Wl,--defsym=RAM="$ram" -DGUEST_MODEL="\"$here/twins.h\"" $wraps "$qemu_folder/$start" tests/emulators/twins.c \
        "tests/emulators/twins_$name.c" tests/emulators/twins_faces.c tests/support/random.c $objects -lgcc -o "$folder/twins.elf"
    code=0
    # shellcheck disable=SC2086 # words
    timeout 300 $qemu -display none -monitor none -serial none -semihosting-config enable=on,target=native -kernel "$folder/twins.elf" \
        >"$folder/told.txt" 2>&1 || code=$?
    echo "$target: $(cat "$folder/told.txt")"
    [ "$code" = 0 ] || exit 1
done
