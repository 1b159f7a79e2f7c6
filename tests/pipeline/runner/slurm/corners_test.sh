#!/usr/bin/env bash
# What takes long or is hard to bring about on a real Slurm, with stand-ins for its commands: large arrays, lost jobs, a
# silent controller, retries with more memory, packing, sweeps that overlap, configurations that change underway.
# shellcheck source=tests/support/script_test.sh
source "$(dirname "$0")/../../../support/script_test.sh"
# shellcheck source=tests/pipeline/runner/slurm/fake_slurm.sh
source "$(dirname "$0")/fake_slurm.sh"
cd "$tmp" || exit 1

mkdir stages
for stage in scan smooth thin chart; do ln -s "$SEDIMENT_BIN/fake_stage" stages/$stage; done
for number in $(seq -w 1 6); do
  mkdir "s$number"
  printf 'root: .\nname: %s\n' "$number" >"s$number/sequence.yaml"
done
cat >pipeline.yaml <<'YAML'
sources: {sequence: {kind: sequence, path: "${SEQUENCE}"}}
stages:
  scan:   {reads: {sequence: sequence}, resources: {gpus: 1, time: 10m}}
  smooth: {reads: {cloud: scan.cloud}, resources: {cpus: 2, memory: 20 MiB, time: 90s}, retries: 1}
  thin:   {reads: {cloud: smooth.cloud}, resources: {time: 1h}}
  chart:  {reads: {cloud: thin.cloud, second: smooth.cloud}, resources: {licences: 3, time: 1h}}
YAML
printf 'pipeline: pipeline.yaml\nover:\n  - sequence: [s1, s2, s3, s4, s5, s6]\n' >sequences.yaml
cp sequences.yaml grid.yaml
echo '  - thin.factor: [0.25, 0.5]' >>grid.yaml

sweep() { "$SEDIMENT_BIN/sediment" sweep "$1.yaml" --stages stages --store store --backend slurm "${@:2}"; }
status() { "$SEDIMENT_BIN/sediment" status "$1.yaml" --stages stages --store store "${@:2}"; }
anew() { forget_all_jobs; rm -rf store out; }
submitted() { run sweep "$@"; same "$code" 0; }
# in_script WORDS: a batch script says them.
in_script() { grep -qF -- "$1" <<<"$(scripts)"; }
# has_states SWEEP WORDS: the last line of the status.
has_states() { run status "$1"; same "$(tail -n 1 <<<"$output")" "$2" || { echo "$output"; return 1; }; }

check "a sweep is submitted" submitted sequences
check "as one array job with a task per sequence" same "$(count_jobs) $(count_tasks)" "1 6"
check "that asks for the most of what its stages declare" in_script "#SBATCH --cpus-per-task=2"
check "of memory" in_script "#SBATCH --mem=20M"
check "of gpus" in_script "#SBATCH --gres=gpu:1"
check "of licences" in_script "#SBATCH --licenses=licences:3"
check "and for the sum of their times" in_script "#SBATCH --time=132"
check "everything is pending" has_states sequences "24 pending"
check "submitting it again submits nothing" submitted sequences
check "and says so" says "nothing to submit: 24 pending"
work_off
check "everything is done" has_states sequences "24 done"
check "and the results are linked" test -f out/sequences/s3/chart/text.txt
anew

check "stages are packed by stage" submitted sequences --pack stage
check "with a layer of tasks for each" same "$(grep -c '^layer .*6 tasks for 6 stages' <<<"$output")" 4
check "each with what it declares itself" test "$(scripts | grep -c 'gres=gpu:1')" = 1
work_off
check "they do the same" has_states sequences "24 done"
anew
check "short sequences are folded" submitted sequences --pack chunk:3
check "into two tasks" same "$(count_jobs) $(count_tasks)" "1 2"
anew
check "a sweep with shared stages is submitted" submitted grid
check "those first, in a layer of their own" says "layer 1: 6 tasks for 12 stages (scan, smooth) in array jobs 1"
check "the others behind, each waiting for its own" says "layer 2: 12 tasks for 24 stages (thin, chart) in array jobs 2 3 4 5 6 7"
check "by afterok of a task" in_script "#SBATCH --dependency=afterok:1_4"
check "and gone if that fails" in_script "#SBATCH --kill-on-invalid-dep=yes"
work_off
check "it gets done" has_states grid "36 done"
anew

export FAKE_MAX_ARRAY=4
check "a larger array than Slurm takes is split" submitted sequences --in-flight 3
check "into pieces" same "$(count_jobs) $(count_tasks)" "2 6"
check "that keep to the limit together" in_script "#SBATCH --array=0-3%1"
FAKE_MAX_ARRAY=1001
work_off
check "and nothing is left out" has_states sequences "24 done"
anew

# Lost: Slurm forgot the job, and there is no receipt.
check "a sweep is submitted that will be lost" submitted sequences
run_task 1_0
run_task 1_1
rm -r "$FAKE_SLURM"/jobs/*
check "what was done stays, what Slurm forgot is lost" has_states sequences "8 done, 16 lost"
check "lost works are submitted again" submitted sequences
check "and no others" same "$(count_tasks)" 4
work_off
check "until all are done" has_states sequences "24 done"
anew

check "a submitter dies before it notes the job" submitted sequences
rm store/slurm/*/jobs
check "the job is known by its name" submitted sequences
check "so nothing is submitted twice" same "$(count_tasks)" 6
touch "$FAKE_SLURM/down"
refuses "nothing is submitted while nobody knows what is in flight" 1 "nobody knows what is in flight" sweep sequences
check "status then says what it knows" has_states sequences "squeue does not answer: $FAKE_SLURM/bin/squeue failed: Unable to contact slurm controller (connect failure)"
rm "$FAKE_SLURM/down"
work_off
touch "$FAKE_SLURM/down"
check "what is complete needs no Slurm" submitted sequences
rm "$FAKE_SLURM/down"
anew

# A failure, and a retry by submitting again: with twice the memory.
flaky=(--set smooth.fault=twice --set "smooth.diary=$tmp/starts")
check "a stage is about to fail twice" submitted sequences "${flaky[@]}"
work_off
run status sequences "${flaky[@]}"
check "the failed ones are named" grep -qE '^s1/smooth +failed .*exited with 1; job 1_0; .*/store/runs/.*log' <<<"$output"
check "those behind them are blocked, all others done" same "$(tail -n 1 <<<"$output")" "18 done, 2 failed, 4 blocked"
check "they are submitted again" submitted sequences "${flaky[@]}"
check "with twice the memory" in_script "#SBATCH --mem=40M"
work_off
run status sequences "${flaky[@]}"
check "and get done" same "$(tail -n 1 <<<"$output")" "24 done"
anew

# Two calls that overlap: what is in flight is waited for and not submitted again.
check "one sweep is in flight" submitted sequences
check "another wants some of its works" submitted grid
check "and submits only the others" says "submitted 12 stages in 6 tasks of 6 array jobs; 0 are there, 24 were in flight"
check "behind those in flight" in_script "#SBATCH --dependency=afterok:1_5"
work_off
check "so both get done" has_states grid "36 done"
anew

# What was submitted is what was said then.
check "a sweep is submitted that somebody edits" submitted sequences
cp pipeline.yaml before.yaml
sed -i 's/time: 1h}}/time: 1h}, params: {neighbors: 7}}/' pipeline.yaml
echo "changed: true" >>s5/sequence.yaml
work_off
mv before.yaml pipeline.yaml
sed -i '/changed/d' s5/sequence.yaml
check "what it reads must still be the same; the rest is done as it was submitted" has_states sequences "20 done, 4 failed"
run status sequences
check "and it says so" says "the source $tmp/s5/sequence.yaml has changed since it was submitted"
anew

check "a sweep is submitted that is cancelled" submitted sequences
run_task 1_0
run "$SEDIMENT_BIN/sediment" cancel sequences.yaml --store store
check "all that is not over is cancelled" same "$output" "5 tasks of 1 array jobs cancelled"
check "status tells" has_states sequences "4 done, 20 cancelled"
check "it may be submitted again" submitted sequences
check "as far as it is missing" same "$(count_tasks)" 11
work_off
check "and gets done" has_states sequences "24 done"
anew

# More than 64 different things to wait for: index by index, so that the calls stay few.
for number in $(seq 70); do
  mkdir -p "many/$number"
  printf 'root: .\nname: many %s\n' "$number" >"many/$number/sequence.yaml"
done
printf 'pipeline: pipeline.yaml\nover: [{sequence: "many/*"}]\n' >many.yaml
check "many sequences are packed by stage" submitted many --pack stage
check "into one array job per stage" same "$(count_jobs) $(count_tasks)" "4 280"
check "each task behind the one of the same index" in_script "#SBATCH --dependency=aftercorr:3"
anew

# Profiles.
printf 'partition: cpu\nstages: {scan: {partition: gpu, options: [--exclude=node 7]}}\ndefaults: {time: 5m}\n' >profile.yaml
refuses "stages with options of their own need tasks of their own" 2 "stage smooth has other options in the profile" \
  sweep sequences --profile profile.yaml
check "which --pack stage gives them" submitted sequences --profile profile.yaml --pack stage
check "the profile's options reach sbatch" in_script "#SBATCH --partition=cpu"
check "those of a stage too" in_script '#SBATCH "--exclude=node 7"'
anew
printf 'partiton: cpu\nin_flight: none\ndefaults: {memory: 4 QB}\nstages: {scan: {options: [exclude]}}\n' >wrong.yaml
refuses "a mistyped profile is refused" 2 'wrong.yaml:1: profile: unknown key "partiton" (did you mean "partition"?)' \
  sweep sequences --profile wrong.yaml
check "with all that is wrong" eval 'says "wrong.yaml:2: in_flight" && says "wrong.yaml:3: defaults: memory" && says "wrong.yaml:4: options"'
refuses "an unknown packing is refused" 2 "expected sequence, stage or chunk:N" sweep sequences --pack chunk:0
refuses "flags of Slurm need Slurm" 2 "--pack requires --backend" \
  "$SEDIMENT_BIN/sediment" sweep sequences.yaml --stages stages --store store --pack stage
without_commands() { PATH=/nowhere sweep "$@"; }
refuses "without Slurm's commands it says so" 2 'there is no "sbatch" in PATH' without_commands sequences
finish
