#!/usr/bin/env bash
# Builds everything and runs every check. Arguments go to ctest: tests/run.sh -R plane_filter
set -euo pipefail
cd "$(dirname "$0")/.."
./launcher/setup.sh

# Formatting differs between versions of clang-format: only the one of Debian 12 decides.
if clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
  find lcmtypes launcher modules tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
    xargs -0 clang-format --dry-run -Werror || {
    echo "run.sh: not formatted: run clang-format -i on the files above" >&2
    exit 1
  }
else
  echo "run.sh: no clang-format 14, formatting is not checked" >&2
fi

# The core of a module knows no bus, clock, file, thread or environment; reading and writing files
# is what some are for.
cores=$(find modules \( -name '*.h' -o -name '*.cpp' \) ! -name main.cpp ! -name '*_test.cpp' \
  ! -path 'modules/runtime/*' ! -path 'modules/codec/*' ! -path 'modules/synthetic_sensor/driver/*')
readers_and_writers='^modules/(imaging|kinect_source|object_exporter|scene_renderer|synthetic_sensor)/'
if grep -nE 'lcm|chrono|thread|getenv' $cores ||
  grep -n fstream $(grep -vE "$readers_and_writers" <<<"$cores"); then
  echo "run.sh: the core of a module uses what only its shell may use" >&2
  exit 1
fi

if [[ -z "${DECLUTTER_DATA:-}" ]]; then
  echo "run.sh: DECLUTTER_DATA is not set: tests on real recordings are skipped" >&2
elif [[ ! -d "$DECLUTTER_DATA" ]]; then
  echo "run.sh: DECLUTTER_DATA is no folder ($DECLUTTER_DATA): tests on real recordings are skipped" >&2
fi

ctest --test-dir build -j2 --output-on-failure --no-tests=error "$@"
