#!/usr/bin/env bash
# Runs a sweep over recordings and leaves its tables: trajectory error, coverage, map quality, sizes, time, memory.
#
# usage: scripts/sweep.sh SWEEP --data DIR... [--model FILE] [--rendered DIR]... [flags]
#   SWEEP            a name in configs/sweeps (tum, ablation, parameters, parameters/sor), or a file or folder of such
#   --data DIR       a recording in TUM layout, or a folder of recordings; as often as you like
#   --model FILE     a YOLOv8-seg or YOLO11-seg network exported to ONNX, for what --data names
#   --rendered DIR   the same as --data, but masks are those of its renderer (truth/instances)
#   --set STAGE.PARAM=V   a parameter in all of them
#   -j N             stages that may run at once
#   --out DIR        where everything goes: default out/sweeps/SWEEP. Run again: what has not changed is kept
#   --facts-only     stop before the tables: DIR/facts has what the receipts know
#
# DIR/tables/SWEEP.md, .csv and .tex have an instance a row, SWEEP_summary the median over the recordings. The receipts that
# a row stands on are in it; `sediment log` and the store's receipts/ tell the rest.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
bin=${SEDIMENT_BIN:-$root/build/release/bin}
program=sweep
# shellcheck source=scripts/tum_sequence.sh
source "$root/scripts/tum_sequence.sh"

# recordings DIR: the folders in TUM layout that DIR is or holds, with at least two frames.
recordings() {
  local list
  for list in "$1/rgb.txt" "$1"/*/rgb.txt; do
    if [ -f "$list" ] && [ -f "$(dirname "$list")/depth.txt" ]; then dirname "$list"; fi
  done
}

# add KIND DIR: writes the sequence file of each recording to OUT/sequences/KIND.
add() {
  local kind=$1 folder count=0 target
  [ -d "$2" ] || wrong_call "--$kind: $2 is no folder"
  while read -r folder; do
    count=$((count + 1))
    if [ "$(grep -cv '^#' "$folder/rgb.txt")" -lt 3 ] || [ "$(grep -cv '^#' "$folder/depth.txt")" -lt 3 ]; then
      echo "left out: $(basename "$folder"): fewer than three frames"
      continue
    fi
    target=$out/sequences/$kind
    if [ "$kind" = rendered ]; then
      [ -d "$folder/truth/instances" ] || fail "$folder has no masks of its renderer (truth/instances)"
      target=$target/$(basename "$folder")
    fi
    mkdir -p "$target"
    write_sequence "$folder" "$(camera_of "" "$folder")" "$target/$(basename "$folder").yaml"
  done < <(recordings "$(realpath -s "$2")")
  [ $count -gt 0 ] || wrong_call "--$kind: $2 holds no recording in TUM layout (rgb.txt, depth.txt)"
}

# sweep FILE LABEL ARGUMENT...: one call of the runner, and its facts.
sweep() {
  local file=$1 label=$2 results name
  shift 2
  name=$(basename "$file" .yaml)
  results=$out/results/$name/$label
  echo "== $name, $label"
  local code=0 log=$out/logs/$name.$label.log
  "$bin/sediment" sweep "$file" --out "$results" --store "$out/store" --keep-going "${flags[@]}" "$@" >"$log" 2>&1 || code=$?
  case $code in
    0) ;;
    1) failed+=("$name, $label: $log"); grep -m 5 -iE 'failed|error' "$log" >&2 || true ;;  # its rows will say so
    *) tail -n 20 "$log" >&2; exit $code ;;
  esac
  "$bin/sediment" report "$results" --store "$out/store" --facts "$out/facts/$name.$label.json"
}

sweep='' model='' out='' flags=() data=() rendered=() facts_only=false failed=()
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
    --facts-only) facts_only=true ;;
    --data | --model | --rendered | --out | --set | -j)
      [ $# -gt 1 ] || wrong_call "$1 needs a value"
      case "$1" in
        --data) data+=("$2") ;;
        --rendered) rendered+=("$2") ;;
        --model) [ -f "$2" ] || wrong_call "--model: $2 does not exist"; model=$(realpath -s "$2") ;;
        --out) out=$(realpath -m "$2") ;;
        *) flags+=("$1" "$2") ;;
      esac
      shift ;;
    -j[0-9]*) flags+=("$1") ;;
    -*) wrong_call "unknown flag $1" ;;
    *) [ -z "$sweep" ] || wrong_call "two sweeps: $sweep and $1"; sweep=$1 ;;
  esac
  shift
done
[ -n "$sweep" ] || wrong_call "which sweep? a name in configs/sweeps"
for place in "$sweep" "$root/configs/sweeps/$sweep" "$root/configs/sweeps/$sweep.yaml"; do
  if [ -e "$place" ]; then break; fi
done
[ -e "$place" ] || wrong_call "there is no sweep $sweep"
if [ -d "$place" ]; then files=("$place"/*.yaml); else files=("$place"); fi
name=$(basename "$place" .yaml)
[ ${#data[@]} -gt 0 ] || [ ${#rendered[@]} -gt 0 ] || wrong_call "which recordings? --data DIR or --rendered DIR"
out=${out:-$root/out/sweeps/$name}
if [ ! -x "$bin/sediment" ]; then
  "$root/scripts/setup.sh"
  "$root/scripts/build.sh" programs
fi

rm -rf "$out/sequences" "$out/facts"
mkdir -p "$out/facts" "$out/logs" "$out/tables"
for folder in "${data[@]}"; do add data "$folder"; done
for folder in "${rendered[@]}"; do add rendered "$folder"; done
unset MODEL MASKS POSES
for file in "${files[@]}"; do
  if [ -d "$out/sequences/data" ]; then
    # Only pipelines that mask anything need a network.
    pipeline=$(realpath "$(dirname "$file")/$(sed -n 's/^pipeline: *//p' "$file")")
    if grep -q MODEL "$pipeline/pipeline.yaml"; then
      [ -n "$model" ] || wrong_call "--data needs --model FILE, a network"
      MODEL=$model SEQUENCES=$out/sequences/data sweep "$file" data
    else
      SEQUENCES=$out/sequences/data sweep "$file" data
    fi
  fi
  for folder in "$out"/sequences/rendered/*/; do
    [ -d "$folder" ] || continue
    label=$(basename "$folder")
    given=()
    if grep -q MASKS "$(dirname "$file")/$(sed -n 's/^pipeline: *//p' "$file")/pipeline.yaml"; then given=(--set segment.engine=given); fi
    recording=$(sed -n 's/^root: "\(.*\)"$/\1/p' "$folder/$label.yaml")
    MASKS=$recording/truth/instances SEQUENCES=${folder%/} sweep "$file" "$label" "${given[@]}"
  done
done
if [ ${#failed[@]} -gt 0 ]; then printf 'some stages failed: %s\n' "${failed[@]}" >&2; fi
if $facts_only; then exit 0; fi
"$bin/tabulate" evaluation "$out"/facts/*.json --out "$out/tables/$name"
printf '\nTables in %s\n' "$out/tables"
