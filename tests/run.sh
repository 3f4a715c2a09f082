#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds weft and runs every test:  bash tests/run.sh [PRESET] [CTEST OPTION]...
# PRESET is one of CMakePresets.json: release (default), dev, asan, tsan.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}
shift || true

bash cmake/packages.sh
cmake --preset "$preset" > /dev/null
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)" "$@"
