# What WriteCommit.cmake makes of sources in a repository, of those of an archive and of those that came without a commit.
# Arguments: SCRIPT, WORK.
find_program(GIT git REQUIRED)
file(REMOVE_RECURSE ${WORK})

function(git)
  execute_process(COMMAND ${GIT} -C ${WORK}/repository -c user.name=A -c user.email=a@example.org ${ARGN}
    OUTPUT_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(output ${output} PARENT_SCOPE)
endfunction()

# expect(SOURCE COMMIT NAME): that these are what is written for SOURCE.
function(expect source commit name)
  execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${source} -DOUTPUT=${WORK}/commit.cpp -P ${SCRIPT}
    COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${WORK}/commit.cpp text)
  foreach(wanted "commit() { return \"${commit}\"; }" "commitName() { return \"${name}\"; }")
    string(FIND "${text}" "${wanted}" at)
    if(at EQUAL -1)
      message(FATAL_ERROR "of ${source}: expected ${wanted}, got ${text}")
    endif()
  endforeach()
endfunction()

file(WRITE ${WORK}/repository/packaging/commit "$Format:%H$\n")
file(WRITE ${WORK}/repository/.gitattributes "packaging/commit export-subst\n")
git(init -q)
git(add .)
git(commit -q -m first)
git(rev-parse HEAD)
set(first ${output})
string(SUBSTRING ${first} 0 12 short)
expect(${WORK}/repository ${first} ${short})

file(TIMESTAMP ${WORK}/commit.cpp before "%s%f")
execute_process(COMMAND ${CMAKE_COMMAND} -E sleep 0.05)
expect(${WORK}/repository ${first} ${short})
file(TIMESTAMP ${WORK}/commit.cpp after "%s%f")
if(NOT before STREQUAL after)
  message(FATAL_ERROR "the same commit was written again")
endif()

git(tag v1.0)
expect(${WORK}/repository ${first} v1.0)

git(archive --prefix=archived/ -o ${WORK}/archived.tar HEAD)
file(ARCHIVE_EXTRACT INPUT ${WORK}/archived.tar DESTINATION ${WORK})
expect(${WORK}/archived ${first} ${short})

# Within another repository, but none of its commits.
file(WRITE ${WORK}/repository/copy/packaging/commit "$Format:%H$\n")
expect(${WORK}/repository/copy unknown "unknown commit")
file(REMOVE_RECURSE ${WORK})
