#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A list over machines that are reached by ssh, and have weft and a common folder:
#   bash gnu-parallel.sh orders.jsonl results node1 node2 node3
# GNU parallel (Debian: parallel) gives each share to the next free machine and tries one that failed to answer once more.
set -euo pipefail
jobs=$(realpath "${1:?usage: gnu-parallel.sh JOBS DIR HOST...}")
folder=$(realpath -m "${2:?usage: gnu-parallel.sh JOBS DIR HOST...}")
shift 2
shares=$((4 * $#))  # more shares than machines: none waits long for the slowest
status=0
parallel --sshlogin "$(IFS=,; echo "$*")" --jobs 1 --retries 2 --tag \
  "${WEFT:-weft} batch '$jobs' -o '$folder' --shard {}/$shares --cache '$folder/.cache'; s=\$?; [ \$s -eq 7 ] && exit 0; exit \$s" \
  ::: $(seq "$shares") || status=$?
"${WEFT:-weft}" batch "$jobs" -o "$folder" --collect || status=$?
exit "$status"
