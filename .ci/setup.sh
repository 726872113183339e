#!/usr/bin/env bash
# Installs the packages that are missing, then configures and builds in build/. Does only what is still to be done.
#
#   .ci/setup.sh program      the program alone, by the packages of packages/build.txt
#   .ci/setup.sh tests        everything, by all packages, and a second OpenCL implementation beside PoCL
#
# With PRELIGHT_WERROR=ON in the environment, warnings of the compiler are errors.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# names_in FILE...: what the lists name, one a line, without comments.
names_in() { sed 's/#.*//' "$@" | tr -s '[:space:]' '\n' | sed '/^$/d' | sort -u; }

# missing_of PACKAGE...: those that are not installed.
missing_of() {
  comm -23 <(printf '%s\n' "$@") \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p' | sort)
}

# unknown_of PACKAGE...: those that no source of this release's packages has.
unknown_of() {
  comm -23 <(printf '%s\n' "$@") \
    <(apt-cache madison "$@" 2>/dev/null | sed 's/ *|.*//; s/^ *//' | sort -u)
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
    sudo "$@"
  else
    return 77
  fi
}

# install_packages LIST...: what the lists name and the release has. What it does not have is told once and remembered:
# who needs such a package finds it missing.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "setup: this is not Debian; trying with what is installed (.ci/packages/*.txt list what is needed)" >&2
    return
  fi
  local absent=build/absent-packages.txt release wanted missing unknown
  release=$(cat /etc/debian_version)
  mapfile -t wanted < <(names_in "$@")
  if [ -f "$absent" ] && [ "$(head -n 1 "$absent")" = "$release" ]; then
    mapfile -t wanted < <(printf '%s\n' "${wanted[@]}" | grep -vxFf "$absent")
  fi
  mapfile -t missing < <(missing_of "${wanted[@]}")
  if [ ${#missing[@]} -eq 0 ]; then return; fi
  if ! as_root true; then
    echo "setup: packages are missing, and neither root nor sudo is at hand to install them. As root, run:" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q </dev/null >&2
  mapfile -t unknown < <(unknown_of "${missing[@]}")
  if [ ${#unknown[@]} -gt 0 ]; then
    echo "setup: Debian $release has no package ${unknown[*]}; going on without" >&2
    mkdir -p build
    printf '%s\n' "$release" "${unknown[@]}" >"$absent"
    mapfile -t missing < <(comm -23 <(printf '%s\n' "${missing[@]}") <(printf '%s\n' "${unknown[@]}"))
    if [ ${#missing[@]} -eq 0 ]; then return; fi
  fi
  echo "setup: installing ${missing[*]}" >&2
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends "${missing[@]}" </dev/null >&2
}

# A second OpenCL implementation beside PoCL, for tests/portability alone: Intel's runtime for x86-64 CPUs, from PyPI,
# in build/opencl. Its folder `vendors` is for OCL_ICD_VENDORS; `lib` holds its TBB, which is newer than Debian's and
# must be found first. Without a package index those tests are skipped.
install_second_opencl() {
  local folder=build/opencl list=.ci/packages/pypi-opencl.txt packages
  mapfile -t packages < <(names_in "$list")
  if [ "$(uname -m)" != x86_64 ]; then
    echo "setup: no second OpenCL for $(uname -m); tests of portability will be skipped" >&2
    return
  fi
  if [ -f "$folder/complete" ] && cmp -s "$list" "$folder/complete"; then return; fi
  rm -rf "$folder"
  python3 -m venv "$folder/python" >&2
  if ! "$folder/python/bin/pip" index versions --retries 2 --timeout 20 "${packages[0]%%=*}" >/dev/null 2>&1; then
    echo "setup: pip reaches no package index; tests of portability will be skipped" >&2
    rm -rf "$folder"
    return
  fi
  echo "setup: installing ${packages[*]} into $folder" >&2
  "$folder/python/bin/pip" install -q --no-cache-dir --disable-pip-version-check "${packages[@]}" >&2
  mkdir -p "$folder/vendors" "$folder/lib"
  ln -s ../python/lib/libtbb.so.12 "$folder/lib/"
  cp /etc/OpenCL/vendors/*.icd "$folder/vendors/"
  echo "$PWD/$folder/python/lib/libintelocl.so" >"$folder/vendors/intel.icd"
  cp "$list" "$folder/complete"
}

# configure NAME=VALUE...: makes the build folder, or sets what it has otherwise. Ninja configures again by itself when a
# CMake file has changed.
configure() {
  local set options=()
  for set in "$@"; do
    grep -qsE "^${set%%=*}:[A-Z]+=${set#*=}\$" build/CMakeCache.txt || options+=("-D$set")
  done
  if [ ${#options[@]} -gt 0 ] || [ ! -f build/build.ninja ]; then
    cmake --preset release "${options[@]}" >&2
  fi
}

# announce TARGET: says how much is to be compiled for the first time and how long that will take, from how long this machine
# takes for the standard headers that every source begins with. (What `ninja -n` says ends with the search for new files.)
announce() {
  local objects object sources=0 header milliseconds cores seconds TIMEFORMAT='%3U'
  mapfile -t objects < <(ninja -C build -t commands "$1" | sed -nE 's/.* -o ([^ ]+\.o) -c .*/\1/p')
  for object in "${objects[@]}"; do
    if [ ! -f "build/$object" ]; then sources=$((sources + 1)); fi
  done
  if [ "$sources" -lt 5 ]; then return; fi
  header='#include <algorithm>\n#include <filesystem>\n#include <functional>\n#include <map>\n#include <thread>\n'
  milliseconds=$({ time printf '%b' "$header" | "${CXX:-c++}" -std=c++20 -fsyntax-only -x c++ - 2>/dev/null; } 2>&1) || return 0
  cores=$(nproc)
  seconds=$((10#${milliseconds/./} * headers_per_source * sources / cores / 1000))
  echo "setup: compiling $sources batches of sources, which takes about $((seconds / 60 + 1)) min on $cores cores" >&2
}
# What compiling one of them takes, in what those headers take: measured over all that start.sh builds.
headers_per_source=16

if [ $# -ne 1 ] || [[ ! $1 =~ ^(program|tests)$ ]]; then
  echo "usage: .ci/setup.sh program|tests" >&2
  exit 2
fi
build=.ci/packages/build.txt
warnings=()
if [ -n "${PRELIGHT_WERROR:-}" ]; then warnings+=("PRELIGHT_WERROR=$PRELIGHT_WERROR"); fi
if [ "$1" = program ]; then
  install_packages "$build"
  # Tests are left out until they are asked for, with the packages that they take.
  if [ ! -f build/build.ninja ]; then configure BUILD_TESTING=OFF "${warnings[@]}"; fi
  announce prelight_cli
  cmake --build build --target prelight_cli >&2
else
  install_packages "$build" .ci/packages/test.txt .ci/packages/benchmark.txt
  # What comes over the network does so beside the compiler.
  install_second_opencl &
  second=$!
  trap wait EXIT  # a build that fails leaves nothing running
  configure BUILD_TESTING=ON "${warnings[@]}"
  announce all
  cmake --build build >&2
  wait "$second"
fi
