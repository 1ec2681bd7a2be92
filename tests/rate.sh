#!/usr/bin/env bash
# Measures the graph at the rate of a sensor: tests/rate.sh [--seconds N]
# Plays rendered dense scenes at 30 Hz for N seconds (60) through the whole graph, with all messages
# recorded, and prints what became of the frames, how long they took, and what each process needed.
# Ends with 1 unless every frame came out, in time, with a fifth of the processor to spare, and the
# log holds every message.
set -euo pipefail
cd "$(dirname "$0")/.."

readonly rate_hz=30 max_load_percent=80 max_p50_ms=60 max_p95_ms=90 max_stretch_percent=1
seconds=60
while (($# > 0)); do
  [[ "$1" == --seconds ]] || { echo "rate.sh: unknown option $1" >&2; exit 2; }
  [[ "${2:-}" =~ ^[1-9][0-9]{0,4}$ ]] ||
    { echo "rate.sh: --seconds needs a whole number from 1 to 99999" >&2; exit 2; }
  seconds=$2
  shift 2
done
num_frames=$((seconds * rate_hz))
./launcher/setup.sh

out=logs/rate
log=$out/run.lcm
mkdir -p "$out"
rm -rf "$log" "$out/objects" "$out/new_scenes"
if [[ ! -d "$out/scenes" ]]; then
  build/bin/scene_renderer config/scenes/dense.textproto "$out/new_scenes" --count 10
  mv "$out/new_scenes" "$out/scenes"
fi

declare -A name_of ticks_of peak_kb_of  # by process number

# Remembers what process $1 has used so far; one that has ended stays as it was. Starts no process of
# its own, which would cost what is measured.
look_at() {
  local args=() stat="" status="" fields
  {
    mapfile -d '' -t args <"/proc/$1/cmdline"
    read -r stat <"/proc/$1/stat"
    read -r -d '' status <"/proc/$1/status"
  } 2>/dev/null || true
  # A process that begins or ends has no arguments; a program that is only asked for its description
  # is no part of the graph; the guard only waits.
  ((${#args[@]} > 0)) || return 0
  [[ "$stat" != *"(launcher-guard)"* ]] || return 0
  [[ "$status" =~ VmHWM:[[:space:]]*([0-9]+) && " ${args[*]} " != *" --describe "* ]] || return 0
  peak_kb_of[$1]=${BASH_REMATCH[1]}
  name_of[$1]=${args[0]##*/}
  read -r -a fields <<<"${stat##*) }"  # the name, in brackets, may hold anything
  ticks_of[$1]=$((fields[11] + fields[12]))
}

# Processor time that this machine has spent, whoever it was.
busy_ticks() {
  local f
  read -r -a f </proc/stat
  echo $((f[1] + f[2] + f[3] + f[6] + f[7]))
}

busy_before=$(busy_ticks)
build/bin/launcher run config/rate.textproto --record "$log" \
  --set kinect_source.num_frames="$num_frames" >"$out/launcher.log" 2>&1 &
launcher=$!
trap 'kill "$launcher" 2>/dev/null || true' EXIT
children=
while kill -0 "$launcher" 2>/dev/null; do
  read -r children 2>/dev/null <"/proc/$launcher/task/$launcher/children" || true
  for process in $launcher $children; do look_at "$process"; done
  sleep 0.2
done
code=0
wait "$launcher" || code=$?
trap - EXIT
busy=$(($(busy_ticks) - busy_before))
if ((code != 0)); then
  cat "$out/launcher.log" >&2
  echo "rate.sh: the run ended with $code" >&2
  exit 1
fi

build/bin/log_tool frames "$log" | tee "$out/frames.txt"
for process in "${!name_of[@]}"; do
  echo "${name_of[$process]} ${ticks_of[$process]} ${peak_kb_of[$process]}"
done | sort >"$out/processes.txt"

echo
awk -v hz="$(getconf CLK_TCK)" -v cores="$(nproc)" -v busy="$busy" \
  -v num_frames="$num_frames" -v rate_hz=$rate_hz -v max_load=$max_load_percent \
  -v max_p50=$max_p50_ms -v max_p95=$max_p95_ms -v max_stretch=$max_stretch_percent '
  function hold(what, value, target, holds) {
    printf "%-28s %10s   %-22s %s\n", what, value, target, holds ? "holds" : "MISSED"
    if (!holds) missed = 1
  }
  FILENAME ~ /frames/ && / depth frames in / { num_in = $1; span_s = $5 }
  FILENAME ~ /frames/ && / messages published / { num_published = $1; num_logged = $6 }
  FILENAME ~ /frames/ && $1 == "OBJECTS" { num_out = $2; p50 = $3; p95 = $4 }
  FILENAME ~ /processes/ {
    if (!total) printf "%-20s %8s %8s %8s\n", "process", "CPU s", "cores %", "peak MB"
    printf "%-20s %8.1f %8.1f %8.0f\n", $1, $2 / hz, share($2), $3 * 1024 / 1e6
    total += $2
  }
  function share(ticks) { return span_s > 0 ? 100 * ticks / hz / span_s / cores : 0 }
  END {
    printf "%-20s %8.1f %8.1f   of %d cores\n", "all", total / hz, share(total), cores
    others = busy > total ? busy - total : 0
    printf "%-20s %8.1f %8.1f   not of the graph\n\n", "others", others / hz, share(others)
    printf "%-28s %10s   %s\n", "", "measured", "target"
    due_s = (num_frames - 1) / rate_hz
    hold("frames in", num_in + 0, num_frames, num_in == num_frames)
    hold("from first to last, s", span_s, sprintf("<= %.1f", due_s * (1 + max_stretch / 100)),
         num_in > 0 && span_s <= due_s * (1 + max_stretch / 100))
    hold("messages in the log", num_logged + 0, num_published,
         num_published > 0 && num_logged == num_published)
    hold("frames out", num_out + 0, num_frames, num_out == num_frames)
    hold("latency p50, ms", num_out ? p50 : "-", "<= " max_p50, num_out && p50 <= max_p50)
    hold("latency p95, ms", num_out ? p95 : "-", "<= " max_p95, num_out && p95 <= max_p95)
    hold("processor, % of all cores", sprintf("%.1f", share(total)), "<= " max_load,
         share(total) <= max_load)
    exit missed
  }' "$out/frames.txt" "$out/processes.txt"
