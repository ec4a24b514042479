#!/usr/bin/env bash
# A map in 16 parts as an array job, and the job that joins them:
#   sbatch examples/slurm/map.sh my-map.toml map.csv
# A part that is killed goes on where it was when its task is requeued; one that is whole is left alone.
#SBATCH --job-name=vibro-map
#SBATCH --array=1-16
#SBATCH --cpus-per-task=1
#SBATCH --requeue
set -euo pipefail
scene=$1 out=$2
parts=$(dirname "$out")/parts-$SLURM_ARRAY_JOB_ID
mkdir -p "$parts"
part=$(printf '%s/part-%04d.csv' "$parts" "$SLURM_ARRAY_TASK_ID")
if [ ! -e "$part" ]; then
    RAYON_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1} vibro-audit map "$scene" --format csv \
        --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --resume --out "$part"
fi
# The first task asks for the merge, which waits for all.
if [ "$SLURM_ARRAY_TASK_ID" = 1 ]; then
    sbatch --dependency="afterok:$SLURM_ARRAY_JOB_ID" --job-name=vibro-merge \
        --wrap "vibro-audit merge $(printf '%q' "$parts")/part-*.csv --out $(printf '%q' "$out")"
fi
