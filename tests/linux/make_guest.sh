#!/bin/sh
# What the guest boots: kernel, device tree and a first file system with busybox and some modules.
# Usage: make_guest.sh KERNEL-FOLDER BUSYBOX-FOLDER OUT-FOLDER MODULE...   (folders of unpacked packages)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
kernel=$1
busybox=$2
out=$3
shift 3
version=$(ls "$kernel/lib/modules")
root=$out/root
PATH=$PATH:/sbin:/usr/sbin # depmod's place
rm -rf "$root"
mkdir -p "$root/bin" "$root/lib/modules"
cp "$kernel/boot/vmlinuz-$version" "$out/vmlinuz"
cp "$busybox/bin/busybox" "$root/bin/"
install -m 755 "$here/init" "$root/init"
ln -s /share/lib/ld-linux-aarch64.so.1 "$root/lib/ld-linux-aarch64.so.1"

depmod -b "$kernel" "$version"
for module in "$@"; do
    # Dependencies first; those that are built in are left out.
    modprobe -d "$kernel" -S "$version" --show-depends "$module" | awk '$1 == "insmod" { print $2 }'
done | awk '!seen[$0]++' >"$out/modules"
while read -r path; do cp "$path" "$root/lib/modules/"; done <"$out/modules"
sed 's|.*/||' "$out/modules" >"$root/lib/modules/order"
(cd "$root" && find . | cpio --quiet -o -H newc -R 0:0) >"$out/initramfs.cpio"

qemu-system-aarch64 -M "virt,dumpdtb=$out/virt.dtb" -cpu cortex-a53 -m 512 -nographic -nic none 2>/dev/null
dtc -q -I dtb -O dts -o "$out/virt.dts" "$out/virt.dtb"
dtc -q -i "$out" -I dts -O dtb -o "$out/board.dtb" "$here/board.dts"
