#!/bin/sh
# Code on Cortex-M, in bytes, by gcc -Os: a renderer with all methods, then with each method alone, linked with what a board calls to
# draw frames (no picking, no lines) and nothing that it does not need. Long division from libgcc and memory.h's functions are in it.
# Usage: size_arm.sh FOLDER COMPILER-PREFIX FLAGS...
set -eu
folder=$1
prefix=$2
shift 2
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
roots=
for symbol in tuile_model_open tuile_init tuile_begin tuile_next tuile_end tuile_wanted tuile_camera_look_at tuile_rotation; do
    roots="$roots -Wl,-u,$symbol"
done
status=0
printf '%-16s %8s %8s %8s %8s %8s %8s\n' '' all zbuffer scanline warnock painter tree
for cpu in cortex-m0plus cortex-m3; do
    line=
    for methods in 31 1 2 4 8 16; do
        out="$folder/$cpu-$methods"
        "${prefix}gcc" -mcpu=$cpu -mthumb -Os "$@" -I. -ffunction-sections -fdata-sections -fno-tree-loop-distribute-patterns \
            -DTUILE_METHODS=$methods -nostdlib -Wl,--gc-sections -Wl,-e,main $roots "$folder/board.c" raster/*.c raster/*/*.c \
            -lgcc -o "$out"
        line="$line $("${prefix}size" "$out" | awk 'NR == 2 { print $1 }')"
        if "${prefix}size" "$out" | awk 'NR == 2 { exit $2 + $3 == 0 }'; then
            echo "size-arm: $out has data of its own"
            status=1
        fi
        if "${prefix}nm" "$out" | grep -E ' (malloc|free|calloc|realloc|_sbrk|__aeabi_[fd](add|sub|mul|div|cmp|2)[a-z0-9]*|(sqrt|sin|cos|floor)f?)$'; then
            echo "size-arm: $out has the symbols above"
            status=1
        fi
    done
    # shellcheck disable=SC2086
    printf '%-16s %8s %8s %8s %8s %8s %8s\n' $cpu $line
done
exit $status
