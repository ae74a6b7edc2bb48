#!/bin/sh
# The objects of raster/, hal/ and firmware/stream keep promise P4: no heap, no floating point, no data of their own, nothing from
# libc but the four functions every compiler may call. Usage: objects.sh OBJECT...
set -eu
status=0
# Freestanding: none of a hosted library's headers, but in the ports for hosts.
if grep -nE '#include <' -r raster hal firmware --include='*.c' --include='*.h' | grep -vE '^hal/(linux|usb)/' | grep -vE '<(stdbool|stddef|stdint|limits|stdalign)\.h>'; then
    echo "objects: hosted headers above"
    status=1
fi
undefined=$(nm -u "$@" | awk '$1 == "U" { print $2 }' | sort -u)
defined=$(nm "$@" | awk 'NF == 3 && $2 ~ /[TDRBC]/ { print $3 }' | sort -u)
for symbol in $undefined; do
    case $symbol in
    memcpy | memset | memmove | memcmp | _GLOBAL_OFFSET_TABLE_ | __asan_* | __ubsan_*) continue ;;
    esac
    if ! printf '%s\n' "$defined" | grep -qx "$symbol"; then
        echo "objects: a symbol from elsewhere: $symbol"
        status=1
    fi
done
if nm "$@" | grep -E ' [dDbBC] '; then
    echo "objects: the symbols above lie in .data or .bss"
    status=1
fi
# Floating point leaves no symbol on x86-64, but it leaves instructions on SSE registers: scalar arithmetic and conversions.
if objdump -d "$@" | grep -E '\b(cvt(t?s[sd]2|si2s|dq2p|ps2|pd2)[a-z0-9]*|(add|sub|mul|div|sqrt|ucomi|comi)s[sd])\b'; then
    echo "objects: floating point instructions above"
    status=1
fi
[ $status -eq 0 ] && echo "objects: no heap, no float, .data and .bss empty in $# objects"
exit $status
