#!/usr/bin/env bash
# Flies a campaign on a Slurm of two nodes and loses one of them midway: its daemons are killed and
# the task that it flew hangs, until it has been started again elsewhere; then both fly on. What is
# merged must be what one machine writes, byte for byte.
# Usage, as root: tests/slurm/campaign_test.sh PROGRAM      (takes one to two minutes)
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
tools=$here/../../tools/slurm
export DODGESIM=$1
for daemon in munged slurmctld slurmd sbatch; do
  command -v $daemon >/dev/null || { echo "$daemon is missing: tools/setup --slurm" >&2; exit 1; }
done
[ "$(id -u)" -eq 0 ] || { echo "Only root can run a Slurm of its own." >&2; exit 1; }
. "$here/cluster.sh"

shards=3
throws=180  # a shard takes many times as long as to lose its node
say() { echo "$SECONDS s: $*"; }

fail() {
  say "FAIL: $*"
  tail -n 20 "$out"/logs/* "$cluster_dir"/*.log || true
  exit 1
}

more_than() { [ "$(stat -c %s "$1" 2>/dev/null || echo 0)" -gt "$2" ]; }

expect_same() {
  for file in throws.csv detections.csv table.md table.csv scenario.resolved.yaml; do
    cmp "$single/$file" "$out/$file" || fail "$file is not what one machine wrote"
  done
}

start_cluster
out=$cluster_dir/out single=$cluster_dir/single
cat >"$cluster_dir/s.yaml" <<'EOF'
seed: 5
pilot: none
fly_oracle: false
throw: {size_m: !choice [0.1, 0.2, 0.3], distance_m: !uniform [2, 5], bearing_deg: !uniform [-25, 25]}
after_s: 0.3
EOF
say "two nodes are up"
in_cluster "$tools/submit" "$cluster_dir/s.yaml" "$out" --shards $shards --throws $throws
"$DODGESIM" run "$cluster_dir/s.yaml" --throws $throws --out "$single" -j 1 >/dev/null &
one_machine=$!

# n1 has begun a shard, and finished some throws of it.
on_n1() { lost=$(grep -ls 'on n1$' "$out"/logs/shard*.log | head -n 1) && [ -n "$lost" ]; }
wait_until 30 on_n1
shard=$(grep -o 'shard [0-9]* of' "$lost" | head -n 1 | tr -cd 0-9)
first=$out/shards/$shard.0 second=$out/shards/$shard.1
wait_until 30 more_than "$first/results.bin" 3000
mapfile -t task < <(processes SLURMD_NODENAME=n1)
mapfile -t daemons < <(processes DODGESIM_NODE=n1)
kill -9 "${daemons[@]}"
# In this order: a stopped task whose parent dies is sent SIGHUP.
gone() { ! kill -0 "${daemons[@]}" 2>/dev/null; }
wait_until 5 gone
kill -STOP "${task[@]}"
[ ! -e "$first/manifest.json" ] || fail "shard $shard was over before its node was lost"
say "n1 is lost with shard $shard; killed ${#daemons[@]} daemons, stopped ${#task[@]} processes"
known=$(stat -c %s "$first/results.bin")

wait_until 120 more_than "$second/results.bin" $((known + 1000))
kill -CONT "${task[@]}"
say "shard $shard is flown again on n2, and on the lost node, too"
wait_until 60 test -e "$out/manifest.json"
say "merged"
grep -q "goes on with $first/results.bin" "$lost" || fail "shard $shard was flown from its start"
wait_until 20 more_than "$first/results.bin" "$known"
wait $one_machine
expect_same

# A shard whose results are gone for good is submitted again, alone.
rm -rf "$out/manifest.json" "$out/shards/2".*
! "$tools/status" "$out" >"$cluster_dir/status" || fail "status takes it for complete"
grep -qx "unfinished of $shards shards: 2" "$cluster_dir/status" || fail "shard 2 is not missed"
in_cluster "$tools/submit" "$cluster_dir/s.yaml" "$out" --shards $shards --throws $throws |
  tee "$cluster_dir/again"
grep -q "^shards 2 (of $shards)" "$cluster_dir/again" || fail "not only shard 2 is submitted"
wait_until 60 test -e "$out/manifest.json"
expect_same
"$tools/status" "$out"
say "PASS"
