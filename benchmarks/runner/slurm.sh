#!/usr/bin/env bash
# What Slurm adds: chains of 8 trivial stages, locally and through a Slurm of this machine in each way to pack them. Printed
# as Markdown.
#
# usage: benchmarks/runner/slurm.sh [CHAINS]     (default 100; needs root, slurm-wlm and munge)
set -euo pipefail
chains=${1:-100}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
bin=${SEDIMENT_BIN:-$root/build/release/bin}
# shellcheck source=tests/pipeline/runner/slurm/one_machine_slurm.sh
source "$root/tests/pipeline/runner/slurm/one_machine_slurm.sh"
missing=$(slurm_is_missing)
[ -z "$missing" ] || { echo "slurm.sh: ${missing#skipped: }" >&2; exit 1; }
tmp=$(mktemp -d)
trap 'scancel --user=root 2>/dev/null || true; stop_slurm; rm -rf "$tmp"' EXIT
cd "$tmp"

mkdir bin data
{
  printf 'sources: {sequence: {kind: file, path: data/0.txt}}\nstages:\n  step1: {reads: {text: sequence}}\n'
  for step in {2..8}; do printf '  step%d: {reads: {text: step%d.text}}\n' "$step" $((step - 1)); done
} >pipeline.yaml
for step in {1..8}; do cp "$bin/trivial_stage" "bin/step$step"; done
names=()
for ((chain = 0; chain < chains; ++chain)); do
  echo "$chain" >"data/$chain.txt"
  names+=("data/$chain.txt")
done
printf 'pipeline: pipeline.yaml\nover:\n  - sequence: [%s]\n' "$(IFS=,; echo "${names[*]}")" >sweep.yaml
printf 'partition: main\nin_flight: 32\ndefaults: {memory: 10 MB, time: 10m}\n' >profile.yaml
start_slurm "$tmp/slurm" || { echo "slurm.sh: Slurm does not start; its log:" >&2; tail -n 5 slurm/*.log >&2; exit 1; }

since() { awk -v a="$1" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.2f", b - a }'; }
logged() { "$@" >>log 2>&1 || { tail -n 20 log >&2; return 1; }; }
sweep() { "$bin/sediment" sweep sweep.yaml --stages bin --out "$@"; }
on_slurm() { sweep "$1" --backend slurm --profile profile.yaml --pack "${@:2}"; }
until_done() { until [ -z "$(squeue --noheader)" ]; do sleep 0.1; done; }

echo "| $((chains * 8)) tasks | submitted after, s | all done after, s |"
echo "|---|---|---|"
from=$EPOCHREALTIME
logged sweep local -j2
echo "| on this machine, two at a time | | $(since "$from") |"
for pack in sequence stage chunk:10; do
  from=$EPOCHREALTIME
  logged on_slurm "${pack/:/_}" "$pack"
  submitted=$(since "$from")
  until_done
  all=$(since "$from")
  kept=$(sweep "${pack/:/_}" | grep -o '[0-9]* kept in')
  [ "$kept" = "$((chains * 8)) kept in" ] || { echo "slurm.sh: $pack: $kept" >&2; exit 1; }
  echo "| \`--pack $pack\` | $submitted | $all |"
done
