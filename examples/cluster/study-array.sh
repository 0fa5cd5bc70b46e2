#!/bin/bash
# A study as a Slurm job array: every task computes one shard with one core, and a last job joins them.
#   sbatch --array=1-8 examples/cluster/study-array.sh STUDY.toml OUT
#   sbatch --dependency=afterany:JOB --wrap 'rotordrop study join OUT/shard-* -o OUT/joined'
# afterany, because afterok waits for ever once a task has failed; `study join` tells which points are missing. A task that is started again
# goes on where it was stopped.
#SBATCH --job-name=rotordrop-study
#SBATCH --cpus-per-task=1
#SBATCH --requeue
set -eu
study=$1 output=$2
rotordrop study "$study" -o "$output/shard-$SLURM_ARRAY_TASK_ID" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --jobs 1 --resume --quiet
