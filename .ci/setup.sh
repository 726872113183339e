#!/usr/bin/env bash
# Installs what is missing of packages.txt, then configures and builds. Arguments: targets to build (default: all).
# Does only what is still to be done.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

missing_packages() {
  local wanted
  mapfile -t wanted < <(sed 's/#.*//' .ci/packages.txt | tr -s '[:space:]' '\n' | sed '/^$/d' | sort)
  comm -23 <(printf '%s\n' "${wanted[@]}") \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null | sed -n 's/^installed //p' | sort)
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

install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "setup: this is not Debian; trying with what is installed (.ci/packages.txt lists what is needed)" >&2
    return
  fi
  local packages
  mapfile -t packages < <(missing_packages)
  if [ ${#packages[@]} -eq 0 ]; then return; fi
  echo "setup: installing ${packages[*]}" >&2
  if ! as_root true; then
    echo "setup: packages are missing, and neither root nor sudo is at hand to install them. As root, run:" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${packages[*]}" >&2
    exit 1
  fi
  as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q </dev/null >&2
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${packages[@]}" </dev/null >&2
}

# A second OpenCL implementation beside PoCL, for tests/portability alone: Intel's runtime for x86-64 CPUs, from PyPI,
# in build/opencl. Its folder `vendors` is for OCL_ICD_VENDORS; `lib` holds its TBB, which is newer than Debian's and
# must be found first. Without a package index those tests are skipped.
install_second_opencl() {
  local folder=build/opencl packages
  mapfile -t packages < <(sed 's/#.*//' .ci/opencl-packages.txt | tr -d ' ' | sed '/^$/d')
  if [ "$(uname -m)" != x86_64 ]; then
    echo "setup: no second OpenCL for $(uname -m); tests of portability will be skipped" >&2
    return
  fi
  if [ -f "$folder/complete" ] && cmp -s .ci/opencl-packages.txt "$folder/complete"; then return; fi
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
  cp .ci/opencl-packages.txt "$folder/complete"
}

build() {
  # Ninja configures again by itself when a CMake file has changed.
  if [ ! -f build/build.ninja ]; then
    cmake --preset release >&2
  fi
  cmake --build build --target "${@:-all}" >&2
}

install_packages
if [ $# -eq 0 ]; then
  # Whoever builds everything is going to test it. What comes over the network does so beside the compiler.
  install_second_opencl &
  second=$!
  trap wait EXIT  # a build that fails leaves nothing running
  build
  wait "$second"
else
  build "$@"
fi
