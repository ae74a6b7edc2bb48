#!/bin/sh
# Puts a program on a board with an RP2040 or RP2350: copied to the volume that it shows when BOOTSEL is held at power-up, else by a debug probe.
# Usage: flash.sh VOLUME TARGET PROGRAM.elf PROGRAM.uf2   VOLUME: RPI-RP2 or RP2350; TARGET: of OpenOCD, rp2040 or rp2350
set -eu
volume=$1
target=$2
elf=$3
uf2=$4

for at in ${MOUNTED:-/media/*/"$volume" /media/"$volume" /run/media/*/"$volume" /mnt/"$volume" /Volumes/"$volume"}; do
    if [ -e "$at/INFO_UF2.TXT" ]; then
        echo "Copying $uf2 to $at; the board restarts with it"
        exec cp "$uf2" "$at/"
    fi
done
if command -v openocd >/dev/null; then
    echo "No volume $volume is mounted; trying a CMSIS-DAP probe"
    exec openocd -f interface/cmsis-dap.cfg -c "adapter speed 5000" -f "target/$target.cfg" -c "program $elf verify reset exit"
fi
echo "No volume $volume is mounted: hold BOOTSEL while you plug the board in, and mount it. There is no openocd for a debug probe either." >&2
exit 1
