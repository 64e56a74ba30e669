#!/bin/sh
#SBATCH --job-name=ambulo
#SBATCH --array=1-4
#SBATCH --cpus-per-task=1
#SBATCH --output=slurm-%a.log
# sbatch --export=ALL,AMBULO=...,SWEEP=...,DIR=... slurm_array.sh
exec "${AMBULO:-ambulo}" batch "$SWEEP" -o "$DIR" --grace 25 \
  -j "$SLURM_CPUS_PER_TASK" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_MAX"
