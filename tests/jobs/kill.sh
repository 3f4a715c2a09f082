#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# weft batch under hard conditions:  bash tests/jobs/kill.sh WEFT [SEED]
# Killed at 20 seeded moments and resumed; two processes on one cache; a full disk; damaged cache entries. What there is at the
# end must be, byte for byte, what an undisturbed run makes. The full disk takes root (a small tmpfs), else that part is skipped.
set -euo pipefail
weft=$(realpath "$1")
RANDOM=${2:-7}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$(mktemp -d)
cleanup() {
  mountpoint -q "$scratch/small" 2> /dev/null && umount "$scratch/small"
  rm -rf "$scratch"
}
trap cleanup EXIT
cd "$scratch"
failed=0
expect() { if [ "$2" = "$3" ]; then echo "ok: $1"; else echo "FAILED: $1: $2, wanted $3" >&2; failed=1; fi; }
same() { # FOLDER: files of it that are not the reference's, and files of the reference that it has not
  local n=0 file
  for file in reference/*.gcode; do cmp -s "$file" "$1/$(basename "$file")" || n=$((n + 1)); done
  echo "$n"
}

for i in $(seq 16); do
  model=box; [ $((i % 4)) -ne 0 ] || model=calibration-tower
  echo "{\"id\": \"j$i\", \"models\": [\"$root/examples/$model.stl\"], \"set\": {\"layer_height\": 0.2, \"infill_sparse_density\": $((5 * i))}}"
done > jobs.jsonl
begin=$(date +%s%N)
"$weft" batch jobs.jsonl -o reference -q
took_ms=$((($(date +%s%N) - begin) / 1000000))
echo "an undisturbed run takes $took_ms ms"

spoiled=0 unfinished=0 debris=0 killed=0
for moment in $(seq 20); do
  rm -rf out
  "$weft" batch jobs.jsonl -o out --cache cache -q &
  process=$!
  sleep "$(awk -v r=$RANDOM -v t="$took_ms" 'BEGIN { printf "%.3f", 0.6 * t / 1000 * r / 32768 }')"
  kill -9 $process 2> /dev/null && killed=$((killed + 1)) || true
  wait $process 2> /dev/null || true
  for file in out/*.gcode; do
    [ ! -e "$file" ] || cmp -s "$file" "reference/$(basename "$file")" || spoiled=$((spoiled + 1)) # never half a file
  done
  "$weft" batch jobs.jsonl -o out --cache cache --resume -q || unfinished=$((unfinished + 1))
  unfinished=$((unfinished + $(same out)))
  debris=$((debris + $(find out -name '*.weft-??????' | wc -l)))
done
echo "killed $killed of 20 before their end"
expect "killed at 20 moments, no file was ever half there" "$spoiled" 0
expect "each time the rest was made, and all is as undisturbed" "$unfinished" 0
expect "nothing half written is left" "$debris" 0

rm -rf out cache one two
"$weft" batch jobs.jsonl -o one --cache cache -q &
first=$!
"$weft" batch jobs.jsonl -o two --cache cache -q
wait $first
expect "two processes on one cache" "$(($(same one) + $(same two)))" 0

n=0
for entry in cache/??/*; do
  n=$((n + 1))
  case $((n % 3)) in
    0) printf 'X' | dd of="$entry" bs=1 seek=$(($(stat -c %s "$entry") / 2)) conv=notrunc status=none ;;
    1) truncate -s -7 "$entry" ;;
    2) : > "$entry" ;;
  esac
done
"$weft" batch jobs.jsonl -o three --cache cache -q --report three.json
expect "with $n damaged cache entries" "$(same three)" 0
grep -q '"damaged": 0' three.json && { echo "FAILED: no damage was seen" >&2; failed=1; }
grep -o '"damaged": [0-9]*' three.json

if [ "$(id -u)" -eq 0 ] && mkdir small && mount -t tmpfs -o size=1m tmpfs small 2> /dev/null; then
  status=0
  "$weft" batch jobs.jsonl -o small/out -q || status=$?
  [ $status -eq 7 ] || [ $status -eq 6 ] || status=wrong # 6: the report itself found no room
  expect "a full disk fails the run" "${status/7/6}" 6
  spoiled=0
  for file in small/out/*.gcode; do [ ! -e "$file" ] || cmp -s "$file" "reference/$(basename "$file")" || spoiled=$((spoiled + 1)); done
  expect "on a full disk no file is half there" "$spoiled" 0
  echo "on the full disk: $(find small/out -name '*.gcode' | wc -l) of 16 had room"
  mount -o remount,size=100m small
  "$weft" batch jobs.jsonl -o small/out --resume -q
  expect "with room again the rest is made" "$(same small/out)" 0
  rm -rf small/out
  mount -o remount,size=200k small
  "$weft" batch jobs.jsonl -o four --cache small/cache -q --report four.json
  expect "a full disk below the cache costs nothing but speed" "$(same four)" 0
  grep -o '"unwritten": [0-9]*' four.json
else
  echo "SKIPPED: a full disk takes root and a tmpfs" >&2
fi
exit $failed
