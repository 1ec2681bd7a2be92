#!/usr/bin/env bash
# Compares two graphs, or two sets of parameters, on the same input:
#   tests/compare.sh INPUT... [--baseline GRAPH] [--candidate GRAPH] [--set module.field=value]...
#                    [--set-candidate module.field=value]...
# INPUT is a folder of scenes or a log (of DEPTH_FRAME). GRAPH is config/recordings.textproto for the
# baseline and the baseline's for the candidate; --set goes to both. Both are scored against truth
# where the scenes have one, and compared with each other. What they found lies in logs/compare/.
# Ends with 0 whatever they differ in, 1 when a frame failed, 2 on wrong use.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd -P)"
out=logs/compare

fail() {
  echo "compare.sh: $*" >&2
  exit 2
}

baseline=""
candidate=""
settings=()
candidate_settings=()
inputs=()
while (($# > 0)); do
  case "$1" in
    --baseline | --candidate | --set | --set-candidate)
      (($# > 1)) || fail "$1 needs a value"
      case "$1" in
        --baseline) baseline="$2" ;;
        --candidate) candidate="$2" ;;
        --set) settings+=(--set "$2") ;;
        --set-candidate) candidate_settings+=(--set "$2") ;;
      esac
      shift 2
      ;;
    --*) fail "unknown option $1" ;;
    *)
      [[ -e "$1" ]] || fail "$1: no such file or folder"
      input="$(realpath "$1")"
      [[ "$input/" != "$here/$out/"* ]] || fail "$1: lies in $out, which is written anew"
      inputs+=("$input")
      shift
      ;;
  esac
done
((${#inputs[@]} > 0)) || fail "an input is needed: a folder of scenes or a log"
: "${baseline:=$here/config/recordings.textproto}" "${candidate:=$baseline}"
for graph in "$baseline" "$candidate"; do
  [[ -f "$graph" ]] || fail "$graph: no such graph"
done
baseline="$(realpath "$baseline")"
candidate="$(realpath "$candidate")"
[[ "$baseline" != "$candidate" ]] || ((${#candidate_settings[@]} > 0)) ||
  fail "nothing to compare: --candidate or --set-candidate is needed"

"$here/launcher/setup.sh"
cd "$here"
rm -rf "$out"
mkdir -p "$out"

# run GRAPH INPUT FOLDER OPTION...: writes what the graph finds. Frames that failed have a line too.
status=0
run() {
  local graph="$1" input="$2" folder="$3" source code=0
  shift 3
  source=(--replay "$input")
  if [[ -d "$input" ]]; then source=(--set kinect_source.input="$input"); fi
  build/bin/launcher run "$graph" "${source[@]}" --set object_exporter.output="$folder" "$@" ||
    code=$?
  ((code <= 1)) || exit "$code"
  [[ -s "$folder/objects.jsonl" ]] || fail "$input: no frame was read"
  ((code == 0)) || status=1
}

for input in "${inputs[@]}"; do
  name="$(basename "$input")"
  while [[ -e "$out/$name" ]]; do name+=_; done
  echo "=== $input"
  run "$baseline" "$input" "$out/$name/baseline" "${settings[@]}"
  run "$candidate" "$input" "$out/$name/candidate" "${settings[@]}" "${candidate_settings[@]}"
  scenes=()
  if [[ -d "$input" ]]; then scenes=("$input"); fi
  build/bin/compare_runs "$out/$name/baseline" "$out/$name/candidate" "${scenes[@]}" || status=1
done
exit "$status"
