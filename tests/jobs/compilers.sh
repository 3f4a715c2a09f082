#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The bytes do not depend on the compiler:  bash tests/jobs/compilers.sh WEFT [OTHER]
# OTHER is weft of the same sources from another compiler: build/clang/app/weft by default, which is made by
#   cmake --preset clang && cmake --build --preset clang --target weft_app
# Every model at every variant below must give the same G-code from both, byte for byte, on another number of threads too.
set -euo pipefail
weft=$(realpath "$1")
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
other=${2:-$root/build/clang/app/weft}
skip() { echo "SKIPPED: $1" >&2; exit 77; }
[ -x "$other" ] || skip "$other is not there: cmake --preset clang && cmake --build --preset clang --target weft_app"
for program in "$weft" "$other"; do
  newer=$(find "$root/lib" "$root/app" -type f \( -name '*.cpp' -o -name '*.h' \) -newer "$program" | head -n 1)
  [ -z "$newer" ] || skip "$program is older than ${newer#"$root"/}: build both"
done

variants=(
  ""
  "infill_pattern=gyroid infill_sparse_density=15 layer_height=0.28"
  "infill_pattern=triangles wall_line_count=1 flow_compensation=false infill_connect_lines=false"
  "infill_pattern=concentric retraction_hop=0.4 retraction_hop_type=spiral max_extrusion_rate_slope=20"
  "infill_pattern=lines wall_line_count=5 layer_height=0.12 z_seam_type=random"
  "wall_line_width_0=0.6 min_wall_line_width=50% path_order=nearest wipe=true coasting_enable=true retraction_combing=noskin"
  "scarf_joint_seam_length=10 xy_offset=-0.1 hole_xy_offset=0.05 brim_width=4 staggered_inner_seams=true"
)
models=("$root"/examples/*.stl)
corpus=${WEFT_CORPUS:-$root/../shared/corpus}
if [ -d "$corpus/models" ]; then models+=("$corpus"/models/*.stl); else echo "SKIPPED in part: no corpus at $corpus" >&2; fi

hash_of() { "$1" slice "$2" -q -o - "${@:3}" | sha256sum | cut -c1-64; }
failed=0 compared=0
for model in "${models[@]}"; do
  for variant in "${variants[@]}"; do
    options=()
    for setting in $variant; do options+=(-s "$setting"); done
    one=$(hash_of "$weft" "$model" "${options[@]}")
    two=$(hash_of "$other" "$model" "${options[@]}" -j 3)
    compared=$((compared + 1))
    if [ "$one" != "$two" ]; then
      echo "FAILED: $(basename "$model") $variant: $one, $two" >&2
      failed=1
    fi
  done
done
[ "$failed" = 1 ] || echo "ok: $compared G-code files are the same from both"
exit $failed
