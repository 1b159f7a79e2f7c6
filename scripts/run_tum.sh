#!/usr/bin/env bash
# Maps one RGB-D sequence in the layout of the TUM benchmark: camera trajectory, semantic cloud, octree, grid map.
#
# usage: scripts/run_tum.sh SEQUENCE | --data DIR  --model FILE | --masks DIR  [flags]
#
# what to map
#   SEQUENCE             a sequence of the benchmark: freiburg1_xyz, fr1/xyz, rgbd_dataset_freiburg1_xyz; it is downloaded
#                        if it is not there yet (scripts/download_tum.sh --list names all)
#   --data DIR           a folder of your own, used as it is: rgb.txt and depth.txt (lines "stamp file") with their images,
#                        and, if you have it, groundtruth.txt (lines "stamp tx ty tz qx qy qz qw")
#   --camera CAMERA      fr1, fr2, fr3 (the cameras of the benchmark) or a file: a camera in YAML or one line
#                        "fx fy cx cy width height depth_scale [k1 k2 p1 p2 [k3]]". Without it: camera.txt in the folder
#                        (such a line), else the folder's name (freiburg1, freiburg2, freiburg3)
# who is in the pictures
#   --model FILE         a YOLOv8-seg or YOLO11-seg network exported to ONNX
#   --masks DIR          instance masks of your own instead of a network (formats: stages/segment/README.md)
# how
#   --pipeline PIPELINE  full (default), paper (the paper's method, nothing more), baseline (without masks) or a YAML file
#   --poses FILE         a camera trajectory of your own in TUM format instead of tracking
#   --set STAGE.PARAM=V  a parameter, as often as you like; `build/release/bin/STAGE --help` names them
#   -j N                 stages that may run at once
#   --out DIR            results, one folder per stage: default out/NAME in the checkout. Run again with the same folder:
#                        what has not changed is kept
#
# example
#   scripts/run_tum.sh fr3/walking_xyz --model yolov8s-seg.onnx --set voxel.leaf=0.02
#
# Exit code: 0 all done, 1 something failed (the message names it), 2 the call is wrong, 130 interrupted.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
bin=${SEDIMENT_BIN:-$root/build/release/bin}

program=run_tum
# shellcheck source=scripts/tum_sequence.sh
source "$root/scripts/tum_sequence.sh"
existing() { [ -e "$2" ] || wrong_call "$1: $2 does not exist"; realpath -s "$2"; }

# evaluate TRUTH FOLDER: error of the trajectory; without numbers if there are none to have.
evaluate() {
  local text
  if text=$("$bin/evaluate-trajectory" "$1" "$2/track/trajectory.txt" 2>&1); then
    printf '\nTrajectory against %s\n%s\n' "$1" "$text"
  else
    printf '\nTrajectory not evaluated: %s\n' "$text"
  fi
}

name='' data='' camera='' pipeline=full out='' model='' masks='' poses='' settings=() flags=()
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
    --data | --camera | --model | --masks | --poses | --pipeline | --set | -j | --out)
      [ $# -gt 1 ] || wrong_call "$1 needs a value"
      case "$1" in
        --data) data=$(existing --data "$2") ;;
        --model) model=$(existing --model "$2") ;;
        --masks) masks=$(existing --masks "$2") ;;
        --poses) poses=$(existing --poses "$2") ;;
        --camera) camera=$2 ;;
        --pipeline) pipeline=$2 ;;
        --set) settings+=(--set "$2") ;;
        -j) flags+=(-j "$2") ;;
        --out) out=$(realpath -m "$2") ;;
      esac
      shift ;;
    -j[0-9]*) flags+=("$1") ;;
    -*) wrong_call "unknown flag $1" ;;
    *) [ -z "$name" ] || wrong_call "two sequences: $name and $1"; name=$1 ;;
  esac
  shift
done

case "$pipeline" in
  paper | full | baseline) config=$root/configs/$pipeline/pipeline.yaml ;;
  *) config=$(existing --pipeline "$pipeline") ;;
esac
[ -f "$config" ] || wrong_call "--pipeline $pipeline: there is no $config"
if [ -z "$model$masks" ] && grep -qF '${MODEL}' "$config"; then
  wrong_call "who is in the pictures? --model FILE (a network) or --masks DIR (masks of your own)"
fi
if [ -n "$masks" ] && ! grep -qF '${MASKS}' "$config"; then wrong_call "$config reads no masks"; fi
if [ -n "$poses" ] && ! grep -qF '${POSES}' "$config"; then wrong_call "$config reads no poses"; fi
if [ -n "$name" ] && [ -n "$data" ]; then wrong_call "a sequence's name ($name) or --data, not both"; fi
if [ -z "$data" ]; then
  [ -n "$name" ] || wrong_call "which sequence? a name of the benchmark or --data DIR"
  [ ! -d "$name" ] || wrong_call "$name is a folder: --data $name"
  data=$("$root/scripts/download_tum.sh" "$name")
fi
[ -d "$data" ] || wrong_call "--data: $data is no folder"
out=${out:-$root/out/$(basename "$data")}
camera=$(camera_of "$camera" "$data")

if [ ! -x "$bin/sediment" ]; then
  "$root/scripts/setup.sh"
  "$root/scripts/build.sh" programs
fi

# What is given takes the place of what would be computed; --set on the command line has the last word.
unset MODEL MASKS POSES
export SEQUENCE=$out/sequence.yaml
if [ -n "$masks" ]; then export MASKS=$masks; settings=(--set segment.engine=given "${settings[@]}"); fi
if [ -n "$model" ] && [ -z "$masks" ]; then export MODEL=$model; fi
if [ -n "$poses" ]; then export POSES=$poses; settings=(--set track.engine=given "${settings[@]}"); fi

mkdir -p "$out"
write_sequence "$data" "$camera" "$SEQUENCE"
"$bin/sediment" run "$config" --out "$out" "${flags[@]}" "${settings[@]}"

[ ! -f "$data/groundtruth.txt" ] || evaluate "$data/groundtruth.txt" "$out"
echo
"$root/scripts/list_results.sh" "$out"
