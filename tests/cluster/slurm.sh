#!/bin/bash
# A real Slurm on this machine, for as long as this script runs: an array of shards with examples/cluster/study-array.sh, their join, and the same
# bits as in one run. One shard is killed and goes on. Run by hand, as root:
#   apt-get install slurmctld slurmd slurm-client munge
#   tests/cluster/slurm.sh PROGRAM
# It needs no systemd, takes ports 16817 and 16818, and ends the daemons that it has started.
set -eu
program=$(realpath "${1:-build/release/rotordrop}")
source=$(realpath "$(dirname "$0")/../..")
folder=$(mktemp -d /tmp/rotordrop-slurm-XXXXXX)
started_munge=

finish() {
  code=$?
  scontrol shutdown >/dev/null 2>&1 || true
  if [ -n "$started_munge" ] && [ -f /run/munge/munged.pid ]; then kill "$(cat /run/munge/munged.pid)" || true; fi
  if [ $code -eq 0 ]; then rm -rf "$folder"; else echo "failed; logs are in $folder" >&2; fi
}
trap finish EXIT

mkdir -p "$folder"/{spool,state,bin}
chmod 755 "$folder"
ln -s "$program" "$folder/bin/rotordrop"
export PATH="$folder/bin:$PATH"
# The daemon of munge does not run as root.
if ! pgrep -x munged >/dev/null; then
  install -d -o munge -g munge -m 0755 /run/munge
  [ -s /etc/munge/munge.key ] || { mungekey -c && chown munge /etc/munge/munge.key; }
  runuser -u munge -- /usr/sbin/munged
  started_munge=yes
fi
host=$(hostname -s)
cat > "$folder/slurm.conf" <<C
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
SlurmUser=root
SlurmdUser=root
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=60 State=UP
C
export SLURM_CONF="$folder/slurm.conf"
slurmctld -f "$SLURM_CONF"
slurmd -f "$SLURM_CONF"
for _ in $(seq 40); do
  if sinfo -h -o %T 2>/dev/null | grep -q idle; then break; fi
  sleep 0.5
done
sinfo

cd "$folder"
cat > study.toml <<S
case = "neisi2019.toml"
[vary]
contact.friction_coefficient = { range = [0.05, 0.3] }
[design]
size = 12
S
common=(--set "run.end_time=10 ms")
sed "s|--quiet|--quiet --set 'run.end_time=10 ms'|" "$source/examples/cluster/study-array.sh" > array.sh
# A shard that was killed in its middle: its task goes on.
timeout -s KILL 0.6 rotordrop study study.toml -o out/shard-2 --shard 2/4 --jobs 1 --quiet "${common[@]}" || true
job=$(sbatch --parsable --array=1-4 array.sh study.toml out)
sbatch --wait --dependency="afterany:$job" --wrap 'rotordrop study join out/shard-* -o out/joined'
rotordrop study study.toml -o out/whole --quiet "${common[@]}"
cmp out/joined/study.h5 out/whole/study.h5
cmp out/joined/study.csv out/whole/study.csv
echo "an array of 4 shards joined to the same bits as one run"
