#!/usr/bin/env bash
# How tabletop.lcmlog was made: rendered scenes, the sensor's noise, and a frame that cannot be read.
set -euo pipefail
cd "$(dirname "$0")/../../.."
out=logs/golden
url='udpm://239.255.76.67:7793?ttl=0&recv_buf_size=200000'
camera='camera { width: 320 height: 240 fx: 290 fy: 290 cx: 159.5 cy: 119.5 }'
rm -rf "$out"
mkdir -p "$out/scenes/4_unreadable"

render() {
  echo "$camera" >"$out/$1.textproto"
  cat >>"$out/$1.textproto"
  build/bin/scene_renderer "$out/$1.textproto" "$out/scenes/$1" --noise real_sensor
}
render 1_apart <<'SCENE'
object { box { size_x_m: 0.16 size_y_m: 0.08 size_z_m: 0.2 } x_m: -0.12 y_m: 0.65 yaw_rad: 0.5 }
object { cylinder { radius_m: 0.045 height_m: 0.15 } x_m: 0.12 y_m: 0.6 }
SCENE
render 2_touching <<'SCENE'
object { box { size_x_m: 0.12 size_y_m: 0.08 size_z_m: 0.18 } x_m: -0.05 y_m: 0.65 yaw_rad: 0.4 }
object {
  box { size_x_m: 0.1 size_y_m: 0.07 size_z_m: 0.1 }
  x_m: 0.051316709 y_m: 0.692836018 yaw_rad: 0.4
}
object { cylinder { radius_m: 0.035 height_m: 0.12 } x_m: 0.03 y_m: 0.53 }
SCENE
render 3_stacked <<'SCENE'
object { box { size_x_m: 0.2 size_y_m: 0.14 size_z_m: 0.06 } y_m: 0.65 yaw_rad: -0.5 }
object { cylinder { radius_m: 0.033 height_m: 0.11 } x_m: 0.03 y_m: 0.66 on: 0 }
SCENE
cp "$out/scenes/1_apart/scene.json" "$out/scenes/4_unreadable/"
echo "no image" >"$out/scenes/4_unreadable/depth.png"

lcm-logger --quiet --lcm-url="$url" --channel=DEPTH_FRAME "$out/tabletop.lcmlog" &
logger=$!
sleep 1
build/bin/launcher run config/recordings.textproto --url "$url" --set kinect_source.input="$out/scenes" \
  --set object_exporter.output="$out/objects" || (($? == 1))
sleep 1
kill "$logger"
wait "$logger" || true
mv "$out/tabletop.lcmlog" tests/data/golden/
