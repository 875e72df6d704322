#!/usr/bin/env bash
# Streams of events and waits take three quarters of the connections at most, and end when their clients leave.
source "$(dirname "$0")/lib.sh"

# listen N HEADER…: opens N connections that ask for the job so, and keeps them; their descriptors are in $fds.
fds=()
listen() {
  local n=$1 path=$2 header=$3 fd
  for _ in $(seq "$n"); do
    exec {fd}<>"/dev/tcp/$host/$port"
    printf 'GET %s HTTP/1.1\r\nHost: localhost\r\n%s\r\n\r\n' "$path" "$header" >&"$fd"
    fds+=("$fd")
  done
}
leave() {
  local fd
  for fd in "${fds[@]}"; do exec {fd}>&-; done
  fds=()
}
answered() { request GET "/v1/jobs/$id" && [[ $status == 200 ]]; }
connections() { curl -fsS "$url/metrics" | sed -n 's/^bahnwerk_http_connections //p'; }
few() { (($(connections) < 10)); }

for limits in "--max-connections 40 --max-connections-per-address 0" "--max-connections 400 --max-connections-per-address 40"; do
  start_server --workers 0 $limits
  post "$examples/line.json"
  for kind in "events Accept:_text/event-stream" "_ Prefer:_wait=60"; do
    read -r rest header <<<"$kind"
    path=/v1/jobs/$id
    [[ $rest == _ ]] || path+=/$rest
    listen 60 "$path" "${header/_/ }"
    soon answered || fail "listeners lock others out: $limits, $header"
    first=$id
    post "$examples/line.json"
    expect_status 202
    id=$first
    # The oldest has its answer: a stream that has ended, or the job as it is.
    timeout 60 head -c 12 <&"${fds[0]}" | grep -q 'HTTP/1.1 200' || fail "the oldest listener gets no answer"
    leave
    soon few || fail "listeners that have left keep their connections: $limits, $header"
  done
  stop_server || fail "orderly end"
done

# A stream that had to end goes on where it was.
start_server --workers 0 --max-connections 8 --max-connections-per-address 0
post "$examples/line.json"
curl -sN "$url/v1/jobs/$id/events" >"$work/stream" &
stream=$!
soon grep -q '^id: 1' "$work/stream" || fail "no event"
listen 6 "/v1/jobs/$id/events" 'Accept: text/event-stream'
wait $stream || fail "the stream breaks off instead of ending"
leave
curl -sN -H 'Last-Event-ID: 1' "$url/v1/jobs/$id/events" >"$work/rest" &
stream=$!
request POST "/v1/jobs/$id/cancel"
wait $stream || fail "the stream breaks off"
grep -q '"state":"cancelled"' "$work/rest" || fail "the stream does not go on"
! grep -q '"state":"queued"' "$work/rest" || fail "the stream begins anew"
