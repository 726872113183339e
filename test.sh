#!/usr/bin/env bash
# Sets up what is missing, builds and runs the tests: the quick ones first, each program's cases in a few processes.
# Arguments go to ctest, which then runs each case in a process of its own: ./test.sh -R Sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

.ci/setup.sh tests
ctest=(ctest --test-dir build --output-on-failure -j "$(nproc)")
if [ $# -gt 0 ]; then
  exec "${ctest[@]}" "$@"
fi
results=build/Testing/cases
rm -rf "$results"
trap 'tests/runner/run_cases.py --summary "$results"' EXIT
"${ctest[@]}" -C shards -LE slow
"${ctest[@]}" -C shards -L slow --no-tests=ignore
