#!/usr/bin/env bash
# Flies one shard of a campaign: a task of the array that tools/slurm/submit submits.
# Arguments: PROGRAM SCENARIO OUT SHARDS [OPTIONS OF dodgesim run]
set -euo pipefail
program=$1 scenario=$2 out=$3 shards=$4
shift 4
shard=$SLURM_ARRAY_TASK_ID

for manifest in "$out/shards/$shard".*/manifest.json; do
  [ ! -e "$manifest" ] || { echo "shard $shard is complete: $manifest"; exit 0; }
done

# Slurm starts a task again when it has lost its node, which may go on flying nevertheless; and
# locks need not hold between hosts that share a disk. So each attempt has a directory of its own.
attempt=0
until mkdir "$out/shards/$shard.$attempt" 2>/dev/null; do
  [ -d "$out/shards/$shard.$attempt" ] || mkdir "$out/shards/$shard.$attempt" || exit 4
  attempt=$((attempt + 1))
done
mine=$out/shards/$shard.$attempt

# It goes on with what the attempt before it that came farthest had finished. A journal that is
# still being written to can be copied: what was cut off is flown again.
farthest=$(stat --format='%s %n' "$out/shards/$shard".*/results.bin 2>/dev/null |
  sort -rn | head -n 1 | cut -d' ' -f2-) || true
if [ -n "$farthest" ]; then
  echo "shard $shard goes on with $farthest"
  cp "$farthest" "$mine/results.bin.copy"
  mv "$mine/results.bin.copy" "$mine/results.bin"
fi
echo "shard $shard of $shards, attempt $attempt on ${SLURMD_NODENAME:-$(hostname)}"
exec "$program" run "$scenario" --out "$mine" --shard "$shard/$shards" --resume \
  -j "${SLURM_CPUS_PER_TASK:-1}" "$@"
