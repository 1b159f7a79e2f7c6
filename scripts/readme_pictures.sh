#!/usr/bin/env bash
# Makes the pictures of README.md again: results/pictures/*.jpg, from the synthetic scene of scripts/demo.sh.
#
# usage: scripts/readme_pictures.sh
set -euo pipefail
case "${1-}" in -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;; esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/demo.sh
maps=out/demo/maps pictures=results/pictures
mkdir -p $pictures
build/release/bin/render masks --sequence $maps/sequence.yaml --masks $maps/segment --dynamic $maps/interaction-mask \
  --frames 30,70 --columns 2 --out $pictures/masks.jpg
build/release/bin/render cloud $maps/voxel --color image --ground $maps/project2d --max-height 2.2 --azimuth 12 \
  --elevation 30 --zoom 1.2 --size 1000x560 --out $pictures/cloud.jpg
build/release/bin/render octree $maps/octree --color label --ground $maps/project2d --max-height 2.2 --azimuth 12 \
  --elevation 30 --zoom 1.2 --size 1000x560 --out $pictures/octree.jpg
build/release/bin/render grid $maps/project2d --out $pictures/grid.png
build/release/bin/sediment report $maps
if command -v chromium >/dev/null && command -v node >/dev/null; then
  NODE_PATH=third_party/web/node_modules node tools/report/screenshot.mjs $maps/report.html $pictures/report.jpg
else
  echo "report.jpg stays as it is: needs chromium and node"
fi
ls -l $pictures
