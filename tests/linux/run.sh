#!/bin/sh
# Runs the guest once: a script in it, and then what its pins showed on panels.
# Usage: run.sh LINUX-FOLDER SCRIPT SECONDS [PANEL_TRACE PANEL[:MODE] ...]
# Leaves in LINUX-FOLDER/share/out what the script put there, the panels' pictures, panels.out and panels.err.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
linux=$1
script=$2
limit=$3
shift 3
share=$linux/share
start=$(date +%s)
rm -rf "$share/out" "$linux/trace" # QEMU appends to it
mkdir -p "$share/out"
cp "$script" "$share/run"
cp "$here/steps" "$share/steps"
sh "$here/boot.sh" "$linux/guest" "$share" "$limit" "$linux/console" ${1:+"$linux/trace"}
echo "The guest ran for $(($(date +%s) - start)) s"
[ $# -gt 0 ] || exit 0
decoder=$1
shift
# The test looks at what it says.
"$decoder" "$share/out" "$@" <"$linux/trace" >"$share/out/panels.out" 2>"$share/out/panels.err" || true
rm -f "$linux/trace" # hundreds of megabytes
