#!/bin/sh
# Code on Cortex-M, in bytes, by gcc -Os: a renderer with all methods, then with each method alone; without effects.
# Usage: size_arm.sh FOLDER COMPILER-PREFIX FLAGS...
set -eu
. "$(dirname "$0")/size_link.sh"
size_open "$1"
shift
printf '%-16s %8s %8s %8s %8s %8s %8s\n' '' all zbuffer scanline warnock painter tree
for cpu in cortex-m0plus cortex-m3; do
    line=
    for methods in 31 1 2 4 8 16; do
        size_link "$cpu-$methods" $cpu '' "$@" -DTUILE_METHODS=$methods -DTUILE_FEATURES=0
        line="$line $bytes"
    done
    # shellcheck disable=SC2086
    printf '%-16s %8s %8s %8s %8s %8s %8s\n' $cpu $line
done
exit $status
