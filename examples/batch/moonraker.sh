#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Hands each finished file of a batch to Moonraker (Mainsail, Fluidd):
#   MOONRAKER=http://voron.local:7125 weft batch orders.jsonl -p my.ini -o results --exec 'bash moonraker.sh'
# An order with "x-printer": "http://other.local:7125" goes there; MOONRAKER_PRINT=true queues it to be printed.
# MOONRAKER_KEY is only needed where the host is not among the trusted clients.
set -euo pipefail
[ "$WEFT_STATUS" = ok ] || exit 0
server=${WEFT_X_PRINTER:-${MOONRAKER:?the address of Moonraker}}
folder=$(dirname "$WEFT_NAME")
[ "$folder" = . ] && folder=
# Moonraker compares the checksum with what arrives: a file that was cut off is refused.
checksum=$(sha256sum "$WEFT_OUTPUT" | cut -d' ' -f1)
curl --silent --show-error --fail --max-time 300 --output /dev/null \
  --config <([ -z "${MOONRAKER_KEY:-}" ] || printf 'header = "X-Api-Key: %s"\n' "$MOONRAKER_KEY") \
  --form "file=@\"$WEFT_OUTPUT\";filename=\"$(basename "$WEFT_NAME")\"" --form root=gcodes --form "path=$folder" \
  --form "checksum=$checksum" --form "print=${MOONRAKER_PRINT:-false}" \
  "$server/server/files/upload"
