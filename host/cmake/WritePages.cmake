# Has PROGRAM write its manual page and completions, under the names that they are installed by, into FOLDER.
function(write file)
  execute_process(COMMAND ${PROGRAM} help ${ARGN} OUTPUT_FILE ${FOLDER}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(MAKE_DIRECTORY ${FOLDER}/bash ${FOLDER}/zsh ${FOLDER}/fish)
write(bash/prelight --completion bash)
write(zsh/_prelight --completion zsh)
write(fish/prelight.fish --completion fish)
write(prelight.1 --man)
