#!/bin/sh
# Runs the guest once: a script in it, and then what its pins showed on a panel.
# Usage: run.sh LINUX-FOLDER PANEL_TRACE PANEL SCRIPT SECONDS
# Leaves in LINUX-FOLDER/share/out what the script put there, the panel's pictures, panel.out and panel.err.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
linux=$1
share=$linux/share
start=$(date +%s)
rm -rf "$share/out"
mkdir -p "$share/out"
cp "$4" "$share/run"
cp "$here/steps" "$share/steps"
rm -f "$linux/trace" # QEMU appends
sh "$here/boot.sh" "$linux/guest" "$share" "$5" "$linux/console" "$linux/trace"
echo "The guest ran for $(($(date +%s) - start)) s"
"$2" "$3" 0 "$share/out" <"$linux/trace" >"$share/out/panel.out" 2>"$share/out/panel.err" || true # the test looks at both
rm -f "$linux/trace" # hundreds of megabytes
