set(PRELIGHT_COVERAGE_ROOMS "" CACHE STRING "Rooms of host/ whose lines are counted, such as io;scene/gltf; empty: all")

# prelight_coverage(TARGET): with PRELIGHT_COVERAGE, counters in its objects that gcov reads, and in whatever links it what
# they need. The tests themselves carry none: what they execute of themselves tells nothing.
function(prelight_coverage target)
  if(PRELIGHT_COVERAGE)
    target_link_options(${target} PUBLIC --coverage)
    if(PRELIGHT_COVERAGE_ROOMS)
      # Once all rooms have added their sources. What is deferred sees variables as they are then: the name goes in now.
      cmake_language(EVAL CODE "cmake_language(DEFER CALL prelight_count_rooms ${target})")
    else()
      target_compile_options(${target} PRIVATE --coverage -O1)
    endif()
  endif()
endfunction()

function(prelight_count_rooms target)
  get_target_property(sources ${target} SOURCES)
  foreach(room ${PRELIGHT_COVERAGE_ROOMS})
    set(counted ${sources})
    list(FILTER counted INCLUDE REGEX "/host/${room}/[^/]+$")
    if(counted)
      set_property(SOURCE ${counted} TARGET_DIRECTORY ${target} APPEND PROPERTY COMPILE_OPTIONS --coverage -O0)
    endif()
  endforeach()
endfunction()
