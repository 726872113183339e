# cmake --install: the program with its modules, manual page, completions, icon and entry in menus; and the library with its
# headers and the files by which find_package(prelight CONFIG) finds them. A component each: `program` and `development`.
include(CMakePackageConfigHelpers)
set(PRELIGHT_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/prelight)
set(PRELIGHT_INSTALLED_MODULE_DIR ${CMAKE_INSTALL_LIBDIR}/prelight)
set(PRELIGHT_ZSH_DIR ${CMAKE_INSTALL_DATADIR}/zsh/site-functions CACHE STRING "Where the completion for zsh is installed")

# Programs find the modules, and a shared library, wherever the tree of the installation stands.
file(RELATIVE_PATH library_from_program /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
set(run_path $ORIGIN/${library_from_program}/prelight)
if(BUILD_SHARED_LIBS)
  list(APPEND run_path $ORIGIN/${library_from_program})
endif()
set(programs prelight_cli)
if(PRELIGHT_BENCHMARKS)
  list(APPEND programs prelight_bench)
endif()
set_target_properties(${programs} PROPERTIES INSTALL_RPATH "${run_path}")
set_target_properties(prelight PROPERTIES INSTALL_RPATH $ORIGIN/prelight)  # where it is a shared library

# What a build of some targets alone did not make is left out.
install(TARGETS ${programs} RUNTIME COMPONENT program OPTIONAL)
install(TARGETS prelight_images prelight_png prelight_draco
  LIBRARY DESTINATION ${PRELIGHT_INSTALLED_MODULE_DIR} COMPONENT program)
install(TARGETS prelight_compiler prelight_decoder RUNTIME DESTINATION ${PRELIGHT_INSTALLED_MODULE_DIR} COMPONENT program)
install(FILES ${PRELIGHT_PAGES}/prelight.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
install(FILES ${PRELIGHT_PAGES}/bash/prelight
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program OPTIONAL)
install(FILES ${PRELIGHT_PAGES}/zsh/_prelight DESTINATION ${PRELIGHT_ZSH_DIR} COMPONENT program OPTIONAL)
install(FILES ${PRELIGHT_PAGES}/fish/prelight.fish
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program OPTIONAL)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
if(PRELIGHT_VIEWER)
  install(FILES packaging/prelight.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT program)
  install(FILES packaging/prelight.svg
    DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT program)
endif()

install(TARGETS prelight EXPORT prelight-targets
  ARCHIVE COMPONENT development
  LIBRARY COMPONENT program NAMELINK_COMPONENT development)
install(DIRECTORY host/include/prelight DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.h")
install(EXPORT prelight-targets NAMESPACE prelight:: DESTINATION ${PRELIGHT_CONFIG_DIR} COMPONENT development)
if(PRELIGHT_VIEWER)  # draw() of prelight/draw.h, for who has what OpenGL takes
  set_target_properties(prelight_viewer PROPERTIES EXPORT_NAME viewer)
  set_target_properties(prelight_pictures PROPERTIES EXPORT_NAME pictures)
  install(TARGETS prelight_viewer prelight_pictures EXPORT prelight-pictures-targets ARCHIVE COMPONENT development)
  install(EXPORT prelight-pictures-targets NAMESPACE prelight:: DESTINATION ${PRELIGHT_CONFIG_DIR} COMPONENT development)
endif()

configure_package_config_file(host/cmake/PrelightConfig.cmake.in ${CMAKE_BINARY_DIR}/prelight-config.cmake
  INSTALL_DESTINATION ${PRELIGHT_CONFIG_DIR})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/prelight-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/prelight-config.cmake ${CMAKE_BINARY_DIR}/prelight-config-version.cmake
  DESTINATION ${PRELIGHT_CONFIG_DIR} COMPONENT development)
