#!/bin/sh
# The compiler of an emulated processor, as the bench's figures want it. Usage: cc.sh TARGET ARGUMENTS...
set -eu
. "$(dirname "$0")/target.sh"
target "$1"
shift
# shellcheck disable=SC2086 # flags are words
exec "${prefix}gcc" $flags "$@"
