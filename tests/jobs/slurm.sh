#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A real Slurm on this machine runs an array of 20 shares: one job of the list fails, one share is killed in the middle and
# requeued, and everything is there at the end.
#   bash tests/jobs/slurm.sh WEFT [--install]      as root; --install fetches Debian's slurm-wlm and munge when they are missing
# Status 77: skipped. Configuration, state and sockets lie in a folder of their own; a Slurm that runs here is left alone.
set -euo pipefail
weft=$(realpath "$1")
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
if [ "${2:-}" = --install ] && ! command -v slurmctld > /dev/null; then
  apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends slurm-wlm munge > /dev/null
fi
for needed in slurmctld slurmd munged sbatch; do
  command -v "$needed" > /dev/null || { echo "SKIPPED: no $needed; apt-get install slurm-wlm munge, or give --install" >&2; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "SKIPPED: starting slurmd takes root" >&2; exit 77; }

scratch=$(mktemp -d)
chmod 755 "$scratch"
cleanup() {
  for name in slurmd slurmctld munged; do [ ! -f "$scratch/$name.pid" ] || kill "$(cat "$scratch/$name.pid")" 2> /dev/null || true; done
  sleep 1
  rm -rf "$scratch"
}
trap cleanup EXIT

# The first port from $1 on that nobody listens at: another run of this may be on, or have been cut short.
free_port() {
  local port
  for port in $(seq "$1" $(($1 + 500))); do
    (: < "/dev/tcp/127.0.0.1/$port") 2> /dev/null || { echo "$port"; return; }
  done
}

host=$(hostname -s)
mkdir -p "$scratch"/{munge,ctld,slurmd}
dd if=/dev/urandom of="$scratch/munge/key" bs=128 count=1 status=none
chown -R munge: "$scratch/munge"
chmod 700 "$scratch/munge"; chmod 400 "$scratch/munge/key"
chmod 711 "$scratch/munge"
run_munged="munged --force --socket=$scratch/munge/socket --key-file=$scratch/munge/key --log-file=$scratch/munge/log --pid-file=$scratch/munge/pid --seed-file=$scratch/munge/seed --num-threads=2"
su munge -s /bin/sh -c "/usr/sbin/$run_munged"
ln -s "$scratch/munge/pid" "$scratch/munged.pid"
for _ in $(seq 40); do [ -S "$scratch/munge/socket" ] && break; sleep 0.25; done

export SLURM_CONF=$scratch/slurm.conf
cat > "$SLURM_CONF" << CONF
ClusterName=weft
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port 16817)
SlurmdPort=$(free_port 17817)
AuthType=auth/munge
AuthInfo=socket=$scratch/munge/socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SlurmUser=root
StateSaveLocation=$scratch/ctld
SlurmdSpoolDir=$scratch/slurmd
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
SlurmctldLogFile=$scratch/slurmctld.log
SlurmdLogFile=$scratch/slurmd.log
ReturnToService=2
JobRequeue=1
SchedulerParameters=sched_interval=2,batch_sched_delay=0
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld
slurmd
for _ in $(seq 60); do sinfo -h -o %T 2> /dev/null | grep -q idle && break; sleep 0.5; done
sinfo -h -o %T | grep -q idle || { echo "Slurm did not come up:" >&2; tail -n 5 "$scratch"/*.log >&2; exit 1; }

# 60 jobs, of which one is off the bed; one takes long: the share that holds it is killed.
jobs=$scratch/jobs.jsonl
for i in $(seq 60); do
  echo "{\"id\": \"job-$i\", \"models\": [\"$root/examples/box.stl\"], \"set\": {\"layer_height\": 0.3, \"infill_sparse_density\": $((10 + i % 40))}}"
done > "$jobs"
echo "{\"id\": \"off-the-bed\", \"models\": [\"$root/examples/box.stl\"], \"center\": [900, 900]}" >> "$jobs"
echo "{\"id\": \"long\", \"models\": [\"$root/examples/bracket.stl\"], \"scale\": 2.5, \"set\": {\"layer_height\": 0.04}}" >> "$jobs"
# The share of a job: the first 64 bits of its id's hash, modulo 20; in two parts, because the shell's numbers are signed.
hash=$(printf %s long | sha256sum)
victim=$((((16#${hash:0:15} % 20) * 16 + 16#${hash:15:1}) % 20 + 1))

cd "$scratch"
export WEFT=$weft
array=$(sbatch --parsable --array=1-20 --cpus-per-task=1 --mem=0 "$root/examples/batch/slurm.sbatch" "$jobs" "$scratch/out")
echo "array $array, share $victim of 20 will be killed"
for _ in $(seq 600); do # until the victim works at the long job
  pid=$(pgrep -f "$weft batch $jobs" | while read -r p; do { tr '\0' '\n' < "/proc/$p/environ"; } 2> /dev/null | grep -qx "SLURM_ARRAY_TASK_ID=$victim" && echo "$p"; done | head -1 || true)
  [ -n "$pid" ] && break
  sleep 0.1
done
[ -n "$pid" ] || { echo "FAILED: share $victim was never seen running" >&2; exit 1; }
sleep 0.7
kill -9 "$pid"
echo "killed process $pid"
for _ in $(seq 50); do scontrol requeue "${array}_$victim" 2> /dev/null && break; sleep 0.2; done
for _ in $(seq 900); do [ -z "$(squeue -h)" ] && break; sleep 0.5; done
[ -z "$(squeue -h)" ] || { echo "FAILED: the array did not end" >&2; squeue >&2; exit 1; }
restarts=$(scontrol show job "${array}_$victim" | grep -o 'Restarts=[0-9]*')
echo "share $victim: $restarts"

failed=0
expect() { if [ "$2" = "$3" ]; then echo "ok: $1"; else echo "FAILED: $1: $2, wanted $3" >&2; failed=1; fi; }
status=0
"$weft" batch "$jobs" -o "$scratch/out" --collect 2> "$scratch/collect.log" || status=$?
tail -n 1 "$scratch/collect.log"
expect "the killed share was requeued" "$restarts" "Restarts=1"
expect "collecting says that a job failed" "$status" 7
expect "every other job is there" "$(find "$scratch/out" -name '*.gcode' | wc -l)" 61
expect "nothing half written is left" "$(find "$scratch/out" -name '*.weft-??????' | wc -l)" 0
expect "the report has every job" "$(wc -l < "$scratch/out/report.jsonl")" 62
expect "one failed" "$(grep -c '"exit_status":5' "$scratch/out/report.jsonl")" 1
"$weft" batch "$jobs" -o "$scratch/alone" --shard 1/1 -q || true
different=0
for file in "$scratch"/alone/*.gcode; do cmp -s "$file" "$scratch/out/$(basename "$file")" || different=$((different + 1)); done
expect "every file is that of one machine alone" "$different" 0
exit $failed
