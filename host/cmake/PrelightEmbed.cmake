# prelight_embed_texts(OUTPUT file NAME function HEADER header COMMENT text ROOTS folder... FILES file...): OUTPUT becomes a C++
# source, a table of the files' texts (EmbedTexts.cmake), written where the caller uses it.
set(PRELIGHT_EMBED_TEXTS ${CMAKE_CURRENT_LIST_DIR}/EmbedTexts.cmake)
function(prelight_embed_texts)
  cmake_parse_arguments(PARSE_ARGV 0 EMBED "" "OUTPUT;NAME;HEADER;COMMENT" "ROOTS;FILES")
  add_custom_command(OUTPUT ${EMBED_OUTPUT}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${EMBED_OUTPUT} -DNAME=${EMBED_NAME} -DHEADER=${EMBED_HEADER} "-DROOT=${EMBED_ROOTS}"
            "-DFILES=${EMBED_FILES}" -P ${PRELIGHT_EMBED_TEXTS}
    DEPENDS ${EMBED_FILES} ${PRELIGHT_EMBED_TEXTS}
    COMMENT "${EMBED_COMMENT}" VERBATIM)
endfunction()
