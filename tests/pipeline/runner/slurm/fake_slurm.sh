# shellcheck shell=bash
# Sourced by tests: stand-ins for sbatch, squeue, scancel and scontrol that keep their jobs in files, and a cluster that
# works them off when the test says so. FAKE_SLURM/jobs/<job>/: script, name, dependency, and tasks/<index> with
# "STATE|reason". FAKE_SLURM/down: the controller does not answer.
# shellcheck disable=SC2154  # tmp comes from tests/support/script_test.sh
export FAKE_SLURM=$tmp/fake_slurm FAKE_MAX_ARRAY=1001
mkdir -p "$FAKE_SLURM/bin" "$FAKE_SLURM/jobs"
export PATH=$FAKE_SLURM/bin:$PATH

stand_in() {
  {
    echo '#!/usr/bin/env bash'
    echo '[ ! -e "$FAKE_SLURM/down" ] || { echo "Unable to contact slurm controller (connect failure)" >&2; exit 1; }'
    cat
  } >"$FAKE_SLURM/bin/$1"
  chmod +x "$FAKE_SLURM/bin/$1"
}

stand_in sbatch <<'SBATCH'
script=${*: -1}
option() { sed -n "s/^#SBATCH \"\?--$1=\([^\"]*\)\"\?$/\1/p" "$script"; }
job=$(($(ls "$FAKE_SLURM/jobs" | sort -n | tail -n 1) + 1))
folder=$FAKE_SLURM/jobs/$job
mkdir -p "$folder/tasks"
cp "$script" "$folder/script"
option job-name >"$folder/name"
option dependency >"$folder/dependency"
for part in $(option array | sed 's/%.*//' | tr ',' ' '); do
  for index in $(seq "${part%-*}" "${part#*-}"); do echo 'PENDING|Priority' >"$folder/tasks/$index"; done
done
echo "$job"
SBATCH

stand_in squeue <<'SQUEUE'
for argument; do case "$argument" in --name=*) names=,${argument#--name=}, ;; esac; done
for folder in "$FAKE_SLURM"/jobs/*; do
  name=$(cat "$folder/name")
  case "$names" in *",$name,"*) ;; *) continue ;; esac
  for task in "$folder"/tasks/*; do
    IFS='|' read -r state reason <"$task"
    echo "${folder##*/}_${task##*/}|$name|$state|$reason"
  done
done
SQUEUE

stand_in scancel <<'SCANCEL'
for job; do
  for task in "$FAKE_SLURM/jobs/$job"/tasks/*; do grep -q '^COMPLETED\|^FAILED' "$task" || echo 'CANCELLED|None' >"$task"; done
done
SCANCEL

stand_in scontrol <<'SCONTROL'
printf 'MaxArraySize            = %s\nSchedulerParameters     = bf_interval=1\n' "$FAKE_MAX_ARRAY"
SCONTROL

state_of() { cut -d'|' -f1 "$FAKE_SLURM/jobs/${1%_*}/tasks/${1#*_}" 2>/dev/null || echo GONE; }

# worst_before TASK: what the tasks that a task waits for have come to: nothing, WAIT, or FAILED.
worst_before() {
  local kind rest one state
  tr ',' '\n' <"$FAKE_SLURM/jobs/${1%_*}/dependency" | while IFS=: read -r kind rest; do
    for one in ${rest//:/ }; do
      [ "$kind" != aftercorr ] || one=${one}_${1#*_}
      state=$(state_of "$one")
      case "$state" in COMPLETED) ;; PENDING | RUNNING) echo WAIT ;; *) echo FAILED ;; esac
    done
  done | sort -u | head -n 1
}

# run_task JOB_INDEX: as slurmd does.
run_task() {
  local file=$FAKE_SLURM/jobs/${1%_*}/tasks/${1#*_}
  echo 'RUNNING|None' >"$file"
  if SLURM_ARRAY_TASK_ID=${1#*_} sh "$FAKE_SLURM/jobs/${1%_*}/script" >>"$FAKE_SLURM/output" 2>&1; then
    echo 'COMPLETED|None' >"$file"
  else
    echo 'FAILED|NonZeroExitCode' >"$file"
  fi
}

# Runs what is pending and may run, until nothing is left; cancels what waits for a failure.
work_off() {
  local again=true task name
  while $again; do
    again=false
    for task in "$FAKE_SLURM"/jobs/*/tasks/*; do
      name=$(basename "$(dirname "$(dirname "$task")")")_$(basename "$task")
      [ "$(state_of "$name")" = PENDING ] || continue
      case "$(worst_before "$name")" in
        FAILED) echo 'CANCELLED|DependencyNeverSatisfied' >"$task" ;;
        WAIT) continue ;;
        *) run_task "$name" ;;
      esac
      again=true
    done
  done
}
forget_all_jobs() { rm -rf "$FAKE_SLURM"/jobs/*; }
scripts() { cat "$FAKE_SLURM"/jobs/*/script; }
count_jobs() { find "$FAKE_SLURM/jobs" -mindepth 1 -maxdepth 1 | wc -l; }
count_tasks() { find "$FAKE_SLURM/jobs" -path '*/tasks/*' | wc -l; }
