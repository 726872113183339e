# Installs BUILD to a folder of its own, then configures, builds and runs the consumer with what lies there.
# Arguments: BUILD, CONSUMER, WORK, GENERATOR, VIEWER.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
foreach(file share/man/man1/prelight.1 share/bash-completion/completions/prelight share/zsh/site-functions/_prelight
        share/fish/vendor_completions.d/prelight.fish share/doc/prelight/README.md
        share/doc/prelight/docs/PRELIGHT_transfer.schema.json)
  if(NOT EXISTS ${WORK}/prefix/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
file(GLOB_RECURSE compiler ${WORK}/prefix/*/prelight/prelight-compiler)
if(NOT compiler)
  message(FATAL_ERROR "not installed: prelight-compiler")
endif()
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
# From another place than it was installed to. PNG comes from a module.
file(RENAME ${WORK}/prefix ${WORK}/moved)
run(${WORK}/moved/bin/prelight --version)
run(${WORK}/moved/bin/prelight scene shapes -o ${WORK}/shapes.glb)
if(VIEWER)
  run(${WORK}/moved/bin/prelight render ${WORK}/shapes.glb -o ${WORK}/shapes.png --shading phong --size 16x9)
endif()
file(REMOVE_RECURSE ${WORK})
