#!/usr/bin/env bash
# Sets up what is missing, builds and runs the tests: the quick ones first. Arguments go to ctest.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

.ci/setup.sh tests
ctest=(ctest --test-dir build --output-on-failure -j "$(nproc)")
if [ $# -gt 0 ]; then
  exec "${ctest[@]}" "$@"
fi
"${ctest[@]}" -LE slow
exec "${ctest[@]}" -L slow --no-tests=ignore
