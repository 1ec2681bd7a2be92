#!/usr/bin/env bash
# Measures how well objects are found: tests/evaluate.sh [--set module.field=value]... [DIR]...
# Each DIR is a folder of scenes with truth; without one, the real recordings in DECLUTTER_DATA and
# freshly rendered dense scenes. --set goes to the graph. Reports lie in logs/evaluate/.
#        tests/evaluate.sh --paper_tables
# repeats the paper's experiments on rendered scenes instead: Table 2, Figure 4 and Table 3.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
"$here/launcher/setup.sh"

settings=()
folders=()
paper_tables=false
while (($# > 0)); do
  case "$1" in
    --set)
      (($# > 1)) || { echo "evaluate.sh: --set needs a value" >&2; exit 2; }
      settings+=(--set "$2")
      shift 2
      ;;
    --paper_tables)
      paper_tables=true
      shift
      ;;
    --*)
      echo "evaluate.sh: unknown option $1" >&2
      exit 2
      ;;
    *)
      folders+=("$(cd "$1" && pwd)")
      shift
      ;;
  esac
done

data=""
if [[ -d "${DECLUTTER_DATA:-}" ]]; then data="$(cd "$DECLUTTER_DATA" && pwd)"; fi

cd "$here"
out=logs/evaluate
rm -rf "$out"
mkdir -p "$out"

if "$paper_tables"; then
  build/bin/paper_tables config/scenes/demo.textproto config/scenes/dense.textproto \
    "$out/paper_tables.json" | tee "$out/paper_tables.txt"
  exit
fi

if ((${#folders[@]} == 0)); then
  if [[ -n "$data" ]]; then
    folders+=("$data")
  else
    echo "evaluate.sh: DECLUTTER_DATA is no folder: only rendered scenes are evaluated" >&2
  fi
  for noise in real_sensor white; do
    build/bin/scene_renderer config/scenes/dense.textproto "$out/scenes/dense_$noise" \
      --noise "$noise" --count 50
    folders+=("$out/scenes/dense_$noise")
  done
fi

status=0
for folder in "${folders[@]}"; do
  name="$(basename "$folder")"
  while [[ -e "$out/$name" ]]; do name+=_; done
  echo "=== $folder"
  build/bin/launcher run config/recordings.textproto --set kinect_source.input="$folder" \
    --set object_exporter.output="$out/$name" "${settings[@]}" || status=1
  build/bin/score_objects "$folder" "$out/$name" --json "$out/$name.json" --html "$out/$name.html" \
    || status=1
  echo "report: $out/$name.html"
done
exit "$status"
