# cmake --install: the program, the library with its headers, and the files by which find_package(prelight CONFIG)
# finds them.
include(CMakePackageConfigHelpers)
set(PRELIGHT_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/prelight)

file(RELATIVE_PATH library_from_program /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
set_target_properties(prelight_cli PROPERTIES INSTALL_RPATH $ORIGIN/${library_from_program})
set_target_properties(prelight PROPERTIES INSTALL_RPATH $ORIGIN)  # where it is a shared library
install(TARGETS prelight_cli RUNTIME)
if(PRELIGHT_BENCHMARKS)
  set_target_properties(prelight_bench PROPERTIES INSTALL_RPATH $ORIGIN/${library_from_program})
  install(TARGETS prelight_bench RUNTIME OPTIONAL)
endif()
install(TARGETS prelight EXPORT prelight-targets)
install(TARGETS prelight_images prelight_draco LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})

install(DIRECTORY host/include/prelight DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")

install(EXPORT prelight-targets NAMESPACE prelight:: DESTINATION ${PRELIGHT_CONFIG_DIR})

configure_package_config_file(host/cmake/PrelightConfig.cmake.in ${CMAKE_BINARY_DIR}/prelight-config.cmake
  INSTALL_DESTINATION ${PRELIGHT_CONFIG_DIR})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/prelight-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/prelight-config.cmake ${CMAKE_BINARY_DIR}/prelight-config-version.cmake
  DESTINATION ${PRELIGHT_CONFIG_DIR})
