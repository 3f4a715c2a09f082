#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Hands each finished file of a batch to OctoPrint:
#   OCTOPRINT=http://octopi.local OCTOPRINT_KEY=... weft batch orders.jsonl -p my.ini -o results --exec 'bash octoprint.sh'
# An order with "x-printer": "http://other.local" goes there; OCTOPRINT_PRINT=true starts it at once.
# weft says in the environment what became of the job; a status other than 0 has it tried again (--exec-retries).
set -euo pipefail
[ "$WEFT_STATUS" = ok ] || exit 0 # nothing to upload: the report says why
server=${WEFT_X_PRINTER:-${OCTOPRINT:?the address of OctoPrint}}
# The file's path in the results is its path in OctoPrint's storage.
folder=$(dirname "$WEFT_NAME")
[ "$folder" = . ] && folder=
# --fail: an answer of 4xx or 5xx is a failure. The key goes through a file descriptor: arguments can be seen by others.
curl --silent --show-error --fail --max-time 300 --output /dev/null \
  --config <(printf 'header = "X-Api-Key: %s"\n' "${OCTOPRINT_KEY:?the key of an application of OctoPrint}") \
  --form "file=@\"$WEFT_OUTPUT\";filename=\"$(basename "$WEFT_NAME")\"" --form "path=$folder" --form "print=${OCTOPRINT_PRINT:-false}" \
  "$server/api/files/local"
