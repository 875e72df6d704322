#!/usr/bin/env bash
# Tries what a release consists of, as root on Debian 12. Parts: package, image, proxies; all by default. Called by ./release --check.
#   package   installs dist/bahnwerk_*.deb in a fresh Debian and plans; boots that Debian's systemd, which starts the unit; hangs the service for the
#             watchdog; upgrades, removes, purges, installs again: the jobs are still there
#   image     what dist/bahnwerk_*.tar says of itself, its size; runs it with a read-only root as the user that it names
#   proxies   nginx and Caddy before the service, as deploy/proxy has them: an event stream and a large document go through, and clients live
#             through a restart of the service; and before two processes
set -euo pipefail
cd "$(dirname "$0")/../.."
. .ci/setup.sh
. deploy/package/debian_root.sh
. deploy/package/booted.sh
[ "$(id -u)" = 0 ] || fail "This installs packages and mounts file systems: it needs root."
work=$(mktemp -d /var/tmp/bahnwerk-check.XXXXXX)
pids=()
quit() {
  local pid
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  sleep 0.5
  for pid in "${pids[@]}"; do kill -KILL "$pid" 2>/dev/null || true; done
  unboot
  rm -rf --one-file-system "$work"
}
trap quit EXIT
seconds_since() { awk -v a="$1" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f", b - a }'; }

part_package() {
  install_packages release
  local root=$work/root deb began=$SECONDS start
  deb=$(ls dist/bahnwerk_*.deb) || fail "No package: ./release --package makes it."
  say "A fresh Debian"
  make_debian_root "$root"
  use_own_sources "$root"
  cp "$deb" "$root/root/bahnwerk.deb"
  in_root "$root" apt-get update -q >"$work/log" 2>&1 || fail "apt-get update: $(tail -3 "$work/log")"
  echo "  made in $((SECONDS - began)) s"
  start=$(date +%s.%N)
  in_root "$root" apt-get install -y -q --no-install-recommends /root/bahnwerk.deb >"$work/log" 2>&1 || { tail -20 "$work/log" >&2; fail "apt install"; }
  echo "  apt install ./bahnwerk_*.deb: $(seconds_since "$start") s, $(du -h "$deb" | cut -f1) package, $(grep -oP 'After this operation, \K[^u]*' "$work/log")on the disk with what it depends on"
  in_root "$root" bahnwerk plan /usr/share/doc/bahnwerk/examples/bracket.json >"$work/result.json" || fail "bahnwerk plan"
  jq -e .verification.passed "$work/result.json" >/dev/null || fail "the plan is not verified"
  echo "  and a verified plan: $(seconds_since "$start") s"
  in_root "$root" sh -c 'for each in cc gcc g++ clang cmake; do ! command -v $each || exit 1; done' >/dev/null || fail "there is a compiler"
  in_root "$root" bahnwerk --version
  in_root "$root" bash -c '. /usr/share/bash-completion/completions/bahnwerk
    COMP_WORDS=(bahnwerk fetch --format ""); COMP_CWORD=3; _bahnwerk; [[ ${COMPREPLY[*]} == "csv ndjson f64 json" ]]' || fail "completion"
  zcat "$root/usr/share/man/man1/bahnwerk.1.gz" | grep -q 'environment BAHNWERK_LISTEN' || fail "manual page"
  [ "$(stat -c '%U %a' "$root/var/lib/bahnwerk" 2>/dev/null | cut -d' ' -f2)" = 750 ] || fail "the state directory"

  say "Its unit, started by systemd"
  in_root "$root" apt-get install -y -q --no-install-recommends systemd >"$work/log" 2>&1 || { tail -20 "$work/log" >&2; fail "systemd"; }
  # So that the watchdog need not be waited for.
  mkdir -p "$root/etc/systemd/system/bahnwerk.service.d"
  printf '[Service]\nWatchdogSec=3\n' >"$root/etc/systemd/system/bahnwerk.service.d/check.conf"
  boot "$root"
  unit_is active
  echo "  $(property StatusText); $(booted systemd-analyze security --no-pager bahnwerk.service 2>/dev/null | tail -n 1 | sed 's/^[^a-zA-Z]*//')"
  [ "$(property Type) $(property User)" = "notify bahnwerk" ] || fail "type and user of the unit"
  booted bahnwerk submit --wait --idempotency-key first /usr/share/doc/bahnwerk/examples/bracket.json >"$work/result.json" || fail "a job through the unit"
  jq -e .verification.passed "$work/result.json" >/dev/null || fail "the unit's plan is not verified"
  local job
  job=$(booted bahnwerk submit --idempotency-key first /usr/share/doc/bahnwerk/examples/bracket.json | jq -r .id)
  booted sh -c 'kill -STOP $(systemctl show -P MainPID bahnwerk)'
  for _ in $(seq 300); do [ "$(property NRestarts)" = 1 ] && break; sleep 0.2; done
  [ "$(property NRestarts)" = 1 ] || fail "the watchdog did not restart a service that hangs"
  unit_is active
  has_job "$job" "a restart by the watchdog"
  echo "  hung: restarted by the watchdog"
  rm "$root/etc/systemd/system/bahnwerk.service.d/check.conf"

  say "Upgrade, removal, purge"
  dpkg-deb -R "$deb" "$work/next"
  sed -i '/^Version:/s/-1$/-2/' "$work/next/DEBIAN/control"
  dpkg-deb -b --root-owner-group "$work/next" "$work/next.deb" >/dev/null
  booted sh -c 'cat >/root/next.deb' <"$work/next.deb"
  local before after
  before=$(property MainPID)
  booted dpkg -i /root/next.deb >"$work/log" 2>&1 || { tail -5 "$work/log" >&2; fail "the upgrade"; }
  unit_is active
  after=$(property MainPID)
  [ "$before" != "$after" ] || fail "an upgrade restarts the service"
  has_job "$job" "an upgrade"
  booted dpkg -r bahnwerk >"$work/log" 2>&1 || { tail -5 "$work/log" >&2; fail "the removal"; }
  booted sh -c '! systemctl is-active -q bahnwerk && ! command -v bahnwerk >/dev/null && [ -s /var/lib/bahnwerk/bahnwerk.db ]' || fail "removal stops the service and leaves the data"
  booted dpkg -P bahnwerk >"$work/log" 2>&1 || { tail -5 "$work/log" >&2; fail "the purge"; }
  booted sh -c '[ ! -e /etc/default/bahnwerk ] && [ -s /var/lib/bahnwerk/bahnwerk.db ]' || fail "a purge leaves the data"
  booted dpkg -i /root/bahnwerk.deb >"$work/log" 2>&1 || { tail -5 "$work/log" >&2; fail "the second installation"; }
  unit_is active
  has_job "$job" "removal, purge and a second installation"
  echo "  the jobs are still there"
  unboot
}
# has_job ID AFTER
has_job() { booted bahnwerk fetch "$1" --format csv >"$work/rows.csv" && grep -q '^x,y,' "$work/rows.csv" || fail "the job is lost after $2"; }

part_image() {
  install_packages release
  export STORAGE_DRIVER=${STORAGE_DRIVER:-vfs} BUILDAH_ISOLATION=chroot
  local tar container root start config size
  tar=$(ls dist/bahnwerk_*.tar) || fail "No image: ./release makes it."
  say "The image"
  container=$(buildah from -q "docker-archive:$tar" 2>/dev/null)
  root=$(buildah mount "$container")
  config=$(buildah inspect "$container" | jq '.Docker.config // .Docker.container_config')
  size=$(du -sxm "$root" | cut -f1)
  echo "  $size MB unpacked"
  [ "$size" -le 150 ] || fail "the image has more than 150 MB"
  jq -e '.User == "10001:10001" and .Healthcheck.Test == ["CMD", "bahnwerk", "health"] and (.Labels["org.opencontainers.image.revision"] | length > 5)
    and (.Volumes | has("/var/lib/bahnwerk")) and .StopSignal == "SIGTERM"' <<<"$config" >/dev/null || fail "the image's configuration: $config"
  # Nothing of the machine that built it.
  [ ! -e "$root/usr/local/share/ca-certificates" ] || [ -z "$(ls -A "$root/usr/local/share/ca-certificates")" ] || fail "the image holds certificates of this machine"
  grep -rqs 'deb.debian.org' "$root/etc/apt" || fail "the image's sources of packages"
  mkdir "$work/volume"
  chown 10001:10001 "$work/volume"
  jq -r '.Env[]' <<<"$config" >"$work/env"
  start=$(date +%s.%N)
  contained() { # as a container's runtime would: its own names, read-only root, no way to more rights
    unshare -pf --mount --net --kill-child bash -c '
      mount --make-rprivate / && ip link set lo up && mount --bind "$1" "$1" && mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" && mount -t tmpfs tmpfs "$1/tmp" &&
        mount --bind "$2" "$1/var/lib/bahnwerk" && mount -o remount,bind,ro "$1" && shift 2 &&
        exec env -i $(cat "$1") chroot "$2" setpriv --reuid=10001 --regid=10001 --clear-groups --no-new-privs --bounding-set=-all bash -c "cd /var/lib/bahnwerk; $3"' - \
      "$root" "$work/volume" "$work/env" "$root" "$1"
  }
  cp examples/bracket.json "$work/volume/"
  contained '
    touch /etc/nothing 2>/dev/null && echo "the root can be written to"
    bahnwerk serve 2>/dev/null && echo "it serves other machines without a key"
    export BAHNWERK_KEY=$(bahnwerk key add check --scope submit,read 2>/dev/null)
    env -u BAHNWERK_KEY bahnwerk serve 2>log & pid=$!
    for i in $(seq 600); do bahnwerk health --ready >/dev/null 2>&1 && break; sleep 0.05; done
    bahnwerk health --ready >/dev/null || { cat log; exit 1; }
    bahnwerk submit --wait bracket.json >result.json || exit 1
    id -u; kill -TERM $pid; wait $pid; echo "exit $?"' >"$work/out" 2>&1 || { cat "$work/out" >&2; fail "the image does not run"; }
  [ "$(tr '\n' ' ' <"$work/out")" = "10001 exit 0 " ] || fail "the image: $(cat "$work/out")"
  jq -e .verification.passed "$work/volume/result.json" >/dev/null || fail "the image's plan is not verified"
  echo "  started with a read-only root as user 10001, first verified plan: $(seconds_since "$start") s"
  buildah rm "$container" >/dev/null
}

part_proxies() {
  install_packages release_check
  local binary=$PWD/build/release/bahnwerk port=18473 id
  say "Proxies"
  local service
  serve() {
    "$binary" serve --listen 127.0.0.1:$port --worker-nice 0 --store "sqlite:$work/proxy.db" 2>>"$work/service.log" &
    service=$!
    pids+=($service)
  }
  serve
  openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=planning.example.com -addext subjectAltName=IP:127.0.0.1 -keyout "$work/key.pem" -out "$work/cert.pem" 2>/dev/null
  { echo "pid $work/nginx.pid; error_log $work/nginx.log; events {} http { access_log off;"
    sed -e "s#127.0.0.1:8080#127.0.0.1:$port#; s#listen 80;#listen 127.0.0.1:18480;#; s#listen 443#listen 127.0.0.1:18443#; /listen \[::\]/d" \
      -e "s#/etc/ssl/private/planning.example.com.key#$work/key.pem#; s#/etc/ssl/planning.example.com.pem#$work/cert.pem#" deploy/proxy/nginx.conf
    echo "}"; } >"$work/nginx.conf"
  nginx -t -q -c "$work/nginx.conf" || fail "nginx -t"
  nginx -c "$work/nginx.conf" -g 'daemon off;' &
  pids+=($!)
  sed -e "s#^planning.example.com {#{\n\tadmin off\n\tauto_https off\n}\nhttp://127.0.0.1:18481 {#; s#127.0.0.1:8080#127.0.0.1:$port#" deploy/proxy/Caddyfile >"$work/Caddyfile"
  caddy validate --adapter caddyfile --config deploy/proxy/Caddyfile >"$work/log" 2>&1 || { tail -3 "$work/log" >&2; fail "caddy validate"; }
  XDG_DATA_HOME=$work XDG_CONFIG_HOME=$work caddy run --adapter caddyfile --config "$work/Caddyfile" >"$work/caddy.log" 2>&1 &
  pids+=($!)
  # A drawing of many lines: 3 MB, some seconds of planning.
  jq -n '{kind: "contour", spec: {contour: {start: [0, 0], blocks: [{mode: "cut", segments: [range(30000) | {arc: {to: [2 * . + 2, 0], center: [2 * . + 1, 0],
    direction: (if . % 2 == 0 then "cw" else "ccw" end)}}]}]}, machine: {kinematics: "cartesian", cycle_time: 0.001, axes: {x: {velocity: 1800, acceleration: 16000},
    y: {velocity: 1800, acceleration: 16000}}}, planning: {method: "time_optimal"}}}' >"$work/long.json"
  jq '.spec.contour.blocks[0].segments |= .[:1000]' "$work/long.json" >"$work/waves.json"
  local proxy base
  declare -A ca=([nginx]="--ca $work/cert.pem")
  for proxy in nginx caddy; do
    [ $proxy = nginx ] && base=https://127.0.0.1:18443 || base=http://127.0.0.1:18481
    for _ in $(seq 100); do curl -kfs "$base/healthz" >/dev/null && break; sleep 0.1; done
    id=$(curl -kfs "$base/v1/jobs" -H 'Content-Type: application/json' --data-binary @"$work/long.json" | jq -r .id) || fail "$proxy: a large document"
    # The first event comes while the job runs: nothing holds the stream back. The stream ends with the job.
    curl -kNs --max-time 120 "$base/v1/jobs/$id/events" >"$work/events" &
    local stream=$!
    for _ in $(seq 600); do grep -q '^event: progress' "$work/events" 2>/dev/null && break; sleep 0.1; done
    [ "$(curl -kfs "$base/v1/jobs/$id" | jq -r .state)" = running ] || fail "$proxy: no event before the end"
    curl -kfs -X POST "$base/v1/jobs/$id/cancel" >/dev/null
    wait $stream || fail "$proxy: the event stream does not end"
    grep -q '"state":"cancelled"' "$work/events" || fail "$proxy: the last event"
    id=$(curl -kfs "$base/v1/jobs" -H 'Content-Type: application/json' --data-binary @examples/line.json | jq -r .id)
    curl -kfs -H 'Prefer: wait=60' "$base/v1/jobs/$id" | jq -e '.state == "succeeded"' >/dev/null || fail "$proxy: a held answer"
    # Killed while a client waits for a job: others hear when to come again, and this one gets its result.
    "$binary" submit --wait --patience 120 "$work/waves.json" --server "$base" ${ca[$proxy]:-} >"$work/result.json" 2>"$work/err" &
    local submit=$! status
    for _ in $(seq 600); do grep -q '^bahnwerk: job ' "$work/err" 2>/dev/null && break; sleep 0.1; done
    kill -KILL $service
    wait $service 2>/dev/null || true
    status=$(curl -ks -o "$work/body" -D "$work/headers" -w '%{http_code}' "$base/v1/jobs")
    [[ $status == 503 && $(tr -d '\r' <"$work/headers") =~ [Rr]etry-[Aa]fter:\ [0-9] ]] && jq -e '.status == 503' "$work/body" >/dev/null || fail "$proxy: $status without the service"
    serve
    wait $submit || fail "$proxy: submit --wait over a restart: $(cat "$work/err")"
    jq -e .verification.passed "$work/result.json" >/dev/null || fail "$proxy: the result after the restart"
    echo "  $proxy: a document of $(du -h "$work/long.json" | cut -f1), an event stream and a held answer go through; submit --wait lives through a restart"
  done
  [ "$(curl -s -o /dev/null -w '%{http_code}' http://127.0.0.1:18480/)" = 308 ] || fail "nginx: to https"
  tests/deploy/proxies.py
}

parts=("$@")
[ ${#parts[@]} -gt 0 ] || parts=(package image proxies)
for part in "${parts[@]}"; do
  [ "$(type -t "part_$part")" = function ] || fail "Unknown part '$part': package, image or proxies."
  "part_$part"
done
say "Passed: ${parts[*]}"
