#!/usr/bin/env bash
# One task of the array that submit.sh submits: shard FIRST + task of SHARDS, into FOLDER.
#
# A task that nears its time limit is sent SIGTERM a minute before. The program then keeps what it has finished and ends
# with exit code 130; the task puts itself back into the queue and goes on from there. A task whose node dies is queued again
# by Slurm, and loses only the units that were being computed.
#SBATCH --job-name=thinwall
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --signal=B:TERM@60
#SBATCH --requeue
#SBATCH --open-mode=append
set -uo pipefail
first=$1 shards=$2 folder=$3
shift 3
shard=$((first + SLURM_ARRAY_TASK_ID))
echo "$(date -u +%FT%TZ) shard $shard/$shards on $(hostname), start ${SLURM_RESTART_COUNT:-0}"

"$THINWALL" run "$@" --shard "$shard/$shards" --out "$folder/$shard-of-$shards" --threads "${SLURM_CPUS_PER_TASK:-1}" &
program=$!
trap 'kill -TERM "$program" 2>/dev/null' TERM
wait "$program"
while kill -0 "$program" 2>/dev/null; do # the signal ended that wait, not the program
  wait "$program"
done
wait "$program" # bash remembers how it ended
status=$?

echo "$(date -u +%FT%TZ) shard $shard/$shards ended with exit code $status"
if ((status == 130)); then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
  sleep 60 # until Slurm ends this start of the task
fi
exit "$status"
