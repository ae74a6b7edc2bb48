#!/bin/sh
# Copies kernel modules with all that they need, and lists them in FOLDER/order, in an order in which each finds what it needs.
# Usage: modules.sh KERNEL-FOLDER FOLDER MODULE...   (the folder of the unpacked kernel; modules by name, or FILE.ko of another build)
set -eu
kernel=$1
out=$2
shift 2
PATH=$PATH:/sbin:/usr/sbin # kmod's place
version=$(ls "$kernel/lib/modules")
rm -rf "$out"
mkdir -p "$out"
[ -e "$kernel/lib/modules/$version/modules.dep.bin" ] || depmod -b "$kernel" "$version"
show() {
    # Those that are built in are left out.
    modprobe -d "$kernel" -S "$version" --show-depends "$1" | awk '$1 == "insmod" { print $2 }'
}
for module in "$@"; do
    case $module in
    *.ko)
        for needed in $(modinfo -F depends "$module" | tr ',' ' '); do show "$needed"; done
        echo "$module"
        ;;
    *) show "$module" ;;
    esac
done | awk '!seen[$0]++' >"$out/paths"
while read -r path; do cp "$path" "$out/"; done <"$out/paths"
sed 's|.*/||' "$out/paths" >"$out/order"
rm "$out/paths"
