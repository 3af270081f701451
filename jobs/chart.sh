#!/usr/bin/env bash
#SBATCH --job-name=chart
#SBATCH --ntasks=1
# chart.sh SCENE [options of cablenet chart]: in a Slurm array each task does one part of the runs, without an array it is the chart:
#   id=$(sbatch --parsable --array=1-8 jobs/chart.sh scene.yaml --budget 500)
#   sbatch --dependency=afterany:$id jobs/chart.sh scene.yaml --budget 100
# Slurm runs a copy of this file, so that the program is build/cablenet where sbatch was called, or what CABLENET names.
set -euo pipefail
program=${CABLENET:-build/cablenet}
if [ -n "${SLURM_ARRAY_TASK_ID-}" ]; then
  number=$(((SLURM_ARRAY_TASK_ID - SLURM_ARRAY_TASK_MIN) / ${SLURM_ARRAY_TASK_STEP:-1} + 1))
  set -- "$@" --part "$number/$SLURM_ARRAY_TASK_COUNT"
fi
exec "$program" chart "$@"
