#!/bin/sh
# The Black Pill's program, as it is flashed, on an emulated STM32F411 (blackpill.c): every frame equals the simulator's. Then programs that
# use the chip wrongly, each of which must be told.
# Usage: blackpill.sh BUILD HARNESS PANEL_FRAMES   COMPILE and LINK, of the environment: the commands, with all objects but board.o and spi.o.
set -eu
build=$1 harness=$2 panel_frames=$3
programs=$build/firmware/blackpill
out=$build/emulators/blackpill
mkdir -p "$out"

fail() {
    echo "blackpill: $*" >&2
    exit 1
}

"$harness" "$programs/frames.bin" "$out/trace" >"$out/frames.txt" 2>&1 || fail "$(tail -1 "$out/frames.txt")"
"$panel_frames" "$out/trace" st7789-240x240 "$build/firmware/models" 144 >"$out/frames.txt" || fail "the trace is $out/trace"
tail -1 "$out/frames.txt"
rm "$out/trace"

# mutant NAME FILE SED-EXPRESSION WHAT THE HARNESS SAYS
mutant() {
    for file in board spi; do
        if [ "$file" = "$2" ]; then expression=$3; else expression=; fi
        sed -e "$expression" "firmware/blackpill/$file.c" >"$out/$file.c"
        if [ "$file" = "$2" ] && cmp -s "$out/$file.c" "firmware/blackpill/$file.c"; then fail "$1: nothing was changed"; fi
        $COMPILE -c "$out/$file.c" -o "$out/$file.o"
    done
    $LINK "$out/board.o" "$out/spi.o" -lgcc -o "$out/mutant.elf"
    arm-none-eabi-objcopy -O binary "$out/mutant.elf" "$out/mutant.bin"
    if "$harness" "$out/mutant.bin" "$out/trace" 20 >"$out/mutant.txt" 2>&1; then fail "$1 was not noticed"; fi
    grep -qF "blackpill: $4" "$out/mutant.txt" || fail "$1: not \"$4\" but: $(tail -1 "$out/mutant.txt")"
    echo "blackpill: $1: $4"
}

mutant no_requests spi 's/SPI1_CR2 = SPI_CR2_TX_DMA/SPI1_CR2 = 0/' 'DMA2 waits for SPI1, whose requests are off'
mutant no_pin_function spi '/GPIOA_AFRL |=/d' 'a byte on SPI1, but PA5 has the mode 2 and the function 0'
mutant no_clock_for_spi spi '/RCC_APB2ENR |= 1u << 12/d' 'SPI1 has no clock'
mutant no_clock_for_dma spi 's/1u << 0 | 1u << 22/1u << 0/' 'DMA2 has no clock'
mutant not_drained_after_dma spi '/cpsie i" ::: "memory");/,/sending = false/s/drain();//' 'the chip select moves while a transfer is under way'
mutant not_drained_after_command spi '/SPI1_DR = \*bytes++/,/^}/s/drain();//' 'D/C moves while a transfer is under way'
mutant wrong_channel spi 's/DMA_CR_CHANNEL_3 |/(2u << 25) |/' 'channel 2 of DMA2'
mutant memory_stands_still spi 's/DMA_CR_MEMORY_INCREMENTS | //' 'DMA2 does not go byte by byte'
mutant flag_left_standing spi '/^void dma2_stream_3(void) {/,/^}/s/DMA2_LIFCR = DMA_STREAM_3_FLAGS;//' 'the handler of interrupt 59 leaves its request standing'
mutant no_interrupt spi '/NVIC_ISER1 =/d' 'the core sleeps, and nothing will wake it'
mutant clock_changed_while_on spi 's/^    SPI1_CR1 = control;//' 'SPI1 changes its clock while it is on'
mutant not_waited_for spi 's/if (!sending) { return TUILE_HAL_OK; }/if (sending || !sending) { return TUILE_HAL_OK; }/' \
    "DMA2's stream 3 is written to while it moves data"
mutant flash_too_fast board '/FLASH_ACR = /d' 'flash has 0 wait states at 100000000 Hz'
mutant regulator_too_low board '/PWR_CR |= /d' "the regulator's scale 2 does not allow 100000000 Hz"
mutant crystal_not_awaited board '/RCC_CR_HSERDY/d' 'the PLL is started before its crystal is ready'
mutant bus_too_fast board 's/RCC_CFGR_APB1_HALF | RCC_CFGR_SW_PLL/RCC_CFGR_SW_PLL/' "APB1's clock is 100000000 Hz"
