#!/usr/bin/env bash
# All eight stages on a small synthetic sequence: what runs, what is kept, what is refused, and who can read the maps.
# usage: pipeline_test.sh FOREIGN_READERS
# shellcheck source=tests/pipeline_end_to_end/small_scene.sh
source "$(dirname "$0")/small_scene.sh"
readers=$1
make_scene "$tmp/scene"
export SEQUENCE=$tmp/scene MASKS=$tmp/scene/truth/instances
unset MODEL POSES
out=$tmp/out

# states STATE: the stages that the last run's table lists in that state, in its order.
states() { awk -v state="$1" '$1 ~ /^[a-z][a-z0-9-]*$/ && $2 == state { printf "%s ", $1 }' <<<"$output"; }

run map "$out" --set sor.neighbor=30
check "a mistyped parameter is a wrong call" same "$code" 2
check "the message names the parameter that was meant" says neighbors
check "nothing has run before it is refused" test ! -e "$out/segment"

run map "$out"
check "all eight stages run" same "$code" 0
check "each of them ran" same "$(states ran)" "$stages "
check "PCL, OctoMap and a strict map_server read the maps" "$readers" "$out"

before=$(results "$out")
run map "$out"
check "a second run succeeds" same "$code" 0
check "a second run starts nothing" same "$(states ran)" ""
check "a second run keeps every stage" same "$(states kept)" "$stages "

touch "$tmp"/scene/rgb/* "$tmp"/scene/*.txt
run map "$out"
check "touched files start nothing" same "$(states ran)" ""

run "$bin/sediment" plan "$paper" --out "$out" --set segment.engine=given --set sor.neighbors=30
check "plan names the changed parameter" says sor
check "plan changes nothing" same "$(results "$out")" "$before"
run "$bin/sediment" why "$paper" sor --out "$out" --set segment.engine=given --set sor.neighbors=30
check "why names the parameter" says neighbors
run map "$out" --set sor.neighbors=30
check "a changed parameter of sor reruns sor and what is behind it" same "$(states ran)" "sor voxel octree project2d "
check "and keeps what is before it" same "$(states kept)" "segment interaction-mask track fuse "
run map "$out"
check "changed back, everything is still there" same "$(states ran)" ""
check "with the bytes of before" same "$(results "$out")" "$before"
finish
