#!/usr/bin/env bash
# Installs what is needed from Debian 12 and builds everything into build/. With nothing to install
# it needs neither network nor root; with nothing changed it takes a second.
set -euo pipefail
cd "$(dirname "$0")/.."

# The only list of what we build on.
packages=(
  g++ cmake ninja-build ccache clang-format
  liblcm-dev liblcm-bin              # bus, lcm-gen and lcm-logger
  libprotobuf-dev protobuf-compiler  # parameters
  libeigen3-dev libpcl-dev
  libopenni2-dev                     # depth sensors and .oni files
  libpng-dev libturbojpeg0-dev libzstd-dev nlohmann-json3-dev libyaml-cpp-dev
  libhwy-dev                         # SIMD with dispatch at run time
  libgtest-dev libgmock-dev libbenchmark-dev procps
)

is_installed() {
  [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]
}

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done

if ((${#missing[@]} > 0)); then
  echo "setup: installing ${missing[*]}" >&2
  as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "setup: not root and no sudo: install them first" >&2; exit 1; }
    as_root=(sudo)
  fi
  apt_get=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0)
  "${apt_get[@]}" update >&2
  "${apt_get[@]}" install --no-install-recommends "${missing[@]}" >&2
fi

cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release >&2
ninja -C build -j"$(nproc)" >&2
