#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What takes too long for .ci/run, to be run before a capability is called done:  bash tests/thorough.sh
#   - every test under the address and undefined-behaviour sanitizers,
#   - the thread sanitizer over what runs on several threads,
#   - the same bytes from clang as from g++ (tests/jobs/compilers.sh),
#   - 3,000 mutated inputs of every kind through the program,
#   - each fuzzer for a minute (MINUTES=15 bash tests/thorough.sh: for as many).
# The closing lines say what of it passed; exit status: how many did not.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
minutes=${MINUTES:-1}
bash cmake/packages.sh clang libclang-rt-14-dev || exit 1
results=() failed=0
told() {  # what, status
  if [ "$2" -eq 0 ]; then results+=("passed  $1"); else results+=("FAILED  $1"); failed=$((failed + 1)); fi
}

bash tests/run.sh asan
told 'every test under the address and undefined-behaviour sanitizers' $?

threaded='^(tasks|batch:|jobs|job lists|pipeline|cache:|stop inside|small memory|shards|memory|sweep|thread sanitizer)'
cmake --preset tsan > /dev/null &&
  cmake --build --preset tsan --target weft_app test_tasks test_jobs test_pipeline test_app test_cli planted_race &&
  ctest --preset tsan --parallel "$(nproc)" -R "$threaded"
told "thread sanitizer: $threaded" $?

cmake --preset release > /dev/null && cmake --build --preset release --target weft_app && cmake --preset clang > /dev/null &&
  cmake --build --preset clang --target weft_app && bash tests/jobs/compilers.sh build/release/app/weft
told 'the same bytes from clang' $?

python3 tests/fuzz/hostile.py build/release/app/weft 3000 | tail -n 3
told '3,000 mutated inputs' "${PIPESTATUS[0]}"

cmake --preset fuzz > /dev/null && cmake --build --preset fuzz
told 'fuzzers built' $?
for seeds in tests/fuzz/seeds/*/; do
  name=$(basename "$seeds")
  fuzzer=build/fuzz/tests/fuzz_$name
  [ -x "$fuzzer" ] || continue
  mkdir -p "build/fuzz/corpus/$name"
  "$fuzzer" -max_total_time=$((60 * minutes)) -timeout=60 -rss_limit_mb=4096 -print_final_stats=1 \
    "build/fuzz/corpus/$name" "$seeds" 2>&1 | tail -n 4
  told "fuzz: $name, $minutes min" "${PIPESTATUS[0]}"
done

printf '%s\n' '' "${results[@]}"
echo "$((${#results[@]} - failed)) passed, $failed failed"
exit "$failed"
