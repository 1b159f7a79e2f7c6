#!/usr/bin/env bash
# scripts/run_tum.sh as a user calls it: own folder, own masks, own poses, blanks in every path, from anywhere.
# usage: run_tum_test.sh FLAKY_HTTP_SERVER
# shellcheck source=tests/pipeline_end_to_end/small_scene.sh
source "$(dirname "$0")/small_scene.sh"
run_tum=$root/scripts/run_tum.sh
scene="$tmp/my scene"
make_scene "$scene"
masks="$scene/truth/instances"
mkdir "$tmp/else where"
cd "$tmp/else where" || exit 1
export MODEL=/nowhere.onnx POSES=/nowhere.txt  # only flags count

run "$run_tum" --data "../my scene" --masks "../my scene/truth/instances" --out "my maps"
check "it maps a folder with masks of the user's own" same "$code" 0
for file in track/trajectory.txt fuse/cloud.pcd sor/cloud.pcd voxel/cloud.pcd octree/map.ot octree/map.bt \
  project2d/map.pgm project2d/map.yaml; do
  check "it leaves $file" test -s "my maps/$file"
  check "its table lists $file" says "$file"
done
for stage in $stages; do check "it leaves the manifest of $stage" test -s "my maps/$stage/manifest.json"; done
stamp=$(awk '!/^#/ { print $1; exit }' "$scene/rgb.txt")
check "a mask has the name of its colour stamp" test -s "my maps/segment/masks/$stamp.png"
check "a dynamic mask has the name of its colour stamp" test -s "my maps/interaction-mask/masks/$stamp.png"
check "it evaluates the trajectory against the truth" says ATE
check "it says how much of the sequence that covers" says coverage

run "$run_tum" --data "$scene" --masks "$masks" --poses "$scene/groundtruth.txt" --out "my maps" -j 1 \
  --set voxel.leaf=0.05 --pipeline "$paper"
check "it takes poses of the user's own" same "$code" 0
check "and keeps what they do not touch" grep -qE 'segment +kept' <<<"$output"
check "and uses them: poses of the truth have no error" grep -qE 'ATE +24( +0\.000000){6}' <<<"$output"

# A sequence of the benchmark, from a server that breaks off after every 600 kB.
mkdir -p "$tmp/site/freiburg3"
tar -czf "$tmp/site/freiburg3/rgbd_dataset_freiburg3_walking_xyz.tgz" -C "$tmp" \
  --transform 's,^my scene,rgbd_dataset_freiburg3_walking_xyz,' --exclude truth "my scene"
"$1" "$tmp/site" 600000 >"$tmp/requests" &
await "$tmp/requests"
SEDIMENT_TUM_URL=http://127.0.0.1:$(head -n 1 "$tmp/requests") SEDIMENT_DATA="$tmp/down loads" \
  run "$run_tum" fr3/w/xyz --masks "$masks" --out "my maps"
check "it downloads a sequence of the benchmark by its name and maps it" same "$code" 0
check "in pieces, since the server breaks off" test "$(wc -l <"$tmp/requests")" -gt 2
check "the same frames at another place are nothing new" grep -qE 'track +kept' <<<"$output"

# camera TEXT: a folder with that camera.txt and nothing of a sequence but the lists of none.
camera() { rm -rf "$tmp/c"; mkdir "$tmp/c"; touch "$tmp/c/rgb.txt" "$tmp/c/depth.txt"; printf '%s' "$1" >"$tmp/c/camera.txt"; }
camera "525 525 319.5 239.5 640"
refuses "a camera with too few numbers" 2 "found 5 values" "$run_tum" --data "$tmp/c" --masks "$masks" --out "$tmp/o"
camera "525 525 319.5 x 640 480 5000"
refuses "a camera with a word" 2 "found x" "$run_tum" --data "$tmp/c" --masks "$masks" --out "$tmp/o"
camera "# only a comment"
refuses "a camera file without a camera" 2 "found none" "$run_tum" --data "$tmp/c" --masks "$masks" --out "$tmp/o"
camera "525 525 319.5 239.5 640 480 5000 0.1 0.2 0.3 0.4"
"$run_tum" --data "$tmp/c" --masks "$masks" --out "$tmp/o" >/dev/null 2>&1
check "a camera with four distortion values" grep -q 'distortion: \[0.1, 0.2, 0.3, 0.4, 0\]' "$tmp/o/sequence.yaml"
rm "$tmp/c/camera.txt"
refuses "a folder without a camera names the three ways" 2 "one of three ways: --camera fr1|fr2|fr3|FILE; a file" \
  "$run_tum" --data "$tmp/c" --masks "$masks" --out "$tmp/o"
mv "$tmp/c" "$tmp/rgbd_dataset_freiburg2_mine"
"$run_tum" --data "$tmp/rgbd_dataset_freiburg2_mine" --masks "$masks" --out "$tmp/o" >/dev/null 2>&1
check "a folder's name can name its camera" grep -q 'cameras/freiburg2.yaml' "$tmp/o/sequence.yaml"

refuses "neither a network nor masks" 2 "--model FILE" "$run_tum" --data "$scene"
refuses "no sequence" 2 "which sequence?" "$run_tum" --masks "$masks"
refuses "an unknown sequence" 2 "unknown sequence fr9/xyz" "$run_tum" fr9/xyz --masks "$masks"
refuses "a folder that is not there" 2 "nowhere does not exist" "$run_tum" --data "$tmp/nowhere" --masks "$masks"
refuses "a network that is not there" 2 "--model: n.onnx does not exist" "$run_tum" --data "$scene" --model n.onnx
refuses "a folder without lists" 2 "it has no rgb.txt" "$run_tum" --data "$tmp/else where" --camera fr1 --masks "$masks"
refuses "an unknown flag" 2 "unknown flag --pose" "$run_tum" --data "$scene" --pose x
refuses "an unknown parameter" 2 neighbors "$run_tum" --data "$scene" --masks "$masks" --out "$tmp/o" --set sor.neighbor=3
run "$run_tum" --help
check "--help succeeds" same "$code" 0
for flag in SEQUENCE --data --model --camera --pipeline --masks --poses --set -j --out; do
  check "--help explains $flag" says "$flag"
done
finish
