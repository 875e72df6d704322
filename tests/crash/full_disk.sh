#!/usr/bin/env bash
# The disk runs full: posts are refused with a problem, nothing acknowledged is lost, jobs can be cancelled and deleted, and all goes
# on when there is space again.
# Needs a file system of its own; exits 77 (skipped) where none can be mounted.
if [[ -z ${INSIDE:-} ]]; then
  user=()
  [[ $(id -u) == 0 ]] || user=(-Ur)
  for how in private unchanged; do  # below a plain chroot nothing can be made private
    unshare "${user[@]}" -m --propagation $how true 2>/dev/null && exec env INSIDE=1 unshare "${user[@]}" -m --propagation $how "$0" "$@"
  done
  exit 77
fi
source "$(dirname "$0")/../contract/lib.sh"
mkdir "$work/disk"
mount -t tmpfs -o size=6m tmpfs "$work/disk" || exit 77
trap 'stop_server KILL >/dev/null 2>&1 || true; umount "$work/disk"; rm -rf "$work"' EXIT
store=$work/disk/store.db

serve() { start_server --store-reserve 512KiB "$@"; }
# fill: takes all the space that is left.
fill() { head -c 20m /dev/zero >"$work/disk/filler" 2>/dev/null || true; }
# ready STATUS: until /readyz has this status.
ready() {
  readiness() { request GET /readyz && [[ $status == "$1" ]]; }
  soon readiness "$1" || fail "/readyz did not become $1"
}

serve --workers 1
ready 200
post "$examples/line.json"
await succeeded
first=$id
stop_server || fail "orderly end"

# Documents of about 150 kB that do not compress well, until there is no space for the next.
head -c 3m /dev/zero >"$work/disk/ballast"
serve --workers 0
awk 'BEGIN {
  srand(5)
  printf "{\"kind\":\"contour\",\"spec\":{\"contour\":{\"points\":[[0,0]"
  for (i = 1; i < 8000; i++) printf ",[%.9g,%.9g]", i + rand(), rand()
  printf "]},\"machine\":{\"kinematics\":\"cartesian\",\"axes\":{\"x\":{\"velocity\":1800,\"acceleration\":16000},"
  printf "\"y\":{\"velocity\":1800,\"acceleration\":16000}},\"cycle_time\":0.001},\"planning\":{\"method\":\"time_optimal\"}}}"
}' >"$work/job.json"
accepted=() refused=0
for _ in $(seq 100); do
  post "$work/job.json"
  case $status in
    202) accepted+=("$id") ;;
    507)
      expect_problem storage-full 507
      [[ $(header Retry-After) =~ ^[0-9]+$ ]] || fail "a full disk says when to come again"
      expect_json '.detail | test("space")'
      refused=$((refused + 1))
      ((refused >= 3)) && break
      ;;
    *) fail "expected 202 or a problem" ;;
  esac
done
((refused >= 3)) || fail "the disk did not run full"
((${#accepted[@]} >= 3)) || fail "the disk was full from the beginning"
request GET /healthz
expect_status 200
request GET "/v1/jobs/$first/result"
expect_status 200
for id in "${accepted[@]}"; do
  request GET "/v1/jobs/$id"
  expect_status 200
done

ready 503
expect_json '.detail | test("space")'

# Killed on a full disk, started on a full disk; there jobs can be cancelled and deleted, again and again.
fill
stop_server KILL || true
serve --workers 0
request GET /readyz
expect_status 503
for id in "$first" "${accepted[@]}"; do
  request GET "/v1/jobs/$id"
  expect_status 200
done
for id in "${accepted[@]}"; do
  request POST "/v1/jobs/$id/cancel"
  expect_status 202
  expect_json '.state == "cancelled"'
done
gone=0
for id in "${accepted[@]:1}"; do
  request DELETE "/v1/jobs/$id"
  expect_status 204
  request GET "/v1/jobs/$id"
  expect_status 404
  gone=$((gone + 1))
done
request GET "/v1/jobs/$first/result"
expect_status 200
# Nothing outside was freed, but the deleted jobs' room is used again.
post "$work/job.json"
expect_status 202
request DELETE "/v1/jobs/$id"
expect_status 204
ready 200
rm "$work/disk/filler"
stop_server || fail "orderly end"

# A running job is cancelled and deleted on a full disk.
serve --workers 1
snake 20000 >"$work/long.json"
post "$work/long.json"
await running
fill
request POST "/v1/jobs/$id/cancel"
expect_status 202
await cancelled 60
request DELETE "/v1/jobs/$id"
expect_status 204
accepted_too=()
for _ in $(seq 100); do
  post "$work/job.json"
  [[ $status == 202 ]] || break
  accepted_too+=("$id")
done
expect_problem storage-full 507
ready 503
for id in "${accepted_too[@]}"; do  # their results would not fit on this disk
  request POST "/v1/jobs/$id/cancel"
  expect_status 202
  await cancelled
done
rm "$work/disk/filler" "$work/disk/ballast"
ready 200
post "$examples/line.json"
expect_status 202
await succeeded
stop_server || fail "orderly end"

# A worker that cannot store its result keeps it until there is space.
serve --workers 1
head -c 20m /dev/zero >"$work/disk/ballast" 2>/dev/null || true
while post "$examples/bracket.json" && [[ $status == 202 ]]; do last=$id; sleep 0.05; done
expect_problem storage-full 507
rm "$work/disk/ballast"
post "$examples/line.json"
expect_status 202
await succeeded
if [[ -n ${last:-} ]]; then
  id=$last
  await succeeded
  expect_json '.attempt == 1'
fi
echo "${#accepted[@]} accepted before the disk was full, $gone deleted on it"
