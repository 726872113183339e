#!/bin/sh
# oclgrind.sh OCLGRIND PROGRAM FILTER: runs tests under Oclgrind and fails when one does, when it reports an access out of
# bounds or a data race, or when the filter matches none. It crashes when a process ends that still holds a device, so that
# its words decide.
log=$("$1" --data-races "$2" --gtest_filter="$3" 2>&1)
echo "$log"
echo "$log" | grep -q '\[  PASSED  \] [1-9]' && ! echo "$log" | grep -Eq 'Invalid (read|write)|data race|FATAL ERROR|\[  FAILED  \]'
