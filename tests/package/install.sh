#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` lays down, and that it works wherever it is moved to:  bash tests/package/install.sh CMAKE BUILD
set -euo pipefail
cmake=$1 build=$2
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$cmake" --install "$build" --prefix "$scratch/first" --component weft > "$scratch/log"
mv "$scratch/first" "$scratch/moved" # the program finds its profiles from where it is
weft=$scratch/moved/bin/weft
failed=0
check() { # NAME COMMAND...
  local name=$1
  shift
  if "$@" > "$scratch/out" 2>&1; then echo "ok: $name"; else echo "FAILED: $name" >&2; cat "$scratch/out" >&2; failed=1; fi
}
cd "$scratch"
unset WEFT_PROFILES
for file in share/man/man1/weft.1 share/doc/weft/copyright share/doc/weft/LICENSE share/bash-completion/completions/weft \
  share/zsh/vendor-completions/_weft share/fish/vendor_completions.d/weft.fish share/weft/profiles/printers/marlin-220.ini; do
  check "$file is installed" test -s "moved/$file"
done
check "no header or archive is in the program's package" test -z "$(find moved -name '*.h' -o -name '*.a')"
check "the bash completion is what the program prints" cmp <("$weft" completions bash) moved/share/bash-completion/completions/weft
check "profiles are found by name" "$weft" slice "$root/examples/box.stl" -p marlin-220 -p pla -p standard -o box.gcode
check "and listed" bash -c "'$weft' profile list | grep -q '^printers/marlin-220 '"
# Every library that is compiled or linked in has its notice.
for library in CGAL Clipper Boost Eigen fmt oneTBB nlohmann-json nettle zlib minizip expat libpng PCRE2; do
  check "the copyright file names $library" grep -q "third-party/$library" moved/share/doc/weft/copyright
done

# The library, for a program that embeds it. Its archives are there when everything was built; built with sanitizers, they
# ask for them.
sanitizers=$(sed -n 's/^WEFT_SANITIZE:[A-Z]*=//p' "$build/CMakeCache.txt")
if "$cmake" --install "$build" --prefix "$scratch/dev" --component dev > "$scratch/log" 2>&1; then
  check "a program finds the library" "$cmake" -S "$root/tests/package/embed" -B "$scratch/embed" -G Ninja \
    -DCMAKE_PREFIX_PATH="$scratch/dev" ${sanitizers:+-DCMAKE_CXX_FLAGS=-fsanitize=$sanitizers}
  check "and is built with it" "$cmake" --build "$scratch/embed"
  check "and slices" bash -c "'$scratch/embed/embeds_weft' '$root/examples/box.stl' | grep -q ' layers'"
  # What it was found with are packages that weft-dev names.
  depends=$(sed -n '/DEV_PACKAGE_DEPENDS/,/)/p' "$root/cmake/install.cmake")
  for package in zlib1g-dev libeigen3-dev libfmt-dev libtbb-dev libcgal-dev libboost-dev nlohmann-json3-dev libpolyclipping-dev \
    nettle-dev libminizip-dev libexpat1-dev libpng-dev pkg-config; do
    check "weft-dev depends on $package" grep -qE "(^|[\", ])$package[\",]" <<< "$depends"
  done
else
  echo "skipped: the library, of which not all archives are built"
fi
exit $failed
