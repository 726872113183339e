# Every dependency is a Debian 12 package; the comment names it.
find_package(Threads REQUIRED)
find_package(OpenCL REQUIRED)               # ocl-icd-opencl-dev
find_path(OPENCL_HPP_DIR CL/opencl.hpp REQUIRED)  # opencl-clhpp-headers
find_package(glm REQUIRED)                  # libglm-dev
find_package(OpenEXR CONFIG REQUIRED)       # libopenexr-dev
find_package(OpenImageIO REQUIRED)          # libopenimageio-dev, by FindOpenImageIO.cmake
find_package(PNG REQUIRED)                  # libpng-dev
find_package(libavif CONFIG REQUIRED)       # libavif-dev
find_package(TinyGLTF REQUIRED)             # libtinygltf-dev
find_package(draco REQUIRED)                # libdraco-dev
find_package(meshoptimizer REQUIRED)        # libmeshoptimizer-dev
# Who builds that library needs its definition, not who uses it.
set_target_properties(meshoptimizer::meshoptimizer PROPERTIES INTERFACE_COMPILE_DEFINITIONS "")
find_package(nlohmann_json REQUIRED)        # nlohmann-json3-dev
find_package(Eigen3 REQUIRED)               # libeigen3-dev
find_package(fmt REQUIRED)                  # libfmt-dev
find_package(CLI11 REQUIRED)                # libcli11-dev
find_package(OpenSSL REQUIRED COMPONENTS Crypto)  # libssl-dev: SHA-256 of the kernel cache keys
find_package(PkgConfig REQUIRED)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)  # libzstd-dev
find_path(XXHASH_DIR xxhash.h REQUIRED)     # libxxhash-dev: checksums of states; nothing is linked
pkg_check_modules(SECCOMP REQUIRED IMPORTED_TARGET libseccomp)  # libseccomp-dev
if(PRELIGHT_VIEWER)
  find_package(glfw3 REQUIRED)              # libglfw3-dev
  pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)  # libepoxy-dev
  pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)      # libegl-dev
  pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)  # libimgui-dev
endif()
