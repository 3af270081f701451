#!/usr/bin/env bash
# setup.sh [--no-pictures]: installs what is missing and builds Release into build/.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build

packages=(
  g++ cmake make pkg-config
  libpetsc-real-dev libopenblas0-serial libopenmpi-dev openmpi-bin libmetis-dev libhdf5-openmpi-dev
  libeigen3-dev libyaml-cpp-dev libcli11-dev libfmt-dev libginac-dev libmuparser-dev libgsl-dev libxxhash-dev
  nlohmann-json3-dev
  libgtest-dev clang-format python3 python3-numpy python3-h5py python3-yaml python3-jsonschema python3-matplotlib
)
picture_packages=(paraview python3-paraview xvfb xauth)

case "${1-}" in
  "") packages+=("${picture_packages[@]}") ;;
  --no-pictures) ;;
  *) echo "usage: setup.sh [--no-pictures]" >&2; exit 2 ;;
esac

# The packages of "$@" that are not installed.
missing_of() {
  local package
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

# "$@" as root; fails where that is not possible.
as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    sudo -n "$@"
  elif command -v sudo >/dev/null && [ -t 0 ]; then
    sudo "$@"
  else
    return 1
  fi
}

apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=600 "$@"
}

# The installer talks into $log; the screen gets it only when it fails.
install_packages() {
  local log
  log=$(mktemp)
  echo "setup: installing $*"
  if { apt_get update && apt_get install -y --no-install-recommends "$@"; } >"$log" 2>&1 </dev/null; then
    rm -f "$log"
    return 0
  fi
  tail -n 15 "$log" >&2
  rm -f "$log"
  return 1
}

advise() {
  echo "setup: $1" >&2
  echo "setup: needed are a C++20 compiler, CMake >= 3.18, make, pkg-config, PETSc >= 3.18 (real scalars), a fast BLAS, Open MPI," >&2
  echo "setup: METIS, parallel HDF5, Eigen 3, yaml-cpp, CLI11, fmt, GiNaC, muParser, GSL, xxHash, JSON for Modern C++, GoogleTest;" >&2
  echo "setup: for tests and pictures clang-format, ParaView, Xvfb, python3 with numpy, h5py, yaml, jsonschema, matplotlib" >&2
  echo "setup: going on with what is here" >&2
}

ensure_software() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    advise "no apt on this machine, so nothing is installed"
    return 0
  fi
  local missing
  mapfile -t missing < <(missing_of "${packages[@]}")
  if [ "${#missing[@]}" = 0 ]; then
    echo "setup: all packages are installed"
  elif ! install_packages "${missing[@]}"; then
    advise "could not install: ${missing[*]}"
  fi
}

build_release() {
  mkdir -p "$build"
  # Two scripts may be started at once; the second waits for the first one's build.
  if command -v flock >/dev/null; then
    exec 9>"$build/.setup.lock"
    flock 9
  fi
  echo "setup: building Release in $build"
  if ! { cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release &&
         cmake --build "$build" --parallel "$(nproc)"; } >"$build/setup.log" 2>&1 </dev/null; then
    cat "$build/setup.log" >&2
    echo "setup: the build failed; what it said is above and in $build/setup.log" >&2
    return 1
  fi
  echo "setup: $build/cablenet is ready"
}

ensure_software
build_release
