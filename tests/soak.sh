#!/usr/bin/env bash
# Long runs of what tests/run.sh tests for seconds: tests/soak.sh [SOAK]...
# Runs the soaks named, else all, prints their figures, and ends with 1 when one has failed.
set -euo pipefail
cd "$(dirname "$0")/.."
./launcher/setup.sh
export DECLUTTER_SOAK=1  # what sensor_test looks at

# 60 s of a sensor at 30 Hz.
thirty_hertz() { build/bin/sensor_test --gtest_filter='*HoldsThirtyFramesASecond'; }

# A sensor unplugged 100 times.
unplugged() { build/bin/sensor_test --gtest_filter='*SurvivesBeingUnpluggedAgainAndAgain'; }

# kill -9, 100 times each, of what a robot runs.
killed_modules() {
  local module
  for module in kinect_source plane_filter feature_estimator hough_segmenter model_verifier; do
    tests/soak_kills.sh 100 "$module" || return 1
  done
}
killed_logger() { tests/soak_kills.sh 100 logger; }
killed_launcher() { tests/soak_kills.sh 100 launcher; }

soaks=("$@")
(($# > 0)) || soaks=(thirty_hertz unplugged killed_modules killed_logger killed_launcher)
for soak in "${soaks[@]}"; do
  declare -F "$soak" >/dev/null || { echo "soak.sh: no soak $soak" >&2; exit 2; }
done
failed=()
for soak in "${soaks[@]}"; do
  "$soak" || failed+=("$soak")
done
echo "soak.sh: ${#soaks[@]} run, ${#failed[@]} failed ${failed[*]}"
((${#failed[@]} == 0))
