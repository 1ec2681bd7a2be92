#!/usr/bin/env bash
# A synthetic sensor looks at a cluttered table of 17 boxes and cylinders; the graph finds them in its
# live depth images; each is printed beside its truth. Ends with 1 when fewer than 16 are found.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
"$here/launcher/setup.sh"
cd "$here"

out=logs/demo
rm -rf "$out"
mkdir -p "$out"
build/bin/launcher run config/demo.textproto --set object_exporter.output="$out/objects"

# The truth, named as the last frame that was exported.
frame=$(tail -n 1 "$out/objects/objects.jsonl" | cut -d '"' -f 4)
build/bin/scene_renderer config/scenes/demo.textproto "$out/scene/$frame"

status=0
build/bin/score_objects "$out/scene" "$out/objects" --table --min_found 16 \
  --json "$out/score.json" --html "$out/score.html" || status=$?

echo
echo "Pictures:"
find "$out" -name '*.png' | grep -F "/$frame" | sort
exit "$status"
