#!/usr/bin/env bash
# Sets up what is missing, builds, bakes a built-in scene and draws it before and after. Opens the viewer where there
# is a display.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

.ci/setup.sh program

prelight=build/bin/prelight
out=build/start
mkdir -p "$out"

# newer FILE THAN: FILE is there and at least as new.
newer() { [ -f "$1" ] && [ ! "$2" -nt "$1" ]; }

newer "$out/shapes.glb" "$prelight" || "$prelight" scene shapes -o "$out/shapes.glb"
newer "$out/baked.glb" "$out/shapes.glb" ||
  "$prelight" bake "$out/shapes.glb" -o "$out/baked.glb" --ao --sh 4 --bounces 2
newer "$out/before.png" "$out/baked.glb" ||
  "$prelight" render "$out/shapes.glb" -o "$out/before.png" --shading phong
newer "$out/after.png" "$out/baked.glb" ||
  "$prelight" render "$out/baked.glb" -o "$out/after.png" --shading sh

echo
echo "The scene without baked light:  $out/before.png"
echo "The scene with baked light:     $out/after.png"
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && [ -z "${CI:-}" ]; then
  echo "Opening the viewer on $out/baked.glb (press H in it for its keys)"
  exec "$prelight" view "$out/baked.glb"
fi
echo "With a display, look around in it:  $prelight view $out/baked.glb"
