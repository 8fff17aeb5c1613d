# A Slurm of two nodes on this host, without systemd: to be sourced by a test that runs as root.
# shellcheck shell=bash

# Starts it; sets cluster_dir, in which all of it lives. Everything ends with the test.
start_cluster() {
  cluster_dir=$(mktemp -d /tmp/dodgesim_slurm.XXXXXX)
  trap stop_cluster EXIT
  trap 'exit 130' INT TERM HUP
  # Should the test be killed with -9, somebody must still clean up.
  (stop_cluster_after_the_test &>/dev/null &)
  chmod 755 "$cluster_dir"
  local port
  port=$(three_free_ports)
  write_slurm_conf "$port"

  dd if=/dev/urandom of="$cluster_dir/munge.key" bs=1k count=1 status=none
  chmod 600 "$cluster_dir/munge.key"
  in_cluster munged --foreground --key-file="$cluster_dir/munge.key" \
    --socket="$cluster_dir/munge.socket" --pid-file="$cluster_dir/munge.pid" \
    --seed-file="$cluster_dir/munge.seed" &>"$cluster_dir/munged.log" &
  wait_until 10 test -S "$cluster_dir/munge.socket"
  in_cluster slurmctld -D &>"$cluster_dir/slurmctld.out" &
  start_node n1
  start_node n2
  wait_until 30 nodes_idle
}

start_node() {
  DODGESIM_NODE=$1 in_cluster slurmd -D -N "$1" &>"$cluster_dir/slurmd.$1.out" &
}

write_slurm_conf() {
  local host
  host=$(hostname -s)
  cat >"$cluster_dir/slurm.conf" <<EOF
ClusterName=dodgesim
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$1
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
# cred_expire is how long a lost task waits before it may start again [s].
AuthInfo=socket=$cluster_dir/munge.socket,cred_expire=5
StateSaveLocation=$cluster_dir/state
SlurmctldPidFile=$cluster_dir/slurmctld.pid
SlurmctldLogFile=$cluster_dir/slurmctld.log
SlurmdSpoolDir=$cluster_dir/spool.%n
SlurmdPidFile=$cluster_dir/slurmd.%n.pid
SlurmdLogFile=$cluster_dir/slurmd.%n.log
SlurmdParameters=config_overrides
SlurmdTimeout=10
SchedulerParameters=sched_interval=2,bf_interval=2
ReturnToService=2
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$(($1 + 1)) CPUs=1
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$(($1 + 2)) CPUs=1
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
EOF
  mkdir "$cluster_dir/state"
}

# Runs a command as a user of the cluster. The variable also marks everything that belongs to it.
in_cluster() { SLURM_CONF=$cluster_dir/slurm.conf "$@"; }

# The first of three neighbouring ports that nobody listens on, below those that the system gives.
three_free_ports() {
  local port k
  while true; do
    port=$((20000 + RANDOM % 10000))
    for k in 0 1 2; do
      if (: <"/dev/tcp/127.0.0.1/$((port + k))") 2>/dev/null; then continue 2; fi
    done
    echo "$port"
    return
  done
}

nodes_idle() { [ "$(in_cluster sinfo -h -N -t idle -o %N 2>/dev/null | sort -u | wc -l)" -eq 2 ]; }

# Tries a command until it succeeds, for so many seconds; less if the test takes too long anyway.
wait_until() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    if [ $SECONDS -ge $end ] || [ $SECONDS -ge 240 ]; then
      echo "FAIL: waited in vain for: $*" >&2
      return 1
    fi
    sleep 0.1
  done
}

# Processes of the cluster in whose environment there is VARIABLE=VALUE; all without an argument.
# shellcheck disable=SC2120
processes() {
  local environments pid
  environments=$(holding "SLURM_CONF=$cluster_dir/slurm.conf" /proc/[0-9]*/environ)
  # shellcheck disable=SC2086
  [ $# -eq 0 ] || environments=$(holding "$1" $environments)
  for pid in ${environments//[!0-9$'\n']/}; do
    [ "$pid" -eq $$ ] || echo "$pid"
  done
}

# Those of the files, entries with zeros behind them, in which VARIABLE=VALUE is one. In one go: a
# flight does not wait for whoever looks for it.
holding() { grep -lszxF -- "$1" "${@:2}" </dev/null || true; }

# Kills with -9, until nothing is left that a dying process has started.
stop_cluster() {
  local pids
  while pids=$(processes) && [ -n "$pids" ]; do
    # shellcheck disable=SC2086,SC2119
    kill -9 $pids 2>/dev/null || true
    sleep 0.1
  done
  rm -rf "$cluster_dir"
}

stop_cluster_after_the_test() {
  trap '' INT TERM HUP
  while kill -0 $$ 2>/dev/null; do sleep 1; done
  stop_cluster
}
