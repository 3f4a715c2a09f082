#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What weft is built with: Debian 12 packages, and nothing from anywhere else. Installs those that are missing; when none is
# missing it touches neither network nor package manager. Packages named as arguments are wanted besides. Elsewhere (no dpkg): cmake names the library that it cannot find.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  libcgal-dev libeigen3-dev libpolyclipping-dev                 # geometry
  libfmt-dev libtbb-dev libboost-program-options-dev nlohmann-json3-dev nettle-dev
  gettext                                                       # labels of settings in other languages
  libminizip-dev libexpat1-dev libpng-dev zlib1g-dev            # 3MF, pictures, pages
  libpcre2-dev                                                  # substitutions in the G-code
  catch2 libzip-dev                                             # tests
)

packages+=("$@")

command -v dpkg-query > /dev/null || exit 0
missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
echo "installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null
