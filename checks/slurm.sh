#!/usr/bin/env bash
# A Slurm cluster whose one node is this machine, for checks: checks/slurm.sh start, then sbatch, squeue or Snakemake;
# checks/slurm.sh stop. Needs root, slurmctld, slurmd and munged; installs them if CHECKS_INSTALL is set.
# The only file outside of target/ is /etc/slurm/slurm.conf: Snakemake's jobs look for it there. One of another cluster
# is left alone. Exit code 5: it cannot be started here, with the reason.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p "${CARGO_TARGET_DIR:-target}/slurm"
folder=$(cd "${CARGO_TARGET_DIR:-target}/slurm" && pwd)
conf=/etc/slurm/slurm.conf
ours="# by checks/slurm.sh in $folder"

is_ours() { [ "$(head -n 1 $conf 2>/dev/null)" = "$ours" ]; }

start() {
  [ "$(id -u)" = 0 ] || { echo "a Slurm cluster is started by root only" >&2; exit 5; }
  [ -z "${CHECKS_INSTALL:-}" ] || bash checks/install.sh slurm
  for program in slurmctld slurmd munged sbatch squeue; do
    command -v $program >/dev/null || { echo "$program is missing (Debian: apt-get install slurm-wlm munge)" >&2; exit 5; }
  done
  [ ! -e $conf ] || is_ours || { echo "$conf belongs to another cluster" >&2; exit 5; }
  stop
  mkdir -p /etc/slurm "$folder/state" "$folder/spool"
  chmod 700 "$folder"
  local host memory
  host=$(hostname -s)
  memory=$(awk '/^MemTotal:/ { printf "%d", $2 / 1024 * 0.8 }' /proc/meminfo)
  [ -s "$folder/munge.key" ] || (umask 077 && head -c 1024 /dev/urandom >"$folder/munge.key")
  cat >$conf <<CONF
$ours
ClusterName=check
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
SlurmUser=root
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$memory State=UNKNOWN
PartitionName=main Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
  munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
    --log-file="$folder/munged.log" --seed-file="$folder/munge.seed" 2>"$folder/munged.err"
  # -c: no jobs of a cluster that was here before
  slurmctld -c
  slurmd
  for _ in $(seq 100); do
    [ "$(sinfo --noheader --format %t 2>/dev/null || true)" != idle ] || return 0
    sleep 0.2
  done
  echo "no idle node after 20 s; see $folder/slurmctld.log and slurmd.log" >&2
  stop
  exit 1
}

stop() {
  ! is_ours || scancel --user=root 2>/dev/null || true
  local name pid
  for name in slurmd slurmctld munged; do
    pid=$(cat "$folder/$name.pid" 2>/dev/null || true)
    # a number that another program has by now is not ours
    if [ -n "$pid" ] && [ "$(cat "/proc/$pid/comm" 2>/dev/null || true)" = $name ]; then
      kill "$pid"
      for _ in $(seq 50); do [ -d "/proc/$pid" ] || break; sleep 0.1; done
    fi
    rm -f "$folder/$name.pid"
  done
  ! is_ours || rm -f $conf
}

case ${1:-} in
  start) start ;;
  stop) stop ;;
  *) echo "usage: $0 start|stop" >&2; exit 2 ;;
esac
