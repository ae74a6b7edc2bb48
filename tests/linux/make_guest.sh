#!/bin/sh
# What the guest boots: kernel, device tree and a first file system with busybox and some modules.
# Usage: make_guest.sh KERNEL-FOLDER BUSYBOX-FOLDER OUT-FOLDER MODULE...   (folders of unpacked packages)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
kernel=$1
busybox=$2
out=$3
shift 3
root=$out/root
rm -rf "$root"
mkdir -p "$root/bin" "$root/lib"
cp "$kernel/boot/vmlinuz-$(ls "$kernel/lib/modules")" "$out/vmlinuz"
cp "$busybox/bin/busybox" "$root/bin/"
install -m 755 "$here/init" "$root/init"
ln -s /share/lib/ld-linux-aarch64.so.1 "$root/lib/ld-linux-aarch64.so.1"
sh "$here/modules.sh" "$kernel" "$root/lib/modules" "$@"
(cd "$root" && find . | cpio --quiet -o -H newc -R 0:0) >"$out/initramfs.cpio"

qemu-system-aarch64 -M "virt,dumpdtb=$out/virt.dtb" -cpu cortex-a53 -m 512 -nographic -nic none 2>/dev/null
dtc -q -I dtb -O dts -o "$out/virt.dts" "$out/virt.dtb"
dtc -q -i "$out" -I dts -O dtb -o "$out/board.dtb" "$here/board.dts"
