#!/usr/bin/env bash
# Sets up what is missing, builds and runs the tests: the quick ones first, each program's cases in a few processes.
#
#   ./test.sh          the quick and the slow ones
#   ./test.sh --all    the long ones, too: whole benchmarks, what the papers show, stress, soaking
#   ./test.sh -R Sh    other arguments go to ctest, which then runs each case in a process of its own
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

.ci/setup.sh tests
ctest=(ctest --test-dir build --output-on-failure -j "$(nproc)")
rounds=(slow)
if [ "$*" = --all ]; then
  rounds+=(long)
elif [ $# -gt 0 ]; then
  exec "${ctest[@]}" "$@"
fi
results=build/Testing/cases
rm -rf "$results"
trap 'tests/runner/run_cases.py --summary "$results"' EXIT
"${ctest[@]}" -C shards -LE 'slow|long'
for round in "${rounds[@]}"; do
  "${ctest[@]}" -C shards -L "$round" --no-tests=ignore
done
