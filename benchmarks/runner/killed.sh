#!/usr/bin/env bash
# sediment, make and ninja, killed at random moments of a small pipeline and run again: does the rerun end with the bytes of
# an undisturbed run, without hand work? Printed as Markdown.
#
# usage: benchmarks/runner/killed.sh [ROUNDS] [SEED]     (200 rounds of each runner take about 15 minutes)
#
# Four stages, of which the last two both read the second; each takes 0.1 s, writes 400 kB in place, piece by piece, and every byte depends
# on every byte it has read. Killed are in turn the runner, its stages, both (kill -9), and the runner is asked to end
# (SIGTERM, ^C), each with its stages where a terminal would tell them too.
set -uo pipefail
rounds=${1:-200} RANDOM=${2:-1}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
bin=${SEDIMENT_BIN:-$root/build/release/bin}
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
cd "$tmp" || exit 1
flags="--kilobytes=400 --seconds=0.1"

# make_tree DIR: the same pipeline for every runner. Absolute paths: so the processes of a tree are known.
make_tree() {
  local here=$tmp/$1 step in
  mkdir -p "$here/bin" "$here/out"
  echo start >"$here/start.txt"
  for step in 1 2 3 4; do cp "$bin/trivial_stage" "$here/bin/step$step"; done
  printf 'rule step\n  command = %s/bin/$step --text $in --out $folder %s\n' "$here" "$flags" >"$here/build.ninja"
  printf 'all: %s\n' "$here"/out/step{1,2,3,4}/text.txt >"$here/Makefile"
  printf 'sources: {start: {kind: file, path: start.txt}}\nstages:\n' >"$here/pipeline.yaml"
  in=$here/start.txt
  for step in 1 2 3 4; do
    [ "$step" != 4 ] || in=$here/out/step2/text.txt
    printf 'build %s/out/step%s/text.txt: step %s\n  step = step%s\n  folder = %s/out/step%s\n' \
      "$here" $step "$in" $step "$here" $step >>"$here/build.ninja"
    printf '%s/out/step%s/text.txt: %s\n\t%s/bin/step%s --text $< --out %s/out/step%s %s\n' \
      "$here" $step "$in" "$here" $step "$here" $step "$flags" >>"$here/Makefile"
    printf '  step%s: {reads: {text: %s}, params: {kilobytes: 400, seconds: 0.1}}\n' \
      $step "$([ $step = 1 ] && echo start || echo "step$([ $step = 4 ] && echo 2 || echo $((step - 1))).text")" >>"$here/pipeline.yaml"
    in=$here/out/step$step/text.txt
  done
}

# start_run RUNNER DIR: in the background. A shell ignores ^C for what it starts there, so that it is switched on again.
start_run() {
  local call
  case $1 in
    sediment) call=("$bin/sediment" run "$tmp/$2/pipeline.yaml" --stages "$tmp/$2/bin" --out "$tmp/$2/out" -j2) ;;
    make) call=(make -C "$tmp/$2" -j2) ;;
    ninja) call=(ninja -C "$tmp/$2" -j2) ;;
  esac
  env --default-signal=INT "${call[@]}" >"$2/log" 2>&1 &
}
stages_of() { pgrep -f "^$tmp/$1/bin/step"; }
digests() { sha256sum "$1"/out/step?/text.txt 2>/dev/null | cut -c1-64; }
now_ms() { echo $(($(date +%s%N) / 1000000)); }

# strike RUNNER_PID DIR WHO
strike() {
  local stages
  stages=$(stages_of "$2")
  # shellcheck disable=SC2086
  case $3 in
    runner) kill -9 "$1" ;;
    stage) kill -9 $stages ;;
    both) kill -9 "$1" $stages ;;
    *) kill -"$3" "$1" ;;
  esac 2>/dev/null
}

declare -A right wrong refused orphans
# one_round RUNNER DIR WHO
one_round() {
  local runner=$1 dir=$2 who=$3 delay pid ended=0 orphan=0
  make_tree "$dir"
  delay=$((RANDOM * (length_ms + 50) / 32768))
  start_run "$runner" "$dir"
  pid=$!
  sleep "$(printf '%d.%03d' $((delay / 1000)) $((delay % 1000)))"
  strike "$pid" "$dir" "$who"
  wait "$pid" 2>/dev/null
  [ -z "$(stages_of "$dir")" ] || { sleep 0.02; [ -z "$(stages_of "$dir")" ] || orphan=1; }
  start_run "$runner" "$dir"
  wait $! || ended=1
  while [ -n "$(stages_of "$dir")" ]; do sleep 0.05; done
  # The run after the rerun: what is wrong by then stays wrong.
  start_run "$runner" "$dir"
  wait $! || ended=1
  local key=$runner.$who
  orphans[$key]=$((${orphans[$key]:-0} + orphan))
  if [ $ended = 1 ]; then refused[$key]=$((${refused[$key]:-0} + 1))
  elif [ "$(digests "$dir")" = "$reference" ]; then right[$key]=$((${right[$key]:-0} + 1))
  else wrong[$key]=$((${wrong[$key]:-0} + 1)); fi
  rm -rf "${tmp:?}/$dir"
}

make_tree reference
began=$(now_ms)
start_run sediment reference
wait $! || { cat reference/log; exit 1; }
length_ms=$(($(now_ms) - began))
reference=$(digests reference)
victims=(runner stage both TERM INT)
for runner in sediment make ninja; do
  for ((round = 0; round < rounds; ++round)); do one_round "$runner" "$runner$round" "${victims[round % 5]}"; done
done

echo "| runner | struck | rounds | right bytes after the rerun | wrong bytes that stay | rerun fails | a stage lived on |"
echo "|---|---|---|---|---|---|---|"
for runner in sediment make ninja; do
  for who in "${victims[@]}"; do
    key=$runner.$who
    r=${right[$key]:-0} w=${wrong[$key]:-0} f=${refused[$key]:-0}
    echo "| $runner | $who | $((r + w + f)) | $r | $w | $f | ${orphans[$key]:-0} |"
  done
done 2>&1
