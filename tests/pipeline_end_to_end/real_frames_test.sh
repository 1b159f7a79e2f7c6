#!/usr/bin/env bash
# A dozen real frames with a real network through all eight stages.
# usage: real_frames_test.sh FOREIGN_READERS
# shellcheck source=tests/pipeline_end_to_end/small_scene.sh
source "$(dirname "$0")/small_scene.sh"
readers=$1
shared=${SEDIMENT_SHARED:-$root/../shared}
for needed in tum/rgbd_dataset_freiburg1_rpy_person models/yolov8n-seg-320.onnx; do
  [ -e "$shared/$needed" ] || { echo "skipped: needs shared/$needed"; exit 0; }
done
recorded=$shared/tum/rgbd_dataset_freiburg1_rpy_person

# The first twelve frames; the folder's name says whose camera it is.
short=$tmp/freiburg1_short
mkdir "$short"
ln -s "$recorded/rgb" "$recorded/depth" "$recorded/groundtruth.txt" "$short/"
for list in rgb depth; do grep -v '^#' "$recorded/$list.txt" | head -n 12 >"$short/$list.txt"; done

run "$root/scripts/run_tum.sh" --data "$short" --model "$shared/models/yolov8n-seg-320.onnx" --out "$tmp/out"
check "all stages run" same "$code" 0
[ "$code" = 0 ] || printf '%s\n' "$output"
check "others can read the maps" "$readers" "$tmp/out"
check "every frame has a pose" same "$(grep -vc '^#' "$tmp/out/track/trajectory.txt")" 12
check "the seated person is found" grep -q '"person"' "$tmp/out/segment/instances.json"
check "the trajectory is evaluated" says ATE
finish
