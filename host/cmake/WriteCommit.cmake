# Writes OUTPUT: the C++ of host/cli/commit.h, with the commit of the sources in SOURCE. A file that would not change is
# left as it is, so that nothing is compiled again.
set(commit unknown)
set(name "unknown commit")
file(STRINGS ${SOURCE}/packaging/commit archived LIMIT_COUNT 1)  # `git archive` fills it in
if(archived MATCHES "^[0-9a-f]+$")
  set(commit ${archived})
  string(SUBSTRING ${archived} 0 12 name)
else()
  find_program(GIT git)
  if(GIT)
    # Sources that were unpacked within some other repository are none of its commits: there the prefix is not empty.
    execute_process(COMMAND ${GIT} rev-parse --show-prefix HEAD WORKING_DIRECTORY ${SOURCE}
      OUTPUT_VARIABLE head RESULT_VARIABLE failed ERROR_QUIET)
    if(NOT failed AND head MATCHES "^\n([0-9a-f]+)\n$")
      set(commit ${CMAKE_MATCH_1})
      execute_process(COMMAND ${GIT} describe --tags --always --abbrev=12 WORKING_DIRECTORY ${SOURCE}
        OUTPUT_VARIABLE name ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    endif()
  endif()
endif()
set(text "#include \"cli/commit.h\"

namespace prelight::cli {

const char* commit() { return \"${commit}\"; }
const char* commitName() { return \"${name}\"; }

}  // namespace prelight::cli
")
set(before)
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT before STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
