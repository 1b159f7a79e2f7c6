#!/usr/bin/env bash
# Sweeps over a real Slurm: the bytes of a local sweep, failures that hold up only what stands behind them, nothing done
# twice, and a controller that dies.
# shellcheck source=tests/support/script_test.sh
source "$(dirname "$0")/../../../support/script_test.sh"
# shellcheck source=tests/pipeline/runner/slurm/one_machine_slurm.sh
source "$(dirname "$0")/one_machine_slurm.sh"
missing=$(slurm_is_missing)
[ -z "$missing" ] || { echo "$missing"; exit 0; }
trap 'scancel --user=root 2>/dev/null; stop_slurm; rm -rf "$tmp"' EXIT
start_slurm "$tmp/slurm" || { echo "skipped: needs a Slurm that starts; its log:"; tail -n 5 "$tmp"/slurm/*.log; exit 0; }
cd "$tmp" || exit 1

# Four sequences x three values of smooth x two of thin: 4 + 12 + 24 + 24 distinct results in three layers.
mkdir -p stages "a b"
for stage in scan smooth thin chart; do ln -s "$SEDIMENT_BIN/fake_stage" stages/$stage; done
for sequence in one two three four; do
  mkdir $sequence
  echo "root: ." >$sequence/sequence.yaml
  echo "name: $sequence" >>$sequence/sequence.yaml
done
cat >pipeline.yaml <<'YAML'
sources: {sequence: {kind: sequence, path: "${SEQUENCE}"}}
stages:
  scan:   {reads: {sequence: sequence}, params: {diary: "${DIARY}"}}
  smooth: {reads: {cloud: scan.cloud}, params: {diary: "${DIARY}"}, resources: {cpus: 2, memory: 20 MB}}
  thin:   {reads: {cloud: smooth.cloud}, params: {diary: "${DIARY}"}}
  chart:  {reads: {cloud: thin.cloud, second: smooth.cloud}, params: {diary: "${DIARY}"}}
YAML
cat >all.yaml <<'YAML'
pipeline: pipeline.yaml
over:
  - sequence: [one, two, three, four]
  - smooth.neighbors: [10, 20, 30]
  - thin.factor: [0.25, 0.5]
YAML
cat >profile.yaml <<'YAML'
partition: main
in_flight: 32
defaults: {memory: 10 MB, time: 10m}
YAML
export DIARY=$tmp/diary

# sweep OUT FLAG...: on this machine, and the same over Slurm.
sweep() { "$SEDIMENT_BIN/sediment" sweep all.yaml --stages stages --out "$1" "${@:2}"; }
on_slurm() { sweep "$1" --backend slurm --profile profile.yaml "${@:2}"; }
status() { "$SEDIMENT_BIN/sediment" status all.yaml --stages stages --out "$1" "${@:2}"; }
bytes_of() { (cd "$1" && find .sediment/objects -type f -print0 | sort -z | xargs -0 sha256sum); }
jobs_in_all() { squeue --noheader --array --states=all | wc -l; }
# within SECONDS COMMAND...: until the command succeeds.
within() {
  local tries
  for tries in $(seq $(($1 * 10))); do
    if "${@:2}"; then return 0; fi
    sleep 0.1
  done
  echo "not within $1 s: ${*:2}"
  return 1
}

sweep local >local.log 2>&1
check "the local sweep ends well" grep -q '64 ran\|40 kept' local.log
: >diary
check "a sweep over Slurm ends well" on_slurm "a b/out" --wait
cp .check first.log
check "it had three layers: what instances share runs first" same \
  "$(grep '^layer' first.log | cut -d' ' -f-4 | tr '\n' ' ')" "layer 1: 4 tasks layer 2: 12 tasks layer 3: 24 tasks "
check "it leaves the same bytes as the local sweep" diff <(bytes_of local) <(bytes_of "a b/out")
check "every distinct stage ran once" same "$(sort diary | uniq -c | tr -s ' ' | tr '\n' ';')" " 24 chart; 4 scan; 12 smooth; 24 thin;"
check "its table is that of the local sweep" diff <("$SEDIMENT_BIN/sediment" table local) <("$SEDIMENT_BIN/sediment" table "a b/out")
before=$(jobs_in_all)
run on_slurm "a b/out"
check "running again submits nothing" same "$code" 0
check "and shows the table of results" says 'bytes of every result'
check "and no job came" same "$(jobs_in_all)" "$before"

# One sequence fails: nothing but what stands behind it is cancelled.
sed 's/sequence: \[one, two, three, four\]/{sequence: [one, two, three, four], scan.fault: ["", fail, "", ""]}/' all.yaml >failing.yaml
failing() { "$SEDIMENT_BIN/sediment" "$1" failing.yaml --stages stages --out failing "${@:2}"; }
refuses "a sweep with a stage that fails fails" 1 "two/scan.fault=fail,smooth.neighbors=10,thin.factor=0.25/scan  failed" \
  failing sweep --backend slurm --profile profile.yaml --wait
failing status >status.log
check "one fails, what is behind it is blocked, all else is done" same "$(tail -n 1 status.log)" "48 done, 1 failed, 15 blocked"
check "Slurm cancelled no others" same \
  "$(squeue --noheader --array --states=CANCELLED --format=%r | sort | uniq -c | tr -s ' ')" " 9 DependencyNeverSatisfied"
sed -i 's/fail, /"", /' failing.yaml

# A stage that fails until its third start: submitted again by --wait, as often as its retries say.
sed 's/  thin: *{/&retries: 2, /' pipeline.yaml >flaky.yaml
check "--wait submits again what failed and has retries left" env SEQUENCE=one "$SEDIMENT_BIN/sediment" run flaky.yaml \
  --stages stages --out flaky --backend slurm --profile profile.yaml --wait --set thin.fault=twice --set "thin.diary=$tmp/starts"
check "which took three starts" same "$(cat starts)" "thin
thin
thin"

# A controller that is killed in the middle of a sweep and started again. What it has not saved it forgets, and would give
# the numbers of running jobs to others: so nothing starts any more once it has saved them.
slow=(--set scan.sleep_s=4)
: >diary
check "a sweep is submitted and left alone" on_slurm slow "${slow[@]}"
shows() { status slow "${slow[@]}" >status.log; grep -qx "$1" status.log; }
check "status shows what runs" within 20 shows '4 running, 60 pending'
check "and what waits, and why" grep -q '/smooth *pending (Dependency)' status.log
scontrol update partitionname=main state=down
touch saved
sbatch --hold --output=/dev/null --wrap true >held.log
check "the controller saves its state" within 30 test slurm/state/job_state -nt saved
kill_controller
check "status does without a controller" grep -q 'squeue does not answer' <<<"$(status slow "${slow[@]}")"
start_controller
check "the controller comes back" slurm_is_up
scontrol update partitionname=main state=up
check "the sweep is brought to its end" on_slurm slow "${slow[@]}" --wait
check "nothing was lost: each distinct stage ran once" same "$(sort diary | uniq -c | tr -s ' ' | tr '\n' ';')" " 24 chart; 4 scan; 12 smooth; 24 thin;"
check "and the bytes are the same" diff <(bytes_of local) <(bytes_of slow)

# One that is killed right after a submission, before it has saved the jobs.
scontrol update partitionname=main state=down
on_slurm lost >lost.log 2>&1
kill_controller
start_controller
check "the controller comes back again" slurm_is_up
scontrol update partitionname=main state=up
check "what it may have lost is found, and submitted again" on_slurm lost --wait
check "with the same bytes" diff <(bytes_of local) <(bytes_of lost)

# Signals reach the runner: what is cancelled ends at once and leaves nothing that writes.
long=(--set scan.sleep_s=600)
check "a long sweep is submitted" on_slurm long "${long[@]}"
check "it runs" within 20 eval 'status long "${long[@]}" >status.log; [ "$(grep -c "/scan *running" status.log)" = 24 ]'
check "it is cancelled" "$SEDIMENT_BIN/sediment" cancel all.yaml --out long
check "its stages end" within 20 eval '! pgrep -f "$tmp/long/[.]sediment" >/dev/null'
check "and status tells" within 20 eval 'status long "${long[@]}" >status.log; grep -qx "64 cancelled" status.log'
finish
