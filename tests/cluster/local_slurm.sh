# A Slurm of one node on this machine, without installing it or being root: source it, then
#
#   slurm_up FOLDER     0: sbatch and its kin are on the PATH; 77: there is no Slurm, $slurm_missing says why
#   slurm_down
#   slurm_kill_node     as a power failure would: its daemon and all that it started, at once
#   slurm_start_node
#
# The programs are those installed, or those of Debian's packages, fetched and unpacked into FOLDER.
slurm_processes=()

slurm_programs() {  # FOLDER
  local root=$1/root file
  if command -v slurmctld >/dev/null && command -v slurmd >/dev/null && command -v munged >/dev/null; then
    slurm_plugins=$(dirname "$(find /usr/lib -path '*slurm*' -name auth_munge.so -print -quit 2>/dev/null)")
    slurm_ctld=$(command -v slurmctld) slurm_d=$(command -v slurmd) slurm_munged=$(command -v munged)
    slurm_stepd=$(command -v slurmstepd)
    return
  fi
  command -v apt-get >/dev/null && command -v dpkg >/dev/null || { slurm_missing="no slurmctld, and no apt-get to fetch it"; return 77; }
  mkdir -p "$1/packages" "$root"
  (cd "$1/packages" && timeout 120 apt-get download slurm-wlm-basic-plugins slurmctld slurmd slurm-client munge libmunge2) \
    >"$1/apt.log" 2>&1 || { slurm_missing="no slurmctld, and its packages cannot be fetched: $(tail -n 1 "$1/apt.log")"; return 77; }
  for file in "$1"/packages/*.deb; do dpkg -x "$file" "$root"; done
  local lib
  lib=$(dirname "$(find "$root" -type d -name slurm-wlm -path '*/lib/*' -print -quit)")
  slurm_plugins=$lib/slurm-wlm
  export LD_LIBRARY_PATH=$lib:$slurm_plugins${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} PATH=$root/usr/bin:$PATH
  slurm_ctld=$root/usr/sbin/slurmctld-wlm slurm_d=$root/usr/sbin/slurmd-wlm slurm_munged=$root/usr/sbin/munged
  slurm_stepd=$root/usr/sbin/slurmstepd-wlm
  "$slurm_ctld" -V >"$1/version" 2>&1 || { slurm_missing="slurmctld does not start: $(tail -n 1 "$1/version")"; return 77; }
}

slurm_configuration() {  # FOLDER
  local port=$((20000 + RANDOM % 20000))
  cat <<CONF
ClusterName=driftscope
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$1/run/munge.sock,cred_expire=5
CryptoType=crypto/munge
PluginDir=$slurm_plugins
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$1/spool/ctld
SlurmdSpoolDir=$1/spool/d
SlurmctldPidFile=$1/run/ctld.pid
SlurmdPidFile=$1/run/d.pid
SlurmctldLogFile=$1/log/ctld.log
SlurmdLogFile=$1/log/d.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
JobRequeue=1
KillWait=5
MinJobAge=600
SchedulerParameters=sched_interval=2,batch_sched_delay=0
SlurmdParameters=config_overrides
NodeName=$(hostname) NodeAddr=127.0.0.1 CPUs=8 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
}

slurm_start_node() {
  setsid "$slurm_d" -D -f "$slurm_folder/slurm.conf" -d "$slurm_stepd" >"$slurm_folder/log/d.out" 2>&1 &
  slurm_node=$!
  disown "$slurm_node"
  for ((i = 0; i < 60; ++i)); do
    scontrol update nodename="$(hostname)" state=resume >/dev/null 2>&1
    sinfo -h -o %T 2>/dev/null | grep -qE 'idle|mixed|allocated' && return
    sleep 0.5
  done
  return 1
}

slurm_up() {  # FOLDER
  slurm_folder=$(realpath -m "$1")
  mkdir -p "$slurm_folder"/{spool/ctld,spool/d,log,run}
  slurm_programs "$slurm_folder" || return
  slurm_configuration "$slurm_folder" >"$slurm_folder/slurm.conf"
  export SLURM_CONF=$slurm_folder/slurm.conf
  (umask 077 && head -c 1024 /dev/urandom >"$slurm_folder/munge.key")
  setsid "$slurm_munged" --force -F --key-file="$slurm_folder/munge.key" --socket="$slurm_folder/run/munge.sock" \
    --pid-file="$slurm_folder/run/munged.pid" --seed-file="$slurm_folder/run/seed" \
    --log-file="$slurm_folder/log/munged.log" >/dev/null 2>&1 &
  slurm_processes+=($!)
  for ((i = 0; i < 40; ++i)); do [ -S "$slurm_folder/run/munge.sock" ] && break; sleep 0.1; done
  setsid "$slurm_ctld" -D -f "$SLURM_CONF" >"$slurm_folder/log/ctld.out" 2>&1 &
  slurm_processes+=($!)
  disown -a
  for ((i = 0; i < 60; ++i)); do scontrol ping 2>/dev/null | grep -q UP && break; sleep 0.5; done
  slurm_start_node || { slurm_missing="no node comes up: $(tail -n 1 "$slurm_folder/log/d.log")"; return 77; }
}

# What runs on the node is what it lists itself; the daemon of a step is the parent of its tasks.
slurm_kill_node() {
  local pid parent listed
  listed=$(scontrol listpids 2>/dev/null | awk 'NR > 1 && $1 > 1 { print $1 }')
  kill -9 "$slurm_node" 2>/dev/null
  for pid in $listed; do
    parent=$(ps -o ppid= -p "$pid" | tr -d ' ')
    [[ -n $parent && $(ps -o comm= -p "$parent") == slurmstepd* ]] && kill -9 "$parent" 2>/dev/null
    kill -9 "$pid" 2>/dev/null
  done
}

slurm_down() {
  [ ${#slurm_processes[@]} -gt 0 ] || return 0
  slurm_kill_node
  kill "${slurm_processes[@]}" 2>/dev/null
  slurm_processes=()
}
