#!/bin/sh
# Programs of the Uno that use the SPI wrongly: the harness must tell each.
# Usage: uno_mutants.sh HARNESS FOLDER MODELS MUTANTS FLAGS...   FOLDER: of the sound program's objects; MUTANTS: where these go
set -eu
harness=$1 folder=$2 models=$3 out=$4
shift 4
status=0
mkdir -p "$out"

# mutant NAME SED-EXPRESSION WHAT THE HARNESS SAYS
mutant() {
    sed -e "$2" firmware/uno/spi.c >"$out/$1.c"
    if cmp -s "$out/$1.c" firmware/uno/spi.c; then
        echo "uno_mutants: $1: nothing was changed"
        status=1
        return
    fi
    # shellcheck disable=SC2086
    avr-gcc $flags -Ifirmware/uno -c "$out/$1.c" -o "$out/$1.o"
    objects=$(find "$folder" -name '*.o' ! -name spi.o ! -name demo.o ! -path "$out/*")
    # shellcheck disable=SC2086
    avr-gcc -mmcu=atmega328p -nostdlib -nostartfiles -Wl,--gc-sections -Wl,--relax -T firmware/uno/link.ld "$out/$1.o" $objects -lgcc \
        -o "$out/$1.elf"
    avr-objcopy -O binary "$out/$1.elf" "$out/$1.bin"
    if "$harness" test "$out/$1.bin" "$models" >"$out/$1.txt" 2>&1; then
        echo "uno_mutants: $1 was not noticed"
        status=1
    elif ! grep -q "$3" "$out/$1.txt"; then
        echo "uno_mutants: $1: not \"$3\" but: $(tail -1 "$out/$1.txt")"
        status=1
    fi
}

flags=$*
mutant off 's/SPCR_SPE | SPCR_MSTR/SPCR_MSTR/' 'off or a slave'
mutant slave 's/SPCR_SPE | SPCR_MSTR/SPCR_SPE/' 'off or a slave'
mutant select_is_input 's/DDRB = PIN_SELECT | PIN_DC/DDRB = PIN_DC/' 'a pin is an input'
mutant no_wait 's/while (!(SPSR & SPSR_SPIF)) {}//' 'while a byte was on the wire'
mutant never_selected 's/~(PIN_SELECT | PIN_DC)/~PIN_DC/' 'not selected'
mutant dc_low_for_data 's/ | PIN_DC);$/ \& ~PIN_DC);/' 'SSD1306\|command\|dots differ'
mutant no_reset 's/level ? PORTB | PIN_RESET : PORTB & ~PIN_RESET/PORTB/' 'never reset'
exit $status
