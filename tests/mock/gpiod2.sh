#!/bin/sh
# gpiod2.sh FOLDER: libgpiod 2 of Debian's backports, as FOLDER/include/gpiod.h and FOLDER/lib/libgpiod.a.
set -e
mkdir -p "$1"
cd "$1"
rm -rf apt usr
mkdir -p apt/lists/partial apt/cache/archives/partial include lib
echo "deb http://deb.debian.org/debian bookworm-backports main" >apt/sources.list
own() {
  tool=$1
  shift
  "$tool" -qq -o Dir::State::lists="$PWD/apt/lists" -o Dir::Cache="$PWD/apt/cache" -o Dir::Etc::sourcelist="$PWD/apt/sources.list" \
    -o Dir::Etc::sourceparts=/dev/null -o APT::Sandbox::User=root "$@"
}
own apt-get update
own apt-get download libgpiod-dev
dpkg-deb -x libgpiod-dev_2*.deb .
cp usr/include/gpiod.h include/
cp usr/lib/*/libgpiod.a lib/
rm -rf apt usr ./*.deb
