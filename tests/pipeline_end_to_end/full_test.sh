#!/usr/bin/env bash
# All stages of configs/full on a small synthetic sequence: in which order they run, and what a change of movers touches.
# shellcheck source=tests/pipeline_end_to_end/small_scene.sh
source "$(dirname "$0")/small_scene.sh"
make_scene "$tmp/scene"
export SEQUENCE=$tmp/scene MASKS=$tmp/scene/truth/instances
unset MODEL POSES
out=$tmp/out

# full ARGUMENT...: the pipeline with the masks of the renderer.
full() { "$bin/sediment" run "$root/configs/full/pipeline.yaml" --out "$out" --set segment.engine=given "$@"; }
# states STATE: the stages that the last run's table lists in that state, in its order.
states() { awk -v state="$1" '$1 ~ /^[a-z][a-z0-9-]*$/ && $2 == state { printf "%s ", $1 }' <<<"$output"; }

run full
check "all eleven stages run" same "$code" 0
check "each of them ran, after what it reads" same "$(states ran)" \
  "segment repair interaction-mask track movers fuse carve sor voxel octree project2d "
check "movers leaves a mask for every frame" same "$(find "$out/movers/masks" -name "*.png" | wc -l)" 24

run full --set movers.min_area=1
check "a changed movers leaves the tracker and what is before it alone" same \
  "$(states kept | grep -oE 'segment repair interaction-mask track ')" "segment repair interaction-mask track "
finish
