#!/usr/bin/env bash
# Renders a cluttered table of 17 boxes and cylinders, finds them again from the depth image alone,
# and prints each beside its truth. Ends with 1 when fewer than 16 are found.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
"$here/launcher/setup.sh"
cd "$here"

out=logs/demo
rm -rf "$out"
mkdir -p "$out"
build/bin/scene_renderer config/scenes/demo.textproto "$out/scene"
build/bin/launcher run config/recordings.textproto \
  --set kinect_source.input="$out/scene" --set object_exporter.output="$out/objects"

status=0
build/bin/score_objects "$out/scene" "$out/objects" --table --min_found 16 \
  --json "$out/score.json" --html "$out/score.html" || status=$?

echo
echo "Pictures:"
find "$out" -name '*.png' | sort
exit "$status"
