# prelight_commit(TARGET): adds to it the one source that knows which commit is built. A new commit, which its log tells of,
# has that source written and compiled again, and nothing else.
function(prelight_commit target)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/commit.cpp)
  set(script ${PROJECT_SOURCE_DIR}/host/cmake/WriteCommit.cmake)
  set(log)
  find_package(Git QUIET)
  if(GIT_FOUND)
    execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --git-path logs/HEAD WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
      OUTPUT_VARIABLE log ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    cmake_path(ABSOLUTE_PATH log BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    if(NOT EXISTS ${log} OR IS_DIRECTORY ${log})
      set(log)
    endif()
  endif()
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${output} -P ${script}
    DEPENDS ${script} ${PROJECT_SOURCE_DIR}/packaging/commit ${log}
    COMMENT "Writing down the commit" VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
