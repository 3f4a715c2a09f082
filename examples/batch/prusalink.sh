#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Hands each finished file of a batch to PrusaLink (MK4, XL, MINI and others):
#   PRUSALINK=http://192.168.1.20 PRUSALINK_KEY=... weft batch orders.jsonl -p prusa-mk4 -o results --exec 'bash prusalink.sh'
# An order with "x-printer": "http://192.168.1.21" goes there; PRUSALINK_PRINT=1 starts it when the printer is ready.
set -euo pipefail
[ "$WEFT_STATUS" = ok ] || exit 0
server=${WEFT_X_PRINTER:-${PRUSALINK:?the address of the printer}}
# Names on the stick are plain: what else there is in them is escaped as in any address.
escaped() {
  local LC_ALL=C text=$1 i c
  for ((i = 0; i < ${#text}; i++)); do
    c=${text:i:1}
    case $c in [a-zA-Z0-9._~/-]) printf %s "$c" ;; *) printf '%%%02X' "'$c" ;; esac
  done
}
curl --silent --show-error --fail --max-time 600 --output /dev/null \
  --config <(printf 'header = "X-Api-Key: %s"\n' "${PRUSALINK_KEY:?the key on the printer: Settings, Network, PrusaLink}") \
  --header "Content-Type: text/x.gcode" --header "Overwrite: ?1" --header "Print-After-Upload: ?${PRUSALINK_PRINT:-0}" \
  --upload-file "$WEFT_OUTPUT" "$server/api/v1/files/${PRUSALINK_STORAGE:-usb}/$(escaped "$WEFT_NAME")"
