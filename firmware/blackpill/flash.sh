#!/bin/sh
# Puts a program on a Black Pill: by USB, if it is in the STM32's own boot loader (BOOT0 held while NRST is pressed), else by an ST-Link.
# Usage: flash.sh PROGRAM.elf PROGRAM.bin
set -eu
elf=$1
bin=$2

if command -v dfu-util >/dev/null && dfu-util -l 2>/dev/null | grep -q '0483:df11'; then
    echo "Writing $bin by dfu-util; the board starts it"
    exec dfu-util -d 0483:df11 -a 0 -s 0x08000000:leave -D "$bin"
fi
if command -v st-flash >/dev/null; then
    echo "No board is in its boot loader; trying an ST-Link by st-flash"
    exec st-flash --reset write "$bin" 0x08000000
fi
if command -v openocd >/dev/null; then
    echo "No board is in its boot loader; trying an ST-Link by openocd"
    exec openocd -f interface/stlink.cfg -f target/stm32f4x.cfg -c "program $elf verify reset exit"
fi
if command -v dfu-util >/dev/null; then
    echo "No board is in its boot loader: hold BOOT0, press NRST, let go of both. There is no st-flash or openocd for an ST-Link either." >&2
else
    echo "There is no dfu-util (by USB), st-flash or openocd (by an ST-Link): install one, apt-get install dfu-util" >&2
fi
exit 1
