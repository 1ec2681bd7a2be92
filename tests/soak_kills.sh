#!/usr/bin/env bash
# Kills what a robot runs, again and again, and prints how long it was away:
#   tests/soak_kills.sh COUNT NAME     NAME: a module, logger or launcher
set -euo pipefail
cd "$(dirname "$0")/.."

launcher=build/bin/launcher
work=$(mktemp -d)
trap 'stop_graph; rm -rf "$work"' EXIT
launcher_pid=

# The robot's graph with the synthetic sensor, and results in a file.
start_graph() {
  rm -rf "$work/logs" "$work/objects"
  cat >"$work/graph.textproto" <<END
include: "$PWD/config/robot.textproto"
logger { min_free_mb: 64 }
module { name: "object_exporter" disabled: false restart: "on_failure" }
END
  "$launcher" run "$work/graph.textproto" --log_dir "$work/logs" \
    --set kinect_source.input="live:synthetic:$PWD/config/demo_sensor.textproto" \
    --set object_exporter.output="$work/objects" 2>"$work/stderr" &
  launcher_pid=$!
  wait_until has_new_result
}

stop_graph() {
  [[ -n "$launcher_pid" ]] || return 0
  kill "$launcher_pid" 2>/dev/null || true
  wait "$launcher_pid" 2>/dev/null || true
  launcher_pid=
}

# Processes of the run; their numbers and command lines.
processes() { pgrep --full --list-full -- "$work/logs/" || true; }

pid_of() { processes | awk -v name="$1" '$2 ~ "/" name "$" && !/ --describe/ { print $1 }'; }

num_results() { cat "$work/objects/objects.jsonl" 2>/dev/null | wc -l; }

has_new_result() { (($(num_results) > ${old_results:-0})); }

is_back() { new_pid=$(pid_of "$1") && [[ -n "$new_pid" && "$new_pid" != "$old_pid" ]]; }

nothing_left() { [[ -z "$(processes)" ]]; }

newest_log() { find "$work"/logs/*/ -name 'run.lcmlog.*' | sort -V | tail -n 1; }

is_recording() { [[ "$(newest_log)" != "$old_log" && $(stat -c %s "$(newest_log)") -gt 200000 ]]; }

wait_until() {
  local begin=$SECONDS
  until "$@"; do
    ((SECONDS - begin < 60)) || { echo "soak_kills.sh: no '$*' within 60 s" >&2; cat "$work/stderr" >&2; exit 1; }
    sleep 0.01
  done
}

now() { echo "${EPOCHREALTIME/./}"; }

# Median and largest of the numbers on stdin, in microseconds, as seconds.
summary() {
  sort -n | awk '{ t[NR] = $1 / 1e6 }
    END { printf "median %.2f s, longest %.2f s", t[int((NR + 1) / 2)], t[NR] }'
}

# A module is killed: until it is there again, and until the next result.
kill_module() {
  local name=$1 i begin
  : >"$work/back"; : >"$work/result"
  start_graph
  for ((i = 0; i < count; ++i)); do
    old_pid=$(pid_of "$name")
    begin=$(now)
    kill -9 "$old_pid"
    wait_until is_back "$name"
    echo $(($(now) - begin)) >>"$work/back"
    old_results=$(num_results)
    wait_until has_new_result
    echo $(($(now) - begin)) >>"$work/result"
    old_results=0
    sleep 1.2  # longer than the ten delays after which it counts as well again
  done
  stop_graph
  echo "$name killed $count times: back $(summary <"$work/back"); next result $(summary <"$work/result")"
}

# lcm-logger is killed: until the next file has messages.
kill_logger() {
  local i begin
  : >"$work/back"
  start_graph
  for ((i = 0; i < count; ++i)); do
    old_log=$(newest_log)
    begin=$(now)
    kill -9 "$(pid_of lcm-logger)"
    wait_until is_recording
    echo $(($(now) - begin)) >>"$work/back"
    sleep 1.2
  done
  stop_graph
  echo "lcm-logger killed $count times: recording again $(summary <"$work/back")"
}

# The launcher is killed: until none of its processes is left.
kill_launcher() {
  local i begin
  : >"$work/gone"
  for ((i = 0; i < count; ++i)); do
    start_graph
    begin=$(now)
    kill -9 "$launcher_pid"
    wait "$launcher_pid" 2>/dev/null || true
    wait_until nothing_left
    echo $(($(now) - begin)) >>"$work/gone"
    launcher_pid=
  done
  echo "launcher killed $count times: nothing left after $(summary <"$work/gone")"
}

(($# == 2)) || { echo "soak_kills.sh: COUNT and NAME are needed" >&2; exit 2; }
count=$1
case "$2" in
  logger) kill_logger ;;
  launcher) kill_launcher ;;
  *) kill_module "$2" ;;
esac
