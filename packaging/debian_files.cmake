# Run by cpack between installing and packing: adds what Debian wants to find in every package, and compresses what it wants
# compressed.
file(GLOB trees LIST_DIRECTORIES true ${CPACK_TEMPORARY_DIRECTORY}/*)
string(TIMESTAMP day "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH's, where it is set
foreach(tree ${trees})
  if(tree MATCHES "development$")
    set(package libprelight-dev)
  else()
    set(package prelight)
  endif()
  set(documents ${tree}/usr/share/doc/${package})
  file(MAKE_DIRECTORY ${documents})
  file(COPY_FILE ${CMAKE_CURRENT_LIST_DIR}/copyright ${documents}/copyright)
  file(WRITE ${documents}/changelog
    "prelight (${CPACK_PACKAGE_VERSION}) bookworm; urgency=medium\n\n  * Built from the commit that prelight --version names.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${day}\n")
  file(GLOB compressed ${documents}/changelog ${tree}/usr/share/man/man1/*.1)
  execute_process(COMMAND gzip -9nf ${compressed} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
