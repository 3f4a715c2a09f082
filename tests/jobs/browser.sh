#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The page of weft sweep in a real browser:  bash tests/jobs/browser.sh WEFT [SCREENSHOT.png]
# Looks at what its script has built, with the network cut off. Status 77: skipped, no chromium (Debian: apt-get install chromium).
set -euo pipefail
weft=$(realpath "$1")
picture=${2:-}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
if [ -z "$chromium" ]; then
  echo "SKIPPED: no chromium; apt-get install --no-install-recommends chromium" >&2
  exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$weft" sweep "$root/examples/bracket.stl" --vary infill_sparse_density=10:50:20 --vary infill_pattern=grid,gyroid --layer-height 0.3 -q -o "$scratch/out"
page=$scratch/out/index.html
browse() { # FRAGMENT OPTION...
  local fragment=$1
  shift
  "$chromium" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$scratch/profile" --virtual-time-budget=3000 \
    --host-resolver-rules='MAP * ~NOTFOUND' --window-size=1400,1500 "$@" "file://$page$fragment" 2> "$scratch/browser.log"
}
failed=0
expect() { # NAME ACTUAL WANTED
  if [ "$2" = "$3" ]; then echo "ok: $1"; else echo "FAILED: $1: $2, wanted $3" >&2; failed=1; fi
}
count() { { grep -o "$2" <<< "$1" || true; } | wc -l; }

dom=$(browse '' --dump-dom)
expect "the script ran to its end" "$(count "$dom" 'data-ready="6"')" 1
expect "no error was thrown" "$(count "$dom" 'data-error=')" 0
expect "six rows" "$(count "$dom" '<tr data-id=')" 6
expect "six pictures" "$(count "$dom" '<img src="data:image/png;base64,')" 6
expect "six points in the scatter" "$(count "$dom" '<circle class="dot"')" 6
expect "six lines in the parallel coordinates" "$(count "$dom" '<polyline points=[^>]*stroke=')" 6
expect "six pages of toolpaths are led to" "$(count "$dom" 'class="viewer"')" 6
[ "$(find "$scratch/out" -name '*.gcode.html' | wc -l)" = 6 ] || { echo "FAILED: not every trial has its page" >&2; failed=1; }
expect "six axes" "$(count "$dom" 'class="axis"')" 6
[ "$(count "$dom" 'class="best"')" -ge 1 ] || { echo "FAILED: nothing is on the front" >&2; failed=1; }

sorted=$(browse '#sort=time&down=1' --dump-dom)
times=$(grep -o ' data-time="[0-9.]*"' <<< "$sorted" | tr -dc '0-9.\n')
expect "six times" "$(wc -l <<< "$times")" 6
expect "sorted by time, longest first" "$(sort -rn <<< "$times")" "$times"
kept=$(browse '#keep=infill_sparse_density~20~60' --dump-dom)
expect "a range on an axis keeps what lies in it" "$(count "$kept" 'data-kept="4"')" 1
expect "the rest fades in the table" "$(count "$kept" '<tr data-id="[^"]*" data-time="[^"]*" class="[^"]*out"')" 2
# The dashed front is of the two figures shown: nothing else in the sweep is better in both.
if command -v python3 > /dev/null; then
  for axes in 'time&y=material%20g' 'material%20g&y=strength' 'time&y=strength'; do
    shown=$(browse "#x=$axes" --dump-dom)
    printf '%s' "$shown" > "$scratch/dom.html"
    verdict=$(python3 -c '
import html, json, re, sys
dom = open(sys.argv[1]).read()
data = json.loads(re.search(r"id=\"data\">(\{.*?\})</script>", dom, re.S).group(1))
shown = html.unescape(re.search(r"data-trials=\"([^\"]*)\"", dom).group(1)).split("|")
x, y = sys.argv[2].replace("%20", " ").split("&y=")
of = {"time": lambda t: -t["time_s"], "material g": lambda t: -t["material_g"], "strength": lambda t: t["strength"]}
a, b = of[x], of[y]
trials = [t for t in data["trials"] if t["ok"]]
best = [t["id"] for t in trials if not any(a(o) >= a(t) and b(o) >= b(t) and (a(o) > a(t) or b(o) > b(t)) for o in trials)]
print("same" if sorted(best) == sorted(shown) else f"{sorted(shown)} wanted {sorted(best)}")' "$scratch/dom.html" "$axes")
    expect "the front of $axes" "$verdict" same
  done
fi
# An axis whose trials all have one value says it once.
once=$(browse '#x=layers&y=layers' --dump-dom)
expect "one value is one label on either axis" "$(grep -oE '<svg id="scatter".*' <<< "$once" | sed 's,</svg>.*,,' | grep -o 'class="grid"' | wc -l)" 2
expect "numbers stand under headings on the same side" "$(count "$dom" '<th class="n">time')" 1
[ -z "$picture" ] || browse '#x=time&y=strength&c=infill_sparse_density' --screenshot="$picture" > /dev/null
exit $failed
