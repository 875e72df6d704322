# Sourced: a folder that holds a Debian, as a machine of its own.

# in_root DIR COMMAND…: runs it in the folder, with processes and devices.
in_root() {
  local dir=$1
  shift
  unshare -pf --mount --kill-child bash -c '
    mount --make-rprivate / && mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" && exec chroot "$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive $(env | grep -iE "^(https?|no)_proxy=" || true) "${@:2}"' - "$dir" "$@" </dev/null
}

check_group=/sys/fs/cgroup/systemd/bahnwerk-check
# unboot: ends it, if it runs.
unboot() {
  [ -z "${booted:-}" ] || kill -KILL "$booted" 2>/dev/null || true
  [ ! -d "$check_group" ] || for _ in $(seq 50); do
    find "$check_group" -depth -type d -exec rmdir {} + 2>/dev/null && break
    sleep 0.1
  done
}

# boot DIR: starts its systemd as process 1 of namespaces of its own, network included; sets $booted, the process.
boot() {
  local dir=$1 unit
  # What concerns a kernel that is not its own.
  for unit in systemd-sysctl.service systemd-modules-load.service systemd-udevd.service systemd-udev-trigger.service sys-kernel-debug.mount sys-kernel-tracing.mount \
    dev-hugepages.mount sys-fs-fuse-connections.mount systemd-networkd.service; do
    ln -sf /dev/null "$dir/etc/systemd/system/$unit"
  done
  # Control groups of its own, below one that unboot() takes away.
  [ ! -d /sys/fs/cgroup/systemd ] || mkdir -p "$check_group"
  (
    [ ! -d "$check_group" ] || echo "$BASHPID" >"$check_group/cgroup.procs"
    exec unshare -pf --mount --uts --ipc --cgroup --net --kill-child bash -c '
    set -e
    cd "$1"
    mount --make-rprivate /
    ip link set lo up
    mount --bind . .
    cd "$1"
    mount -t proc proc proc
    mount -o bind,ro proc/sys proc/sys
    mount -t sysfs -o ro sysfs sys
    mount -t tmpfs tmpfs sys/fs/cgroup
    mkdir sys/fs/cgroup/systemd
    mount -t cgroup -o none,name=systemd cgroup sys/fs/cgroup/systemd 2>/dev/null || { umount sys/fs/cgroup; mount -t cgroup2 cgroup2 sys/fs/cgroup; }
    mount -t tmpfs -o mode=755 tmpfs dev
    for each in null:3 zero:5 full:7 random:8 urandom:9; do mknod -m 666 "dev/${each%:*}" c 1 "${each#*:}"; done
    mknod -m 666 dev/tty c 5 0
    ln -s /proc/self/fd dev/fd
    mkdir dev/shm dev/pts
    mount -t devpts -o newinstance,ptmxmode=0666,mode=0620,gid=5 devpts dev/pts
    ln -s pts/ptmx dev/ptmx
    touch dev/console
    mount -t tmpfs -o mode=755 tmpfs run
    # A chroot is not enough: units are given mount namespaces of their own.
    pivot_root . .
    umount -l .
    exec env -i container=check PATH=/usr/sbin:/usr/bin:/sbin:/bin /lib/systemd/systemd --unit=multi-user.target' - "$dir"
  ) </dev/null >"$dir.boot.log" 2>&1 &
  local starter=$!
  for _ in $(seq 300); do
    booted=$(pgrep -P "$starter" -f /lib/systemd/systemd || true)
    [ -n "$booted" ] && [ "$(booted systemctl is-system-running 2>/dev/null)" = running ] && return
    kill -0 "$starter" 2>/dev/null || break
    sleep 0.2
  done
  cat "$dir.boot.log" >&2
  [ -z "$booted" ] || booted systemctl --failed --no-pager >&2 || true
  fail "systemd does not start"
}

# booted COMMAND…: runs it there.
booted() {
  nsenter -t "$booted" -m -p -u -i -C -n -r -w env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"
}
property() { booted systemctl show -P "$1" bahnwerk.service; }
# unit_is STATE: waits for it.
unit_is() {
  local _
  for _ in $(seq 300); do
    [ "$(property ActiveState)" = "$1" ] && return
    [ "$(property ActiveState)" = failed ] && break
    sleep 0.2
  done
  booted journalctl -u bahnwerk.service --no-pager -n 20 >&2 || true
  fail "the unit is $(property ActiveState), not $1"
}
