#!/usr/bin/env bash
# Kills what a robot runs, again and again, and prints how long it was away:
#   tests/soak_kills.sh COUNT NAME     NAME: a module, logger or launcher
# Ends with 1 when it was once away for longer than 1 s, or the next result took longer than 2 s.
set -euo pipefail
cd "$(dirname "$0")/.."

launcher=build/bin/launcher
work=$(mktemp -d)
trap 'stop_graph; rm -rf "$work"' EXIT
launcher_pid=

# The robot's graph with the synthetic sensor, and results in a file. The sensor has a single image:
# to render more takes time whenever it is opened, which a real one does not need.
start_graph() {
  rm -rf "$work/logs" "$work/objects"
  cat >"$work/graph.textproto" <<END
include: "$PWD/config/robot.textproto"
logger { min_free_mb: 64 }
module { name: "object_exporter" disabled: false restart: "on_failure" }
END
  echo "scene: \"$PWD/config/scenes/demo.textproto\" num_images: 1" >"$work/sensor.textproto"
  "$launcher" run "$work/graph.textproto" --log_dir "$work/logs" \
    --set kinect_source.input="live:synthetic:$work/sensor.textproto" \
    --set object_exporter.output="$work/objects" 2>"$work/stderr" &
  launcher_pid=$!
  wait_until has_result_since 0
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

# When the sensor took the last frame that there is a result of, in microseconds.
last_result() {
  local line
  line=$(tail -n 1 "$work/objects/objects.jsonl" 2>/dev/null | grep -o '"utime":[0-9]*') || true
  echo "${line##*:}"
}

# Of what the sensor saw since then: what was on its way past a process that is killed does not count.
has_result_since() { (($(last_result) + 0 > $1)); }

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

# Median and largest of the microseconds in file $1, and how many are no more than $2 s, as text; 1
# when not all are.
summary() {
  sort -n "$1" | awk -v limit="$2" '{ t[NR] = $1 / 1e6; good += t[NR] <= limit }
    END { printf "median %.2f s, longest %.2f s, %d of %d within %d s", t[int((NR + 1) / 2)], t[NR],
                 good, NR, limit
          exit good < NR }'
}

report() { # text, file, limit in s
  local text
  text=$(summary "$2" "$3") || code=1
  echo "$1 $text"
}

# A module is killed: until it is there again, and until the next result.
kill_module() {
  local name=$1 i begin
  : >"$work/back"; : >"$work/result"
  start_graph
  for ((i = 0; i < count; ++i)); do
    old_pid=$(pid_of "$name")
    [[ -n "$old_pid" ]] || { echo "soak_kills.sh: no module $name runs" >&2; exit 2; }
    begin=$(now)
    kill -9 "$old_pid"
    wait_until is_back "$name"
    echo $(($(now) - begin)) >>"$work/back"
    wait_until has_result_since "$begin"
    echo $(($(now) - begin)) >>"$work/result"
    sleep 1.2  # longer than the ten delays after which it counts as well again
  done
  stop_graph
  report "$name killed $count times: back" "$work/back" 1
  report "  next result" "$work/result" 2
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
  report "lcm-logger killed $count times: recording again" "$work/back" 2
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
  report "launcher killed $count times: nothing left" "$work/gone" 1
}

[[ $# == 2 && "$1" =~ ^[1-9][0-9]*$ ]] ||
  { echo "soak_kills.sh: COUNT and NAME are needed" >&2; exit 2; }
count=$1
code=0
case "$2" in
  logger) kill_logger ;;
  launcher) kill_launcher ;;
  *) kill_module "$2" ;;
esac
exit "$code"
