#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# slurm_test.sh PROGRAMS SOURCE: a Slurm of one node on this machine, started and stopped here; jobs that are
# preempted, requeued, killed and go on, and an array of frames. Status 77 without VITRAIL_LONG_TESTS, and where
# there is no Slurm to try it with.
set -u
programs=$(realpath "$1") source=$(realpath "$2")
[ -n "${VITRAIL_LONG_TESTS:-}" ] || { echo "skipped: takes minutes, with VITRAIL_LONG_TESTS=1"; exit 77; }
for tool in slurmctld slurmd munged srun sbatch; do
  command -v $tool > /dev/null || { echo "skipped: no $tool here (Debian's slurmctld, slurmd, munge)"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: daemons are started as root here"; exit 77; }
PATH=$programs:$PATH
. "$source/scripts/mpi-environment"
folder=$(mktemp -d /tmp/vitrail-slurm-XXXXXX)
export SLURM_CONF=$folder/slurm.conf
stop() {
  scancel --user=root 2> /dev/null
  for pid in "$folder"/*.pid; do kill "$(cat "$pid")" 2> /dev/null; done
  sleep 1
  rm -rf "$folder"
}
trap stop EXIT
fail() { echo "failed: $*"; tail -n 20 "$folder"/log "$folder"/ctld.log 2> /dev/null; exit 1; }

mkdir -m 711 "$folder/munge" "$folder/state" "$folder/spool"
chmod 755 "$folder"
head -c 128 /dev/urandom > "$folder/munge.key"
chmod 600 "$folder/munge.key"
munged --force --key-file="$folder/munge.key" --socket="$folder/munge/socket" --pid-file="$folder/munge.pid" \
  --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" || fail munged
cat > "$SLURM_CONF" << END
ClusterName=test
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort=$((20000 + $$ % 5000))
SlurmdPort=$((25000 + $$ % 5000))
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/ctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/ctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
JobAcctGatherType=jobacct_gather/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
NodeName=$(hostname) NodeAddr=127.0.0.1 CPUs=2 RealMemory=2000 State=UNKNOWN
PartitionName=low Nodes=ALL Default=YES PriorityTier=1 GraceTime=30 State=UP
PartitionName=high Nodes=ALL PriorityTier=10 PreemptMode=OFF State=UP
END
slurmctld || fail slurmctld
slurmd -N "$(hostname)" || fail slurmd
for _ in $(seq 30); do sinfo -h -o %T | grep -q idle && break; sleep 1; done

cd "$folder" || exit 1
vitrail partition "$source/examples/cornell-box/cornell-box.pbrt" -o box.vit --domains 4 --quiet || fail partition
options="--crop 0,64,0,64 --spp ${VITRAIL_SLURM_SPP:-1024} --threads 1"
hash_of() { vitrail inspect "$1" --json | sed -n 's/.*"film_hash": *"\(.*\)".*/\1/p'; }

echo "== tasks that do not know of each other"
timeout 60 srun -n 2 --mem=100 vitrail render box.vit -o none.film $options > none.log 2>&1
[ $? = 2 ] || fail "srun without PMI: $(cat none.log)"
[ -e none.film ] && fail "it rendered all the same"

echo "== preempted, requeued, gone on with"
job=$(sbatch --parsable -n 2 --ntasks-per-node=2 --mem=1000 --time=20 -o log \
  "$source/examples/cluster/render.sbatch" box.vit -o a.film $options --checkpoint-every 1 --stats a.json) || fail sbatch
for _ in $(seq 600); do [ -e a.film.partial ] && break; sleep .1; done
[ -e a.film.partial ] || fail "no checkpoint: $(cat log)"
timeout 60 srun -p high -n 2 --mem=1500 sleep 1 || fail "nothing was preempted"
grep -q "stopped; a.film.partial holds the samples so far" log || fail "TERM did not stop it: $(cat log)"
[ -e a.film ] && fail "it was finished before it was preempted"
for _ in $(seq 240); do
  [ -e a.film ] && [ -z "$(squeue -h -j "$job" -t R,CG -o %T 2> /dev/null)" ] && break
  squeue -h -j "$job" -t PD -o %T | grep -q . && scontrol update jobid="$job" StartTime=now  # else in two minutes
  scontrol show job "$job" | grep -q JobState=FAILED && fail "it was not requeued: $(cat log)"
  sleep .5
done
[ -e a.film ] || fail "it was not gone on with: $(cat log; scontrol show job "$job")"
grep -q "going on from a.film.partial" log || fail "it began anew"
grep -q "450 MiB a rank, as Slurm gives this job" log || fail "memory: $(cat log)"
grep -Eq "stops with a checkpoint after 11[0-9]{2} s" log || fail "time: $(cat log)"
vitrail render box.vit -o whole.film $options --quiet --stats whole.json
[ "$(grep film_hash a.json)" = "$(grep film_hash whole.json)" ] || fail "another film"

echo "== a rank is killed, the job goes on"
killed=$(sbatch --parsable -n 2 --ntasks-per-node=2 --mem=1000 --time=20 -o killed.log \
  "$source/examples/cluster/render.sbatch" box.vit -o k.film $options --checkpoint-every 1 --stats k.json) || fail sbatch
for _ in $(seq 600); do [ -e k.film.partial ] && break; sleep .1; done
rank=$(pgrep -f "vitrail-render.* k.film" | while read -r p; do tr '\0' '\n' < /proc/$p/environ 2> /dev/null | grep -q '^SLURM_PROCID=1$' && echo "$p"; done | tail -n 1)
[ -n "$rank" ] || fail "no rank 1: $(cat killed.log)"
kill -KILL "$rank"
for _ in $(seq 240); do [ -e k.film ] && [ -z "$(squeue -h -j "$killed" -o %T 2> /dev/null)" ] && break; sleep .5; done
[ -e k.film ] || fail "it was not started again: $(cat killed.log; scontrol show job "$killed")"
grep -q "going on from k.film.partial" killed.log || fail "it was not killed, or began anew: $(cat killed.log)"
[ "$(grep film_hash k.json)" = "$(grep film_hash whole.json)" ] || fail "another film after a kill"

echo "== an array renders the frames of a list"
printf -- '--seed %d\n' 1 2 3 4 > list.txt
array=$(sbatch --parsable --array 2-4 --mem=500 --time=20 -o array.log "$source/examples/cluster/frames/frames.sbatch" \
  box.vit --frames list.txt -o frame%d.film --crop 0,64,0,64 --spp 16 --threads 1) || fail sbatch
for _ in $(seq 240); do [ -z "$(squeue -h -j "$array" -o %T 2> /dev/null)" ] && break; sleep .5; done
[ "$(echo frame?.film)" = "frame2.film frame3.film frame4.film" ] || fail "the array: $(ls frame*; cat array.log)"

echo "== requeued when it is finished"
scontrol requeue "$job" && scontrol update jobid="$job" StartTime=now
for _ in $(seq 120); do grep -q "a.film is finished already" log && break; sleep .5; done
grep -q "a.film is finished already" log || fail "requeued: $(cat log)"
echo passed
