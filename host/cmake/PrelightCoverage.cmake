# prelight_coverage(TARGET): with PRELIGHT_COVERAGE, counters in its objects that gcov reads, and in whatever links it what
# they need. The tests themselves carry none: what they execute of themselves tells nothing.
function(prelight_coverage target)
  if(PRELIGHT_COVERAGE)
    target_compile_options(${target} PRIVATE --coverage -O1)
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()
