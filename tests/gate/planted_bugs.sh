#!/usr/bin/env bash
# Whether the gate passes what is unchanged and fails what is worse: the right program against its
# own baseline, then programs with a bug in their core.
# Usage: tests/gate/planted_bugs.sh PROGRAM PROGRAM_WITH_WRONG_WARP PROGRAM_WITH_DOUBLED_THRESHOLD
set -euo pipefail
right=$1
wrong_warp=$2
doubled_threshold=$3
scenario=$(cd "$(dirname "$0")/../.." && pwd)/scenarios/ci.yaml
throws=12
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT

# gate PROGRAM OPTIONS...: its exit code, with the output in $dir/log
gate() {
  local program=$1
  shift
  "$program" gate "$scenario" --set repeats=$throws --baseline "$dir/baseline" --out "$dir/out" \
    --force "$@" > "$dir/log" 2>&1
}

# expect CODE CHECK PROGRAM OPTIONS...: the gate's exit code, and which check decides
expect() {
  local code=0
  gate "${@:3}" || code=$?
  if [ "$code" -ne "$1" ] || ! grep -q "^$2" "$dir/log"; then
    cat "$dir/log"
    echo "FAIL: expected exit code $1 and \"$2\", got $code, of: ${*:3}"
    exit 1
  fi
  grep -E "^(passed|FAILED|left out)" "$dir/log"
}

gate "$right" --update || { cat "$dir/log"; exit 1; }
echo "Unchanged, with one worker and all bytes compared:"
expect 0 "passed: same bytes" "$right" --must-equal all -j 1
# The success rate notices what costs dodges.
echo "20 ms more latency:"
expect 1 "FAILED: success rate" "$right" --must-equal nothing --set delays.compute_us=23500
echo "The threshold doubled:"
expect 1 "FAILED: success rate" "$doubled_threshold" --must-equal nothing
# A vehicle in hover hardly turns before it evades: the warp changes what is seen, not what is
# dodged. The bytes tell.
echo "A wrong sign in the warp:"
expect 1 "FAILED: same bytes" "$wrong_warp" --must-equal all
