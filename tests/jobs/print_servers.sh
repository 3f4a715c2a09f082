#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The recipes of examples/batch that upload, against stand-ins for the servers:  bash tests/jobs/print_servers.sh WEFT
# Status 77: skipped, python3 or curl is not there.
set -euo pipefail
weft=$(realpath "$1")
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
for program in python3 curl; do
  command -v $program > /dev/null || { echo "SKIPPED: no $program; apt-get install $program" >&2; exit 77; }
done
scratch=$(mktemp -d)
python3 "$root/tests/jobs/print_servers.py" "$scratch/taken" > "$scratch/port" &
server=$!
trap 'kill $server 2> /dev/null; rm -rf "$scratch"' EXIT
for _ in $(seq 100); do [ -s "$scratch/port" ] && break; sleep 0.1; done
address=http://127.0.0.1:$(cat "$scratch/port")
no_proxy=127.0.0.1
export no_proxy NO_PROXY=127.0.0.1

cd "$scratch"
cp "$root/examples/box.stl" box.stl
cat > orders.jsonl << 'END'
{"id": "first", "models": ["box.stl"]}
{"id": "größe 2 & more", "models": ["box.stl"], "output": "shelf/größe 2 & more.gcode"}
{"id": "busy", "models": ["box.stl"], "set": {"layer_height": 0.25}}
{"id": "outside", "models": ["box.stl"], "center": [900, 900]}
END
failed=0
expect() { # NAME ACTUAL WANTED
  if [ "$2" = "$3" ]; then echo "ok: $1"; else echo "FAILED: $1: $2, wanted $3" >&2; failed=1; fi
}
upload() { # RECIPE FOLDER OPTION...
  local recipe=$1 out=$2 status=0
  shift 2
  "$weft" batch orders.jsonl -o "$out" --exec "bash $root/examples/batch/$recipe.sh" "$@" 2> "$out.log" || status=$?
  echo $status
}
export OCTOPRINT=$address MOONRAKER=$address PRUSALINK=$address OCTOPRINT_KEY=right-key PRUSALINK_KEY=right-key
for recipe in octoprint moonraker prusalink; do
  expect "$recipe: only the order that cannot be printed fails" "$(upload $recipe out-$recipe)" 7
  for file in first.gcode "shelf/größe 2 & more.gcode" busy.gcode; do
    expect "$recipe: $file has arrived whole" "$(cmp "out-$recipe/$file" "taken/$recipe/$file" 2>&1 && echo same)" same
  done
  expect "$recipe: nothing else has" "$(find taken/$recipe -type f | wc -l)" 3
  expect "$recipe: the busy one was tried twice" "$(grep -c '"id":"busy".*"exec":{"status":0,"attempts":2}' out-$recipe/report.jsonl)" 1
  rm -r taken/$recipe
  expect "$recipe: what was handed over is not again" "$(upload $recipe out-$recipe; find taken -type f | wc -l)" "7
0"
done
sed -i '$d' orders.jsonl
OCTOPRINT_KEY=wrong-key
expect "a key that is refused is a failure, and said" "$(upload octoprint out-wrong --exec-retries 0)" 7
expect "of each job" "$(grep -c 'exec_failed' <(cat out-wrong.log; grep -o '"exec":{"status":[1-9][0-9]*' out-wrong/report.jsonl | sed 's/.*/exec_failed/'))" 3
OCTOPRINT_KEY=right-key
expect "and is made good by the next run, without slicing" "$(upload octoprint out-wrong)" 0
expect "the files are there then" "$(find taken/octoprint -type f | wc -l)" 3
[ $failed = 0 ] || tail -n 5 out-*.log >&2
exit $failed
