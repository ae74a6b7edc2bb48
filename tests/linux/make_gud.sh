#!/bin/sh
# Builds the kernel's gud driver, which Debian's kernels leave out, from Debian's source of the same kernel.
# Usage: make_gud.sh KERNEL-FOLDER SOURCE-FOLDER OUT-FOLDER   (SOURCE-FOLDER: of the unpacked headers, their tools and the source)
set -eu
version=$(ls "$1/lib/modules")
source=$(cd "$2" && pwd)
mkdir -p "$3"
out=$(cd "$3" && pwd)
headers=$source/usr/src/linux-headers-$version
driver=linux-source-6.1/drivers/gpu/drm/gud
tar -C "$out" --strip-components=5 -xf "$source/usr/src/linux-source-6.1.tar.xz" $driver
# Where the headers' makefile looks when it is not installed.
sed -i "s|^include .*/usr/src/|include $source/usr/src/|; s|^include /usr/src/|include $source/usr/src/|" "$headers/Makefile"
make -s -C "$headers" M="$out" CONFIG_DRM_GUD=m CROSS_COMPILE=aarch64-linux-gnu- modules
