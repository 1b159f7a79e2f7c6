# shellcheck shell=bash
# Sourced by tests: a real Slurm of one machine, started as root on 127.0.0.1 without systemd, with ports, key and state
# of its own, so that it meets no other Slurm or munge of the machine. Its processes are children of the test and are
# stopped by pid. Packages slurm-wlm and munge.

PATH=$PATH:/usr/sbin
declare -A slurm_pid=()

# A port that nobody listens on.
free_port() {
  local port
  while port=$((20000 + (RANDOM << 1 ^ $$) % 30000)); (: </dev/tcp/127.0.0.1/$port) 2>/dev/null; do :; done
  echo $port
}

# Why there can be no Slurm here; nothing if there can.
slurm_is_missing() {
  local command
  for command in slurmctld slurmd munged sbatch squeue scancel scontrol sinfo; do
    command -v $command >/dev/null || { echo "skipped: needs $command (packages slurm-wlm and munge)"; return; }
  done
  [ "$(id -u)" = 0 ] || echo "skipped: needs root to start a Slurm"
}

# slurm_configuration FOLDER: as small as it gets. More cpus than there are, since Slurm starts at most "cpus" jobs a second.
slurm_configuration() {
  local name
  name=$(hostname -s)
  cat <<CONF
ClusterName=sediment-test
SlurmctldHost=$name(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$1/munge/socket
CredType=cred/munge
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmctldPidFile=$1/slurmctld.pid
SlurmdPidFile=$1/slurmd.pid
StateSaveLocation=$1/state
SlurmdSpoolDir=$1/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SchedulerType=sched/builtin
SchedulerParameters=sched_min_interval=0,batch_sched_delay=0,bf_interval=1,default_queue_depth=10000,partition_job_depth=10000
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
MaxArraySize=1001
MinJobAge=300
KillWait=5
SlurmdParameters=config_overrides
NodeName=$name NodeAddr=127.0.0.1 CPUs=32 RealMemory=$(($(awk '/MemTotal/ { print $2 }' /proc/meminfo) / 1024)) State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP DefMemPerCPU=10
CONF
}

start_controller() {
  slurmctld -D -f "$SLURM_CONF" "$@" >"$slurm_folder/slurmctld.log" 2>&1 &
  slurm_pid[slurmctld]=$!
}
kill_controller() {
  kill -9 "${slurm_pid[slurmctld]}"
  wait "${slurm_pid[slurmctld]}" 2>/dev/null
}

# Waits until the node takes jobs, twenty seconds at most.
slurm_is_up() {
  local tries
  for tries in $(seq 200); do
    if sinfo -h -o %T 2>/dev/null | grep -qE 'idle|mixed|allocated'; then return 0; fi
    sleep 0.1
  done
  return 1
}

# start_slurm FOLDER: exports SLURM_CONF. Fails if it does not start.
start_slurm() {
  slurm_folder=$1
  mkdir -p "$1"/{state,spool,munge}
  chmod 700 "$1/munge"
  (umask 077 && head -c 128 /dev/urandom >"$1/munge/key")
  munged --foreground --force --key-file="$1/munge/key" --socket="$1/munge/socket" --pid-file="$1/munge/pid" \
    --log-file="$1/munge/log" --seed-file="$1/munge/seed" >"$1/munge/out" 2>&1 &
  slurm_pid[munged]=$!
  export SLURM_CONF=$1/slurm.conf
  slurm_configuration "$1" >"$SLURM_CONF"
  local tries
  for tries in $(seq 100); do [ ! -S "$1/munge/socket" ] || break; sleep 0.05; done
  start_controller -c
  slurmd -D -f "$SLURM_CONF" >"$1/slurmd.log" 2>&1 &
  slurm_pid[slurmd]=$!
  slurm_is_up
}

stop_slurm() {
  local name
  for name in slurmd slurmctld munged; do
    [ -n "${slurm_pid[$name]-}" ] || continue
    kill "${slurm_pid[$name]}" 2>/dev/null
    wait "${slurm_pid[$name]}" 2>/dev/null
  done
}
