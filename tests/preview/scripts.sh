#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The scripts of the pages:  bash tests/preview/scripts.sh
# Each file alone must be JavaScript, and all of them together, as a page has them; and none may make scripts of text or
# ask the network. (Debian 12's ESLint, 6.4, does not read the JavaScript of 2020.) Status 77: skipped, no node.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
node=$(command -v node || command -v nodejs || true)
[ -n "$node" ] || { echo "SKIPPED: no node; apt-get install --no-install-recommends nodejs" >&2; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
viewer=(unpack colours camera beads flat plots panel viewer)
for name in "${viewer[@]}"; do cat "lib/preview/page/$name.js"; done > "$scratch/page.js"
for file in lib/preview/page/*.js lib/jobs/page/*.js "$scratch/page.js"; do "$node" --check "$file"; done
# What the page is made of is what stands in its folder.
listed=$(printf '%s.js\n' "${viewer[@]}" | sort)
[ "$listed" = "$(cd lib/preview/page && ls ./*.js | sed 's,^\./,,' | sort)" ] || { echo "lib/preview/page holds other scripts than the page" >&2; exit 1; }
grep -nE '\b(eval|innerHTML|outerHTML|insertAdjacentHTML|document\.write|XMLHttpRequest|fetch|WebSocket)\b' lib/preview/page/*.js lib/jobs/page/*.js &&
  { echo "a page runs no text and asks nobody" >&2; exit 1; }
echo "scripts: $(cat lib/preview/page/*.js lib/jobs/page/*.js | wc -l) lines"
