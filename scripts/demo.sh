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
