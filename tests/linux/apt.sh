#!/bin/sh
# Debian packages for arm64 (or for ARCHITECTURE), unpacked and not installed. They come from the sources that this machine's apt knows, by way of lists
# of their own, so that nothing of the machine changes.
# Usage: apt.sh STATE alone|whole FOLDER PACKAGE...   alone: these packages; whole: with all that they depend on
# linux-image-arm64, which only names the newest kernel, stands for that one.
set -eu
mkdir -p "$1" "$3"
state=$(cd "$1" && pwd)
how=$2
folder=$(cd "$3" && pwd)
shift 3
mkdir -p "$state/lists/partial" "$state/cache/archives/partial"
cat >"$state/apt.conf" <<END
APT::Architecture "${ARCHITECTURE:-arm64}";
APT::Architectures { "${ARCHITECTURE:-arm64}"; };
APT::Install-Recommends "false";
APT::Sandbox::User "root";
Acquire::Languages "none";
Dir::State "$state";
Dir::State::status "$state/status";
Dir::Cache "$state/cache";
END
export APT_CONFIG="$state/apt.conf"
: >>"$state/status" # nothing is installed there

download() {
    names=
    for name in "$@"; do
        case $name in
        linux-image-arm64) name=$(apt-cache depends "$name" | awk '$1 == "Depends:" && !found { found = $2 } END { print found }') ;;
        esac
        names="$names $name"
    done
    # shellcheck disable=SC2086 # a list of names
    if [ "$how" = whole ]; then
        apt-get install -y -qq --download-only $names >/dev/null
    else
        (cd "$state/cache/archives" && apt-get download -qq $names)
    fi
}

[ -e "$state/updated" ] || apt-get update -qq
touch "$state/updated"
rm -f "$state"/cache/archives/*.deb
# What the lists name may have been replaced since.
download "$@" || { apt-get update -qq && download "$@"; }
for package in "$state"/cache/archives/*.deb; do dpkg-deb -x "$package" "$folder"; done
rm -f "$state"/cache/archives/*.deb
