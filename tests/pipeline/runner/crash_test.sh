#!/usr/bin/env bash
# Kills a run at random moments and runs it again: it must end with the bytes of an undisturbed run, without any hand
# work, and nothing may be left that still writes.
#
# usage: crash_test.sh [ROUNDS] [SEED]      (a round takes about a second; the benchmark does 200)
# shellcheck source=tests/support/script_test.sh
source "$(dirname "$0")/../../support/script_test.sh"
rounds=${1:-15} RANDOM=${2:-1}
cd "$tmp" || exit 1

mkdir stages data
for stage in scan smooth thin chart; do ln -s "$SEDIMENT_BIN/fake_stage" stages/$stage; done
echo "root: ." >data/sequence.yaml
cat >pipeline.yaml <<'YAML'
sources: {sequence: {kind: sequence, path: data}}
stages:
  scan:   {reads: {sequence: sequence}, params: {padding_mb: 4, sleep_s: 0.1}}
  smooth: {reads: {cloud: scan.cloud}, params: {padding_mb: 4, sleep_s: 0.1}}
  thin:   {reads: {cloud: smooth.cloud}, params: {padding_mb: 4, sleep_s: 0.1}}
  chart:  {reads: {cloud: smooth.cloud, second: thin.cloud}, params: {padding_mb: 4, sleep_s: 0.1}}
YAML

# A shell ignores ^C for what it starts in the background.
start_run() { env --default-signal=INT "$SEDIMENT_BIN/sediment" run pipeline.yaml --stages stages --out "$1" >"$1.log" 2>&1 & }
bytes_of() { (cd "$1" && sha256sum -- */* | sort -k2); }
# Processes that have the folder in their command line.
left_over() { pgrep -f "$tmp/$1/[.]sediment"; }
now_ms() { echo $(($(date +%s%N) / 1000000)); }

began=$(now_ms)
start_run reference
wait $!
length_ms=$(($(now_ms) - began))
bytes_of reference >reference.sha256
check "an undisturbed run ends well" test "$(wc -l <reference.sha256)" = 16

# strike RUNNER WHO: kills the runner, one of its stages, or both; or asks the runner to end.
strike() {
  local stages
  stages=$(pgrep -P "$1")
  # shellcheck disable=SC2086
  case "$2" in
    runner) kill -9 "$1" ;;
    stage) kill -9 $stages ;;
    both) kill -9 "$1" $stages ;;
    *) kill -"$2" "$1" ;;
  esac 2>/dev/null
}

# one_round NUMBER WHO
one_round() {
  local out=out$1 delay runner
  delay=$((RANDOM * (length_ms + 50) / 32768))
  start_run "$out"
  runner=$!
  sleep "$(printf '%d.%03d' $((delay / 1000)) $((delay % 1000)))"
  strike "$runner" "$2"
  wait "$runner"
  start_run "$out"
  wait $! || { echo "the rerun after killing $2 at $delay ms failed"; cat "$out.log"; return 1; }
  bytes_of "$out" | cmp - reference.sha256 || { echo "other bytes after killing $2 at $delay ms"; return 1; }
  ! left_over "$out" || { echo "something is left running after killing $2 at $delay ms"; return 1; }
  # A stage may outlive its killed runner by a moment and write into its dead attempt: that goes with the run after.
  start_run "$out"
  wait $! || { echo "the run after the rerun failed"; cat "$out.log"; return 1; }
  [ -z "$(ls -A "$out/.sediment/attempts")" ] || { echo "leftovers in the store after killing $2 at $delay ms:"; ls -lR "$out/.sediment/attempts"; cat "$out.log"; return 1; }
  rm -rf "$out" "$out.log"
}

killed() {
  local round who=(runner stage both TERM INT)
  for ((round = 0; round < rounds; ++round)); do one_round "$round" "${who[round % 5]}" || return 1; done
}
check "$rounds runs, killed at random moments, end with the right bytes when run again" killed
finish
