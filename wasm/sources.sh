#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# sources.sh FOLDER: the sources of the libraries that the program stands on and that WebAssembly needs compiled anew,
# as Debian has them, into FOLDER/NAME. apt gets them by lists of its own below FOLDER: nothing of the system changes,
# and nobody needs to be root. Quiet when all is there.
set -eu
folder=$1
packages="cairo libjpeg-turbo libpng1.6 openmesh pixman pugixml qpdf zlib"

missing=
for package in $packages; do
  [ -f "$folder/$package/.unpacked" ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

echo "Fetching Debian's sources:$missing" >&2
mkdir -p "$folder/apt/lists/partial"
cd "$folder/apt"
# From where the system has its packages.
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
mirror=$(apt-get indextargets --format '$(REPO_URI)' "Identifier: Packages" "Release: $release" "Component: main" | head -n 1)
[ -n "$mirror" ] || {
  echo "apt knows no place with packages of $release" >&2
  exit 1
}
printf 'deb-src %s %s main\n' "$mirror" "$release" >sources.list
options="-q -o Dir::Etc::SourceList=$PWD/sources.list -o Dir::Etc::SourceParts=/dev/null"
options="$options -o Dir::State::Lists=$PWD/lists"
[ "$(id -u)" -ne 0 ] || options="$options -o APT::Sandbox::User=root"
quietly() {
  if ! "$@" >apt.log 2>&1 </dev/null; then
    cat apt.log >&2
    echo "Fetching the sources failed" >&2
    exit 1
  fi
}
# shellcheck disable=SC2086 # one word per option
quietly apt-get $options update
for package in $missing; do
  # shellcheck disable=SC2086
  case $package in
    # As its authors publish it: Debian's difference isn't on every mirror.
    pixman) quietly apt-get $options source --only-source --tar-only "$package" ;;
    *) quietly apt-get $options source --only-source --download-only "$package" ;;
  esac
  rm -rf "../$package" unpacked
  case $package in
    pixman)
      mkdir unpacked
      quietly tar --extract --strip-components=1 --directory=unpacked --file="$(ls pixman_*.orig.tar.gz)"
      ;;
    *) quietly dpkg-source --extract "$(ls "${package}"_*.dsc)" unpacked ;;
  esac
  mv unpacked "../$package"
  touch "../$package/.unpacked"
done
