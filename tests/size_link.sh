# Sourced by the scripts that tell code sizes on Cortex-M: links a renderer with what a board calls to draw frames (no picking, no lines
# in whole pixels) and nothing that it does not need. Long division from libgcc and memory.h's functions are in it.

# size_open FOLDER
size_open() {
    folder=$1
    mkdir -p "$folder"
    cat >"$folder/board.c" <<'C'
#include "raster/tuile.h"
#include "raster/memory.h"
int main(void) { return 0; }
void *memcpy(void *to, const void *from, size_t n) { char *t = to; const char *f = from; while (n--) *t++ = *f++; return to; }
void *memmove(void *to, const void *from, size_t n) {
    char *t = to; const char *f = from;
    if (t < f) { while (n--) *t++ = *f++; } else { while (n--) t[n] = f[n]; }
    return to;
}
void *memset(void *to, int c, size_t n) { char *t = to; while (n--) *t++ = (char)c; return to; }
C
    status=0
}

# size_link NAME CPU ROOTS COMPILER-PREFIX FLAGS...: code and constants in bytes, in $bytes. Data, a heap or floating point set status.
size_link() {
    out="$folder/$1"
    cpu=$2
    roots=
    for symbol in tuile_model_open tuile_init tuile_begin tuile_next tuile_end tuile_wanted tuile_camera_look_at tuile_rotation $3; do
        roots="$roots -Wl,-u,$symbol"
    done
    prefix=$4
    # As firmware is built: gcc 12 makes wrong code for v6-M without the flag (firmware/firmware.mk).
    case $cpu in cortex-m0*) cores=-fno-ipa-ra ;; *) cores= ;; esac
    shift 4
    # shellcheck disable=SC2086
    "${prefix}gcc" -mcpu="$cpu" -mthumb -Os $cores "$@" -I. -ffunction-sections -fdata-sections -fno-tree-loop-distribute-patterns -nostdlib \
        -Wl,--gc-sections -Wl,-e,main $roots "$folder/board.c" raster/*.c raster/*/*.c -lgcc -o "$out"
    bytes=$("${prefix}size" "$out" | awk 'NR == 2 { print $1 }')
    if "${prefix}size" "$out" | awk 'NR == 2 { exit $2 + $3 == 0 }'; then
        echo "$out has data of its own"
        status=1
    fi
    if "${prefix}nm" "$out" | grep -E ' (malloc|free|calloc|realloc|_sbrk|__aeabi_[fd](add|sub|mul|div|cmp|2)[a-z0-9]*|(sqrt|sin|cos|floor)f?)$'; then
        echo "$out has the symbols above"
        status=1
    fi
}
