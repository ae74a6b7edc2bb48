#!/bin/sh
# The Pico's programs on an emulated RP2040: every frame equals the simulator's, drawing and sending overlap, programs that are broken on
# purpose are found out, and faults are reported with their codes. Usage: pico.sh BUILD PANEL_FRAMES STACK
# STACK: the most bytes of stack that the program can take, as its call graph has it.
set -eu
build=$1
panel_frames=$2
stack=$3
here=$(dirname "$0")
out=$build/emulators/pico
programs=$build/firmware/pico
more=$build/firmware/pico-more
mkdir -p "$out"

emulate() {
    program=$1
    shift
    node "$here/rp2040.mjs" --modules "$build/emulators" --program "$program.elf" "$@"
}

fail() {
    echo "pico: $*" >&2
    exit 1
}

# frames PANEL COUNT OPTIONS [OF THE EMULATOR]
frames() {
    panel=$1
    count=$2
    options="panel=$1 $3"
    shift 3
    emulate "$programs/frames" --trace "$out/$panel.trace" --options "$options" "$@" >"$out/$panel.txt" || fail "$options: $(tail -3 "$out/$panel.txt")"
    "$panel_frames" "$out/$panel.trace" "$panel" "$build/firmware/models" "$count" >"$out/$panel.frames" || fail "the trace is $out/$panel.trace"
    tail -1 "$out/$panel.frames"
    rm "$out/$panel.trace"
    # Painted stack: what was used is no more than what the call graph says and an interrupt.
    awk -v most="$stack" '$1 == "stack" { used = $2; room = $4 } END { exit !(used > 0 && used <= most + 72 && used <= room) }' "$out/$panel.txt" ||
        fail "$(tail -1 "$out/$panel.txt"), but at most $stack by the call graph"
}

# breaks PROGRAM OPTIONS REASON: it must end with it.
breaks() {
    if emulate "$1" --quiet --options "$2" >"$out/breaks.txt" 2>&1; then fail "$1 $2: nothing was noticed"; fi
    grep -qF "rp2040: $3" "$out/breaks.txt" || fail "$1 $2: not \"$3\", but: $(cat "$out/breaks.txt")"
    echo "$(basename "$1") $2: $3"
}

# A program that does not end, as the demo on a board, ends by the limit.
if emulate "$programs/demo" --quiet --seconds 3 --options tell=1 >"$out/limit.txt" 2>&1; then fail "the demo came to an end"; fi
grep -q "rp2040: not done after 3 s;.*last told: demo cube zbuffer" "$out/limit.txt" || fail "no end: $(cat "$out/limit.txt")"

# The second stage that the boot ROM would start, and one whose check sum is wrong.
python3 "$here/../../firmware/pico/boot2.py" check "$programs/frames.bin"
head -c 300 "$programs/frames.bin" | tr '\000' '\001' >"$out/spoilt.bin"
if python3 "$here/../../firmware/pico/boot2.py" check "$out/spoilt.bin" 2>/dev/null; then fail "a wrong check sum passed"; fi

# 18 pairs of scene and method.
frames st7789-240x240 144 frames=8
frames st7789-240x320 8 "frames=8 scene=bunny method=zbuffer"
frames ili9341 8 "frames=8 scene=room method=tree" --flash "$programs/frames.uf2"
frames ili9341 16 "frames=4 scene=spider"

# The demo: what goes by time, then by its button: a short press, and a long one. Its text is in the frames that are compared, and the
# rates in it are those of the emulator's clock: of the frames over which each was taken, to 1 %.
demo() {
    emulate "$programs/demo" --trace "$out/demo.trace" --options "panel=$panel tell=1 $1" ${2:-} >"$out/demo.txt" || fail "demo $1: $(tail -3 "$out/demo.txt")"
    "$panel_frames" "$out/demo.trace" "$panel" "$build/firmware/models" any >"$out/demo.frames" || fail "demo $1: the trace is $out/demo.trace"
    echo "demo $(tail -1 "$out/demo.frames")"
    rm "$out/demo.trace"
}
panel=st7789-240x240
demo "every=1 frames=19"
awk '$1 == "demo" { print $2, $3 }' "$out/demo.txt" >"$out/demo.order"
awk '!/^#/ { for (i = 2; i <= NF; i++) { print $1, $i } } END { print "cube zbuffer" }' "$here/../../firmware/pico/frames" | cmp - "$out/demo.order" ||
    fail "the demo does not go through all scenes and methods: $out/demo.order"
demo "frames=110" "--press 600:120,1000:800"
awk '$1 == "demo" { pair = $2 " " $3
         if (pair != shown) { order = order pair ";"; moved[pair] = $NF }
         if (pair != shown || $5 != rate) {
             if ($5 > 0) {
                 true_rate = 1000 * (NR - since) / (before - start); rates++
                 if ($5 > 1.01 * true_rate || $5 < 0.99 * true_rate) { print "rate " $5 ", but " true_rate " by the clock"; wrong = 1 }
             }
             since = NR; start = before; rate = $5; shown = pair
         }
         before = $NF
     }
     END { in_time = moved["cube scanline"] > 720 && moved["cube scanline"] < 800 && moved["room zbuffer"] > 1600 && moved["room zbuffer"] < 1700
           printf "demo: by its button %s %d rates to 1 %%\n", order, rates
           exit !(order == "cube zbuffer;cube scanline;room zbuffer;" && in_time && rates >= 2 && !wrong) }' "$out/demo.txt" ||
    fail "the demo does not do what its button says, or shows a wrong rate: $out/demo.txt"

# With two buffers, a frame by itself takes the longer of both and the last tile's pixels, which go out when all is drawn: 40 of 240 rows, a
# sixth of the wire. Beyond that 4 %: the third tile waits for the first to be out, and the last for the one before it, where the tile drawn
# meanwhile has little in it. In a row of frames they go out while the next one begins, but for those of the last frame: 3 %.
emulate "$more/overlap" >"$out/overlap.txt" || fail "$(cat "$out/overlap.txt")"
awk '$1 == "render" { render = $5 } $1 == "wire" { wire = $5 }
     $1 == "flow" { flow = $5 }
     $1 == "both" {
         most = render > wire ? render : wire
         sum += most
         best = most + wire / 6
         if (!worst || $5 / best > worst) { worst = $5 / best; text = sprintf("render %.3f ms, wire %.3f ms, both %.3f ms", render, wire, $5) }
         if ($7 == 0) { print "pico: the core never sleeps"; exit 1 }
         frames++
     }
     END { printf "overlap: %d frames, at worst %s: %.2f %% over what two buffers can do; in a row %.2f %% over the longer\n", frames, text, 100 * (worst - 1), 100 * ((flow - wire / 6) / sum - 1)
           exit !(frames == 8 && worst <= 1.04 && flow > sum && flow - wire / 6 <= 1.03 * sum) }' "$out/overlap.txt" || fail "drawing and sending do not overlap: $out/overlap.txt"

# Onto a board that shows its volume, and onto none.
mkdir -p "$out/volume" && : >"$out/volume/INFO_UF2.TXT"
MOUNTED=$out/volume sh "$here/../../firmware/rp2/flash.sh" RPI-RP2 rp2040 "$programs/frames.elf" "$programs/frames.uf2" >/dev/null
cmp "$programs/frames.uf2" "$out/volume/frames.uf2"
if MOUNTED=$out/none PATH=$out/none /bin/sh "$here/../../firmware/rp2/flash.sh" RPI-RP2 rp2040 x y 2>"$out/flash.txt"; then fail "flashed without a board"; fi
grep -q "hold BOOTSEL" "$out/flash.txt" || fail "no board: $(cat "$out/flash.txt")"

breaks "$more/mutant_1" "scene=cube frames=1" "DMA writes to SPI0, but its requests are off"
breaks "$more/mutant_2" "scene=cube frames=1" "a frame on SPI0, but GPIO 18, its clock, has the function 31"
breaks "$more/mutant_3" "scene=cube frames=1" "SPI0 is in reset, but"
breaks "$more/mutant_4" "scene=cube frames=1" "SSPCPSR is 0"
breaks "$programs/frames" fault=hard "the program parked with 64"
breaks "$programs/frames" fault=stack "the program parked with 65"
breaks "$programs/frames" fault=assert "the program parked with 66"
