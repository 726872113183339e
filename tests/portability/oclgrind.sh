#!/bin/sh
# oclgrind.sh OCLGRIND PROGRAM FILTER runs tests under Oclgrind. It fails when a test fails, or when Oclgrind reports an access
# out of bounds or a data race. Oclgrind crashes when a process ends that still holds a device, so that its output decides and not
# its exit code.
log=$("$1" --data-races "$2" --gtest_filter="$3" 2>&1)
echo "$log"
echo "$log" | grep -q '\[  PASSED  \]' && ! echo "$log" | grep -Eq 'Invalid (read|write)|data race|FATAL ERROR|\[  FAILED  \]'
