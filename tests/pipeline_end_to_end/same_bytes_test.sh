#!/usr/bin/env bash
# The same inputs and parameters give the same bytes: from two cold stores, and with one and with four threads.
# shellcheck source=tests/pipeline_end_to_end/small_scene.sh
source "$(dirname "$0")/small_scene.sh"
make_scene "$tmp/scene"
export SEQUENCE=$tmp/scene MASKS=$tmp/scene/truth/instances
unset MODEL POSES
a=$tmp/a b=$tmp/b

make_scene "$tmp/again"
check "the scene itself has equal bytes" diff -rq "$tmp/scene" "$tmp/again"
check "a first cold run succeeds" map "$a"
check "a second cold run succeeds" map "$b"
check "two cold runs give equal manifests" diff <(results "$a") <(results "$b")
for stage in $stages; do check "two cold runs give equal bytes of $stage" diff -r "$a/$stage" "$b/$stage"; done

# alone THREADS STAGE ARGUMENT...: a stage called by hand on the results of the first run.
alone() { "$bin/$2" "${@:3}" --threads "$1" --out "$tmp/threads$1/$2"; }
each_stage_alone() {
  mkdir -p "$tmp/threads$1"
  alone "$1" segment --sequence "$SEQUENCE" --masks "$MASKS" --engine given &&
    alone "$1" interaction-mask --sequence "$SEQUENCE" --masks "$a/segment" &&
    alone "$1" track --sequence "$SEQUENCE" --dynamic "$a/interaction-mask" --still_features false --smoothing false &&
    alone "$1" fuse --sequence "$SEQUENCE" --masks "$a/segment" --dynamic "$a/interaction-mask" --trajectory "$a/track" &&
    alone "$1" sor --cloud "$a/fuse" &&
    alone "$1" voxel --cloud "$a/sor" &&
    alone "$1" octree --cloud "$a/voxel" &&
    alone "$1" project2d --cloud "$a/voxel"
}
check "every stage runs by hand with one thread" each_stage_alone 1
check "every stage runs by hand with four threads" each_stage_alone 4
for stage in $stages; do
  check "$stage gives the same bytes with one and with four threads" diff -r "$tmp/threads1/$stage" "$tmp/threads4/$stage"
done
check "a stage called by hand gives what the runner gives" diff <(results "$tmp/threads1") <(results "$a")
finish
