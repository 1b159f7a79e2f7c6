#!/usr/bin/env bash
# From a fresh clone to maps: set-up, build, a synthetic room with walking people, the whole pipeline, pictures.
#
# usage: scripts/demo.sh [--frames N] [--out DIR]
#   --frames N   length of the sequence at 30 frames a second (default 120)
#   --out DIR    where everything goes (default out/demo)
#
# No network can ship with Sediment (YOLO weights are AGPL-3.0), so the renderer's masks take its place. Run it again: all
# that has not changed is kept.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

frames=120 out=$root/out/demo
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
    --frames | --out)
      [ $# -gt 1 ] || { echo "demo: $1 needs a value" >&2; exit 2; }
      if [ "$1" = --frames ]; then frames=$2; else out=$(realpath -m "$2"); fi
      shift ;;
    *) echo "demo: unknown argument $1 (--help explains)" >&2; exit 2 ;;
  esac
  shift
done

"$root/scripts/setup.sh"
"$root/scripts/build.sh" programs
bin=$root/build/release/bin
scene=$out/sequence maps=$out/maps pictures=$out/pictures

# The scene is made once for a program and a length; equal flags give equal bytes.
made="walking $frames $(sha256sum <"$bin/synthesize")"
if [ "$(cat "$out/made" 2>/dev/null)" != "$made" ]; then
  rm -rf "$scene" "$out/made"
  mkdir -p "$out"
  "$bin/synthesize" walking --out "$scene" --frames "$frames"
  echo "$made" >"$out/made"
fi

"$root/scripts/run_tum.sh" --data "$scene" --masks "$scene/truth/instances" --out "$maps"

# picture FILE WHAT ARGUMENT...: pictures are drawn again only if a result or the program that draws them changed.
drawn=$(cat "$maps"/*/manifest.json "$bin/render" | sha256sum)
fresh=false
[ "$(cat "$pictures/made" 2>/dev/null)" != "$drawn" ] || fresh=true
mkdir -p "$pictures"
picture() {
  local file=$pictures/$1 what=$2
  shift 2
  $fresh || "$bin/render" "$@" --out "$file"
  printf '  %-18s %s\n' "$(basename "$file")" "$what"
}
inside=(--ground "$maps/project2d" --max-height 2.2)

echo
echo "Pictures in $pictures"
picture masks.png "frames with their instances; what is dynamic is hatched" \
  masks --sequence "$maps/sequence.yaml" --masks "$maps/segment" --dynamic "$maps/interaction-mask"
picture cloud_top.png "the cloud from above, in the colours of its labels" \
  cloud "$maps/voxel" --view top --color label "${inside[@]}"
picture cloud.png "the cloud in the colours of the camera: nobody is left in it" \
  cloud "$maps/voxel" --view oblique --color image "${inside[@]}"
picture octree.png "the octree's occupied leaves" octree "$maps/octree" --view oblique --color label "${inside[@]}"
picture grid.png "the navigation grid" grid "$maps/project2d"
picture trajectory.png "the camera's path against the truth" \
  trajectory "$maps/track" --truth "$scene/groundtruth.txt"
echo "$drawn" >"$pictures/made"

echo
"$bin/sediment" report "$maps" || echo "demo: no page (above is why); everything else is there"
cat <<TEXT

Run one stage, and what is behind it, with another parameter; the rest is kept:
  scripts/run_tum.sh --data $scene --masks $scene/truth/instances --out $maps --set sor.neighbors=30
TEXT
