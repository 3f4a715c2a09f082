#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the house asks of its sources, beyond what compilers see:  bash tests/house.sh
# No file above 500 lines, no function above 60 but those that tests/house.txt names with a reason, no marker of things
# left undone, a line of licence at the top of each file, a word on every header, and the layout of .clang-format.
# Needs universal-ctags and clang-format (bash cmake/packages.sh universal-ctags clang-format). Run by hand: it still finds
# lines of licence and functions to mend. Exit status: the number of kinds of faults.
set -uo pipefail
shopt -s lastpipe  # what `tell` counts at the end of a pipe counts here
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mapfile -t sources < <(git ls-files '*.cpp' '*.h')
mapfile -t ours < <(git ls-files 'lib/*.cpp' 'lib/*.h' 'app/*.cpp' 'app/*.h')
kinds=0
tell() {  # what, the faults on standard input
  local faults
  faults=$(cat)
  [ -n "$faults" ] || return 0
  kinds=$((kinds + 1))
  printf '%s:\n%s\n' "$1" "$faults" | sed '2,$s/^/  /' >&2
}

wc -l "${ours[@]}" | awk '$2 != "total" && $1 > 500 { print $2 ": " $1 }' | tell 'files above 500 lines'

functions() {  # FILE NAME LINES of those above 60
  ctags -x --language-force=C++ --kinds-C++=f --fields=+ne --_xformat='%{end} %{line} %{input} %{name}' "${ours[@]}" |
    awk '$1 - $2 + 1 > 60 { print $3, $4, $1 - $2 + 1 }'
}
long=$(functions)
allowed=$(grep -v '^#' tests/house.txt | awk 'NF > 2 { print $1, $2 }')
awk 'NR == FNR { allowed[$0] = 1; next } NF && !(($1 " " $2) in allowed)' <(echo "$allowed") <(echo "$long") |
  tell 'functions above 60 lines that tests/house.txt does not name'
awk 'NR == FNR { long[$1 " " $2] = 1; next } NF && !($0 in long)' <(echo "$long") <(echo "$allowed") |
  tell 'tests/house.txt names what is no longer above 60 lines'

marker='TO''DO|FIX''ME|X''XX|HA''CK'  # in pieces, so that this line is none
git grep -nIE "\b($marker)\b" -- lib app tests examples profiles | tell 'markers'

for file in "${sources[@]}" $(git ls-files '*.sh' '*.py' '*.cmake' '*CMakeLists.txt' .ci/run); do
  head -n 3 "$file" | grep -q 'SPDX-License-Identifier: GPL-3.0-or-later' || echo "$file"
done | tell 'files without a line of licence'

for file in "${ours[@]}"; do
  case $file in *.h) grep -q '^ *///' "$file" || echo "$file" ;; esac
done | tell 'headers without a word on what is in them'

clang-format --dry-run -Werror "${sources[@]}" 2>&1 | grep -oE '^[^ :]+:[0-9]+' | sort -t: -k1,1 -u |
  tell 'files that are not laid out as .clang-format says'

[ "$kinds" -eq 0 ] && echo "house: ${#sources[@]} files, nothing to mend"
exit "$kinds"
