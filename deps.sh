#!/bin/sh
# SPDX-License-Identifier: MIT
#
# deps.sh PACKAGE...: does nothing when all Debian packages are there; otherwise installs the
# missing ones with apt-get (as root, or through sudo), and where there is no apt-get prints by
# name what could not be found.
set -u

missing_packages() {
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q ' installed$' ||
            { [ "$package" = gnuplot-nox ] && command -v gnuplot >/dev/null 2>&1; } ||
            printf '%s ' "$package"
    done
}

missing_elsewhere() {
    for program in cc c++ pkg-config gnuplot oiiotool; do
        command -v "$program" >/dev/null 2>&1 || printf '%s ' "$program"
    done
    for library in fftw3 fftw3f OpenImageIO jansson cmocka gsl mpfr; do
        pkg-config --exists "$library" 2>/dev/null || printf '%s ' "$library"
    done
}

if ! command -v apt-get >/dev/null 2>&1 || ! command -v dpkg-query >/dev/null 2>&1; then
    missing=$(missing_elsewhere)
    [ -z "$missing" ] && exit 0
    echo "bandlimit needs these, and this system has no apt-get to install them: $missing" >&2
    exit 1
fi

missing=$(missing_packages "$@")
[ -z "$missing" ] && exit 0
if [ "$(id -u)" = 0 ]; then
    as_root=
elif command -v sudo >/dev/null 2>&1; then
    as_root=sudo
else
    echo "bandlimit needs these packages; install them as root: apt-get install $missing" >&2
    exit 1
fi
echo "installing: $missing"
$as_root apt-get update -q &&
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
