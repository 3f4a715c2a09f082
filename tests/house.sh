#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the house asks of its sources, beyond what compilers see:  bash tests/house.sh
# No file above 500 lines, no function above 60 but those that tests/house.txt names with a reason, no marker of things
# left undone, a line of licence at the top of each file, a word on every header, the layout of .clang-format,
# no row of settings that nothing reads, no test that ctest cannot find, and no room of lib/ that its tour
# (lib/README.md) passes by.
# Needs universal-ctags and clang-format (bash cmake/packages.sh universal-ctags clang-format). Exit status: the number of
# kinds of faults; 127: it could not look.
set -uo pipefail
shopt -s lastpipe  # what `tell` counts at the end of a pipe counts here
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if git ls-files --error-unmatch tests/house.sh > /dev/null 2>&1; then
  all=$(git ls-files)
else  # sources without a checkout
  all=$(find . -name 'build*' -prune -o -type f -print | sed 's,^\./,,' | LC_ALL=C sort)
fi
mapfile -t sources < <(grep -E '\.(cpp|h)$' <<< "$all")
mapfile -t ours < <(grep -E '^(lib|app)/.*\.(cpp|h)$' <<< "$all")
mapfile -t scripts < <(grep -E '\.(sh|py|cmake)$|CMakeLists\.txt$|^\.ci/run$' <<< "$all")
mapfile -t read < <(grep -E '^(lib|app|tests|examples|profiles)/' <<< "$all")
for tool in ctags clang-format; do
  command -v "$tool" > /dev/null && continue
  echo "house: no $tool: bash cmake/packages.sh universal-ctags clang-format" >&2
  exit 127
done
[ "${#ours[@]}" -gt 100 ] || { echo "house: no sources" >&2; exit 127; }
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

# A list of CMake's ends at a semicolon: ctest would ask for half of the name, find no such test, and say that it passed.
mapfile -t tests < <(grep -E '^tests/.*_test\.cpp$' <<< "$all")
awk 'FNR == 1 { in_name = 0 } /^TEST_CASE\(/ { in_name = 1 } in_name && /"[^"]*;[^"]*"/ { print FILENAME ":" FNR } /\{$/ { in_name = 0 }' \
  "${tests[@]}" | tell 'names of tests with a semicolon'

# A row of settings promises an effect: its field is read somewhere outside the rows, profiles and the import.
readers=$(grep -E '^(lib|app)/.*\.(cpp|h)$' <<< "$all" | grep -vE '^lib/(profile|prusaslicer)/')
rows=$(grep -ohE '&[A-Za-z]+Settings::[a-z0-9_]+' lib/settings/groups/*.h | sed 's/.*:://' | LC_ALL=C sort -u)
mapfile -t readers <<< "$readers"
groups='&[A-Za-z]+Settings::[a-z0-9_]+,'  # the rows themselves
used=$(awk -v rows="$groups" 'FILENAME ~ /settings.groups/ { gsub(rows, "") } 1' "${readers[@]}" | grep -oE '(\.|->|::)[a-z0-9_]+' | sed -E 's/^(\.|->|::)//' | LC_ALL=C sort -u)
idle=$(LC_ALL=C comm -23 <(echo "$rows") <(echo "$used"))
waiting=$(grep -v '^#' tests/settings_without_effect.txt | awk 'NF > 1 { print $1 }' | LC_ALL=C sort)
[ "$(wc -l <<< "$rows")" -gt 300 ] || { echo "house: no rows of settings" >&2; exit 127; }
LC_ALL=C comm -23 <(echo "$idle") <(echo "$waiting") |
  tell 'settings that nothing reads and tests/settings_without_effect.txt does not name'
LC_ALL=C comm -13 <(echo "$idle") <(echo "$waiting") | grep . |
  tell 'tests/settings_without_effect.txt names what is read by now'

for room in $(grep -oE '^lib/[a-z_]+/' <<< "$all" | sort -u); do
  grep -qF "\`${room#lib/}" lib/README.md || echo "$room"
done | tell 'folders that the tour of lib/README.md passes by'

marker='TO''DO|FIX''ME|X''XX|HA''CK'  # in pieces, so that this line is none
grep -nHIE "\b($marker)\b" "${read[@]}" | tell 'markers'

for file in "${sources[@]}" "${scripts[@]}"; do
  head -n 3 "$file" | grep -q 'SPDX-License-Identifier: GPL-3.0-or-later' || echo "$file"
done | tell 'files without a line of licence'

for file in "${ours[@]}"; do
  case $file in *.h) grep -q '^ *///' "$file" || echo "$file" ;; esac
done | tell 'headers without a word on what is in them'

clang-format --dry-run -Werror "${sources[@]}" 2>&1 | grep -oE '^[^ :]+:[0-9]+' | sort -t: -k1,1 -u |
  tell 'files that are not laid out as .clang-format says'

[ "$kinds" -eq 0 ] && echo "house: ${#sources[@]} files, nothing to mend"
exit "$kinds"
