#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From nothing to a first print: installs what is missing (Debian 12), builds weft, slices the bracket and draws a layer of it.
#   bash examples/first-slice.sh [PRINTER.ini] [OUTPUT_FOLDER]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
printer=${1:-profiles/printers/marlin-220.ini}
out=${2:-build/first-slice}

bash cmake/packages.sh
cmake --preset release > /dev/null
cmake --build --preset release --target weft_app
weft=build/release/app/weft

mkdir -p "$out"
"$weft" slice examples/bracket.stl -p "$printer" -p profiles/materials/pla.ini -p profiles/quality/standard.ini -o "$out/bracket.gcode"
"$weft" preview "$out/bracket.gcode" --layer 30 --colour width -o "$out/bracket-layer-30.png"
"$weft" preview "$out/bracket.gcode" -o "$out/bracket.html"

echo
echo "G-code, audited:       $out/bracket.gcode"
echo "a layer as a picture:  $out/bracket-layer-30.png"
echo "all layers:            $out/bracket.html   (open it in a browser)"
