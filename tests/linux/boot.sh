#!/bin/sh
# Boots the guest with a shared folder whose script `run` it executes, until it switches itself off.
# Usage: boot.sh GUEST-FOLDER SHARED-FOLDER SECONDS CONSOLE [TRACE]
# CONSOLE receives all that the guest prints. TRACE, a file or a pipe, receives every change of the PL061's pins with its time.
# spidev takes 1000 bytes at a time, a quarter of what is usual: who does not ask has its transfers refused.
# A guest that takes longer is ended, and one that does not get to its end is a failure; its last lines are shown.
set -eu
guest=$1
share=$2
limit=$3
console=$4
trace=${5:-}
result=0
timeout --kill-after=5 "$limit" qemu-system-aarch64 -M virt -cpu cortex-a53 -m 512 -display none -monitor none -serial stdio \
    -no-reboot -nic none -kernel "$guest/vmlinuz" -initrd "$guest/initramfs.cpio" -dtb "$guest/board.dtb" \
    -append 'console=ttyAMA0 quiet loglevel=3 panic=-1 spidev.bufsiz=1000' \
    -fsdev "local,id=share,path=$share,security_model=none" -device virtio-9p-device,fsdev=share,mount_tag=share \
    ${trace:+-msg timestamp=on -trace pl061_set_output -D "$trace"} </dev/null >"$console" 2>&1 || result=$?
[ $result -eq 0 ] && grep -q '^init: done' "$console" && exit 0
echo "boot: the guest $([ $result -eq 124 ] && echo "took more than $limit s" || echo "did not get to its end ($result)"); its last lines:"
tail -n 20 "$console"
exit 1
