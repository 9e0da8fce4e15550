#!/usr/bin/env bash
# Computes a run as an array of Slurm tasks, a shard each, and merges them when all are finished:
#
#   experiments/slurm/submit.sh SHARDS OUT RUN...
#   experiments/slurm/submit.sh 100 results/large thin_wall --trials 1e6
#
# RUN is what follows `thinwall run`, without --out and --shard. The shards go to OUT.shards/I-of-N, the result to OUT; both
# must be on a file system that every node sees. Options of sbatch go into the SBATCH_* variables that it reads itself, as in
# SBATCH_PARTITION=long, or into shard.sh. THINWALL names the program; it must be the same build on every node.
set -euo pipefail

if (($# < 3)) || [[ ! $1 =~ ^[1-9][0-9]*$ ]]; then
  sed -n '2,10s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
shards=$1 out=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export THINWALL=${THINWALL:-thinwall}

for word in "$@"; do
  case $word in --dry-run | --list-cells) echo "submit.sh: $word computes nothing; leave it out" >&2; exit 2 ;; esac
done
case $out in *$'\n'*) echo "submit.sh: OUT has more than one line; sbatch takes no such name" >&2; exit 2 ;; esac
# A mistake costs nothing here, and an array of failed tasks there: asked as shard.sh asks.
"$THINWALL" run "$@" --shard "1/$shards" --out "$out.shards/1-of-$shards" --threads 1 --dry-run

# Slurm's default MaxArraySize of 1001 allows the tasks 1 to 1000: more shards are several arrays.
mkdir -p "$out.shards"
batch=1000 jobs=()
for ((first = 0; first < shards; first += batch)); do
  last=$((shards - first < batch ? shards - first : batch))
  jobs+=("$(sbatch --parsable --array="1-$last" --output="$out.shards/%A_%a.log" \
    "$here/shard.sh" "$first" "$shards" "$out.shards" "$@")")
done
dependency=$(IFS=:; echo "${jobs[*]}")
printf -v line '%q merge %q/*-of-%q --out %q' "$THINWALL" "$out.shards" "$shards" "$out"
merge=$(sbatch --parsable --dependency="afterok:$dependency" --job-name=thinwall-merge --output="$out.shards/merge.log" \
  --wrap="$line")
echo "shards: job ${jobs[*]}; merge: job $merge; logs in $out.shards/"
