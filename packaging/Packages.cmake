# cpack: Debian packages of the program and of the library. packaging/build is the one command that makes them from a commit.
set(PRELIGHT_PACKAGE_VERSION ${PROJECT_VERSION} CACHE STRING "Version of the Debian packages")
set(PRELIGHT_MAINTAINER "Prelight maintainers <maintainers@prelight.invalid>" CACHE STRING "Maintainer of the packages")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME prelight)
set(CPACK_PACKAGE_VERSION ${PRELIGHT_PACKAGE_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "bakes the light of glTF scenes and relights them")
set(CPACK_PACKAGE_CONTACT ${PRELIGHT_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME prelight)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "pocl-opencl-icd | opencl-icd, libegl1, libgl1, libgl1-mesa-dri")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION 
  "Precomputes how light travels through a glTF scene, stores it in the scene's
own file and relights it in real time: with a command line, a viewer, and
export to other programs. Rays are traced by OpenCL, on processors or GPUs.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libprelight-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(CONCAT CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS  # what prelight-config.cmake asks for, and the modules
  "prelight (= ${PRELIGHT_PACKAGE_VERSION}), libglm-dev, ocl-icd-opencl-dev, libopenexr-dev, libtinygltf-dev, "
  "libmeshoptimizer-dev, libepoxy-dev, libegl-dev, libeigen3-dev, libfmt-dev, libssl-dev, libzstd-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION 
  "Headers, static library and CMake package of Prelight, which precomputes how
light travels through glTF scenes.")
include(CPack)
