#!/usr/bin/env bash
# A full disk, a read-only store and a run that would not fit: a clear error or the right result, nothing half.
# shellcheck source=tests/support/script_test.sh
source "$(dirname "$0")/../../support/script_test.sh"
cd "$tmp" || exit 1

mkdir stages data disk
for stage in scan smooth thin chart; do ln -s "$SEDIMENT_BIN/fake_stage" stages/$stage; done
echo "root: ." >data/sequence.yaml
cat >pipeline.yaml <<'YAML'
sources: {sequence: {kind: sequence, path: data}}
stages:
  scan:   {reads: {sequence: sequence}}
  smooth: {reads: {cloud: scan.cloud}}
  thin:   {reads: {cloud: smooth.cloud}}
  chart:  {reads: {cloud: smooth.cloud, second: thin.cloud}}
YAML
mount -t tmpfs -o size=16m tmpfs disk 2>/dev/null || { echo "skipped: needs the right to mount a small tmpfs"; exit 0; }
trap 'umount -l disk; rm -rf "$tmp"' EXIT

sediment() { "$SEDIMENT_BIN/sediment" "$@" --stages stages --out out --store disk/store; }
results() { find -L out -name text.txt | wc -l; }

# full_at STAGE RESULTS: the disk has no room for the result of the stage; those before it are published.
full_at() {
  rm -rf disk/store out
  local code=0
  sediment run pipeline.yaml --set "$1.padding_mb=40" >log 2>&1 || code=$?
  cat log
  [ "$code" = 1 ] && grep -q "$1: FAILED: .*the disk of .* is full" log &&
    [ "$(results)" = "$2" ] && [ -z "$(ls -A disk/store/attempts)" ] &&
    sediment run pipeline.yaml >log 2>&1 && [ "$(results)" = 4 ] && grep -q "$((4 - $2)) ran" log
}
check "a disk that gets full in the first stage is named, nothing is published, the next run goes on" full_at scan 0
check "the same in the second stage" full_at smooth 1
check "the same in the third stage" full_at thin 2
check "the same in the last stage" full_at chart 3

# The disk fills up while the runner itself writes: 0 .. 32 kB are free when the run begins.
full_for_the_runner() {
  local free_kb code
  for free_kb in 0 4 8 12 16 24 32; do
    rm -rf disk/store out disk/filler
    sediment run pipeline.yaml --until scan >/dev/null 2>&1
    dd if=/dev/zero of=disk/filler bs=1k count=$(($(df --output=avail -k disk | tail -1) - free_kb)) status=none 2>/dev/null
    code=0
    sediment run pipeline.yaml >log 2>&1 || code=$?
    [ "$code" = 1 ] || { echo "with $free_kb kB free: exit code $code"; cat log; return 1; }
    grep -q 'No space left on device\|is full' log || { echo "with $free_kb kB free:"; cat log; return 1; }
    rm disk/filler
    sediment run pipeline.yaml >log 2>&1 || { cat log; return 1; }
    "$SEDIMENT_BIN/sediment" verify --store disk/store >log 2>&1 || { cat log; return 1; }
    [ "$(results)" = 4 ] || return 1
  done
}
check "a disk too full for the runner's own files is a clear error, and the next run goes on" full_for_the_runner

too_large() {
  rm -rf disk/store out
  sediment run pipeline.yaml --set thin.padding_mb=9 >log 2>&1 || return 1
  rm -rf disk/store/objects/* disk/store/receipts/*
  dd if=/dev/zero of=disk/filler bs=1M count=12 status=none
  refuses "a run is refused before it begins if the last results would not fit" 1 "this run needs about 9.0 MB on the disk" \
    sediment run pipeline.yaml --set thin.padding_mb=9
  refuses "unless it is said to begin all the same" 1 "thin: FAILED" \
    sediment run pipeline.yaml --set thin.padding_mb=9 --no-space-check
  rm disk/filler
}
too_large

rm -rf disk/store out
sediment run pipeline.yaml >/dev/null 2>&1
mount -o remount,ro disk
kept() { sediment run pipeline.yaml >log 2>&1 && grep -q "4 kept" log; }
check "everything is kept on a read-only store" kept
check "plan, why and status look at a read-only store" eval 'for c in plan why status; do sediment $c pipeline.yaml || exit 1; done'
refuses "a stage that has to run on a read-only store says so" 1 "Read-only file system" \
  sediment run pipeline.yaml --set thin.neighbors=20
mount -o remount,rw disk
finish
