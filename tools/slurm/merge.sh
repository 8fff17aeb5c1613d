#!/usr/bin/env bash
# Puts the shards of a campaign together: the job that tools/slurm/submit lets follow the array.
# Arguments: PROGRAM OUT FOLDER_OF_THESE_SCRIPTS
set -euo pipefail
program=$1 out=$2 here=$3

mapfile -t shards < <(find "$out/shards" -name results.bin -printf '%h\n' | sort -V)
# What counts is what the shards hold, not how Slurm says that their tasks ended.
result=0
"$program" merge --force --out "$out" "${shards[@]}" || result=$?
[ -e "$out/manifest.json" ] || "$here/status" "$out" || true
exit $result
