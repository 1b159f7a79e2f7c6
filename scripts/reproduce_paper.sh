#!/usr/bin/env bash
# The paper's tables of file sizes (dense cloud, + SOR, + voxel filter, octree), its bar chart (Figure 21), and what it does
# not say: which voxel size, resolution and keyframes give its ratios.
#
# usage: scripts/reproduce_paper.sh [--data DIR]... [--model FILE] [--out DIR] [--page FILE] [-j N]
#   --data DIR    recordings in TUM layout, or a folder of them: the paper's sequences are found by their names, those that
#                 are not there are listed as missing, others stand in for them under their own names
#   --model FILE  a YOLOv8-seg network exported to ONNX, for what --data names
#   --out DIR     where everything goes: default out/paper. Run again: what has not changed is kept
#   --page FILE   also write the page here, with its chart and the list of receipts beside it
#
# A synthetic room with walking people, with the masks of its renderer, is always mapped too. What the
# paper measured are eight sequences of the TUM RGB-D benchmark: scripts/download_tum.sh fetches them into data/.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
bin=${SEDIMENT_BIN:-$root/build/release/bin}
fail() { echo "reproduce_paper: $*" >&2; exit 1; }
wrong_call() { echo "reproduce_paper: $* (--help explains)" >&2; exit 2; }

call="scripts/reproduce_paper.sh" model='' out=$root/out/paper page='' flags=() data=()
while [ $# -gt 0 ]; do
  case "$1" in
    -h | --help) sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "$0"; exit 0 ;;
    --data | --model | --out | --page | -j)
      [ $# -gt 1 ] || wrong_call "$1 needs a value"
      case "$1" in
        --data) data+=(--data "$2") call+=" --data $(basename "$2")" ;;
        --model) model=$2 call+=" --model $(basename "$2")" ;;
        --out) out=$(realpath -m "$2") ;;
        --page) page=$(realpath -m "$2") ;;
        -j) flags+=(-j "$2") ;;
      esac
      shift ;;
    -j[0-9]*) flags+=("$1") ;;
    *) wrong_call "unknown argument $1" ;;
  esac
  shift
done
if [ ${#data[@]} -gt 0 ]; then
  [ -n "$model" ] || wrong_call "--data needs --model FILE, a network"
  flags+=("${data[@]}" --model "$model")
fi
if [ ! -x "$bin/tabulate" ]; then
  "$root/scripts/setup.sh"
  "$root/scripts/build.sh" programs
fi

mkdir -p "$out"
scene=$out/synthetic/synthetic_walking
made="walking 60 $(sha256sum <"$bin/synthesize")"
if [ "$(cat "$scene.made" 2>/dev/null)" != "$made" ]; then
  rm -rf "$scene" "$scene.made"
  "$bin/synthesize" walking --out "$scene" --frames 60 --rate 10 >/dev/null
  echo "$made" >"$scene.made"
fi
"$root/scripts/sweep.sh" paper --rendered "$out/synthetic" "${flags[@]}" --out "$out/sweeps" --facts-only

facts=$out/sweeps/facts bands=()
for file in "$facts"/band_*.json; do bands+=(--band "$file"); done
commit=$(git -C "$root" rev-parse --short HEAD 2>/dev/null || echo unknown)
[ -z "$(git -C "$root" status --porcelain 2>/dev/null)" ] || commit="$commit with changes"
{
  cat <<TEXT
# The paper's file sizes

Made by \`$call\` at commit $commit, on $(nproc) cores ($(uname -m)). Recordings whose names begin with twin_ are rendered, those with
synthetic_ are drawn by \`synthesize\`: their figures are never figures on the TUM benchmark.

TEXT
  "$bin/tabulate" paper "$facts"/sizes.*.json "${bands[@]}" --out "$out/paper"
  cat <<TEXT

Where each figure comes from: paper_receipts.csv names the receipts of fuse, sor, voxel and octree behind every row. A receipt
(\`receipts/\` in the store) holds parameters, inputs, program and exact call; \`sediment table\` prints sizes from them.
TEXT
} >"$out/paper.md"
cat "$out/paper.md"
if [ -n "$page" ]; then
  mkdir -p "$(dirname "$page")"
  cp "$out/paper.md" "$page"
  cp "$out/paper_sizes.svg" "$out/paper_receipts.csv" "$(dirname "$page")/"
fi
