#!/usr/bin/env bash
# Sets up what is missing, builds, draws a built-in room as its file describes it and as light fills it, and bakes a small scene.
# Opens the viewer where there is a display.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

.ci/setup.sh program

prelight=build/bin/prelight
out=build/start
mkdir -p "$out"

# newer FILE THAN: FILE is there and at least as new.
newer() { [ -f "$1" ] && [ ! "$2" -nt "$1" ]; }

# produce FILE FROM COMMAND...: runs a command, unless FILE is newer than what it is made from.
produce() {
  local file="$out/$1" from="$2"
  shift 2
  newer "$file" "$from" || "$prelight" "$@" -o "$file"
}

room="$out/room.glb"
sun=directional:-0.389,-0.559,0.732:75,68,57:angle=0.53
produce shapes.glb "$prelight" scene shapes
produce baked.glb "$out/shapes.glb" bake "$out/shapes.glb" --ao --sh 4 --bounces 2
produce before.png "$out/baked.glb" render "$out/shapes.glb" --shading phong
produce after.png "$out/baked.glb" render "$out/baked.glb" --shading sh
produce room.glb "$prelight" scene salon
produce unlit.png "$room" render "$room" --shading phong --debug albedo --size 480x270
echo "Light fills the room: three pictures of about 20 seconds each on two cores"
noon=(--shading full --size 480x270 --exposure 0.35 --env preetham:3:34:28 --light "$sun")
produce noon.png "$room" render "$room" "${noon[@]}"
produce moved.png "$room" render "$room" "${noon[@]}" --move Chair:-0.7,0,0.3:100 --move "Chair seat:-0.7,0,0.3:100"
produce evening.png "$room" render "$room" --shading full --size 480x270

echo
echo "A room without light, at noon, by its lamp:  $out/unlit.png, $out/noon.png, $out/evening.png"
echo "The room with its chair moved:               $out/moved.png"
echo "A scene before and after its bake:           $out/before.png, $out/after.png"
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && [ -z "${CI:-}" ]; then
  echo "Opening the viewer on $out/baked.glb (press H in it for its keys)"
  exec "$prelight" view "$out/baked.glb"
fi
echo "With a display, look around in them:         $prelight view $out/baked.glb, $prelight view $room"
