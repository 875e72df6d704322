#!/usr/bin/env bash
# More connections than there is room for: silent ones make room, slow ones are cut, health and readiness always answer.
source "$(dirname "$0")/lib.sh"
ulimit -n 8192 2>/dev/null || ulimit -n "$(ulimit -Hn)"

# open_silent N: N connections that say nothing; their descriptors are in $silent.
silent=()
open_silent() {
  for _ in $(seq "$1"); do
    exec {fd}<>"/dev/tcp/$host/$port" || fail "cannot connect"
    silent+=("$fd")
  done
}
close_silent() {
  for fd in "${silent[@]}"; do exec {fd}>&-; done
  silent=()
}
# answered PATH: the status of a request on a connection of its own.
answered() { curl -s --max-time 100 -o "$work/body" -D "$work/headers" -w '%{http_code}' "$url$1" || true; }

# 1 100 silent connections, more than the limit, and nobody else notices.
start_server --workers 0
post "$examples/line.json"
open_silent 1100
for _ in 1 2 3; do
  expect_equal "$(answered /healthz)" 200 "health beside silent connections"
  expect_equal "$(answered /readyz)" 200 "readiness beside silent connections"
  expect_equal "$(answered "/v1/jobs/$id")" 200 "a job beside silent connections"
done
close_silent
stop_server || fail "orderly end"

# The same where one address may have few: it is its own oldest that go.
start_server --workers 0 --max-connections-per-address 10
open_silent 30
expect_equal "$(answered /v1/kinds)" 200
expect_equal "$(answered /metrics)" 200
# Those that were asked to leave hold their sockets for a moment.
few_are_open() { [[ $(answered /metrics) == 200 ]] && (($(sed -n 's/^bahnwerk_http_connections //p' "$work/body") <= 12)); }
soon few_are_open || fail "more than 12 connections of one address"
close_silent
stop_server || fail "orderly end"

# Where nobody is idle: held answers take all places; health and readiness still answer, others hear why not.
start_server --workers 1 --max-connections 5 --spare-connections 3 --write-timeout 3600
jq '.spec.contour.blocks[0].feed = 0.5' "$examples/line.json" >"$work/slow.json" # 200 000 rows, of which a client that hardly reads takes few
post "$work/slow.json"
await succeeded
held=()
# all_held: five answers are held. One that had only connected when the next came makes room for it, and is asked for again; the look comes a turn later, so
# that it is not this next one.
all_held() {
  local n asked=0
  for n in 0 1 2 3 4; do
    if [[ -z ${held[n]:-} ]] || ! kill -0 "${held[n]}" 2>/dev/null; then
      curl -s --max-time 600 --limit-rate 100 -H 'Accept: text/csv' "$url/v1/jobs/$id/setpoints" >/dev/null &
      held[n]=$!
      asked=1
    fi
  done
  ((asked == 0)) && [[ $(answered /v1/kinds) == 503 ]]
}
soon all_held || fail "the answers are not held"
for _ in 1 2 3 4 5 6; do
  expect_equal "$(answered /healthz)" 200 "health on a spare connection"
  expect_equal "$(answered /readyz)" 200 "readiness on a spare connection"
done
status=$(answered /v1/kinds)
expect_problem too-many-connections 503
[[ $(header Retry-After) -gt 0 ]] || fail "expected Retry-After"
kill "${held[@]}" 2>/dev/null || true
wait "${held[@]}" 2>/dev/null || true
stop_server || fail "orderly end"

# The time of a header runs from connecting, however slowly it dribbles in; who is cut in the middle is told.
start_server --workers 0 --header-timeout 2 --body-timeout 2 --idle-timeout 600
# raw_answer: sends stdin, prints what comes back until the server closes; at most 60 s.
raw_answer() {
  exec 3<>"/dev/tcp/$host/$port"
  cat >&3 2>/dev/null || true
  timeout 60 cat <&3 || true
  exec 3>&- 3<&-
}
cut_off() {
  local began=$(date +%s%N) took
  raw_answer | tr -d '\r' >"$work/raw"
  took=$((($(date +%s%N) - began) / 1000000))
  ((took >= 1900)) || fail "cut after $took ms"
  sed -n '1,/^$/p' "$work/raw" >"$work/headers"
  sed '1,/^$/d' "$work/raw" >"$work/body"
  status=$(sed -n '1s/.* \([0-9][0-9][0-9]\) .*/\1/p' "$work/raw")
}
cut_off < <(printf 'GET /healthz HTTP/1.1\r\nHost: localhost\r\nX-Half:')
expect_status 408
expect_json '.type == "/problems/request-timeout"'
cut_off < <(printf 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 50\r\n\r\n{"half')
expect_problem request-timeout 408
cut_off < <(printf 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n5\r\n{"hal')
expect_problem request-timeout 408
cut_off < <(printf 'GET /healthz HTTP/1.1\r\nHost: localhost\r\n' && for _ in $(seq 300); do printf 'X: y\r\n' || break; sleep 0.2; done)
expect_status 408
cut_off < <(printf '')
[[ ! -s $work/raw ]] || fail "a connection that never said anything is closed without an answer"
# A body that keeps coming may take longer than its base time: 1 s more for every 100 kB of it.
{
  printf 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 3000000\r\nConnection: close\r\n\r\n'
  head -c 2900000 /dev/zero | tr '\0' ' '
} >"$work/most"
head -c 100000 /dev/zero | tr '\0' ' ' >"$work/rest"
{
  cat "$work/most"
  sleep 3
  cat "$work/rest"
} | raw_answer | head -n 1 | grep -q ' 400 ' || fail "a steady body was not read to its end"
# After a request the header's time is the idle one.
exec 3<>"/dev/tcp/$host/$port"
printf 'GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n' >&3
sleep 3
printf 'GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n' >&3
expect_equal "$(timeout 60 cat <&3 | grep -c '200 OK')" 2 "a connection that rested 3 s"
exec 3>&- 3<&-
stop_server || fail "orderly end"

# Half a body on every connection there is: bodies that have not stood still for long keep their places.
half_body() {
  exec {fd}<>"/dev/tcp/$host/$port"
  printf 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 50\r\n\r\n{"half' >&"$fd"
  silent+=("$fd")
}
start_server --workers 0 --max-connections 20 --spare-connections 4 --body-timeout 600 --stall-timeout 600
for _ in $(seq 19); do half_body; done
# Until the server has read it, half a body is a silent connection, which makes room.
all_taken() { half_body && [[ $(answered /v1/kinds) == 503 ]]; }
soon all_taken || fail "bodies that have not stood still for long make room"
expect_equal "$(answered /healthz)" 200 "health beside half bodies"
close_silent
stop_server || fail "orderly end"

# Those that stand still make room.
start_server --workers 0 --max-connections 20 --spare-connections 4 --body-timeout 600 --stall-timeout 1
for _ in $(seq 20); do half_body; done
room() { [[ $(answered /v1/kinds) == 200 ]]; }
soon room || fail "half a body makes no room"
# Which of them it is depends on the order in which the server read them.
one_is_told() {
  for fd in "${silent[@]}"; do
    answer=''
    read -r -t 0.2 answer <&"$fd" || true
    [[ $answer != "HTTP/1.1 408 Request Timeout"* ]] || return 0
  done
  return 1
}
soon one_is_told || fail "the one that made room is not told"
close_silent

# Bodies that trickle stand still, too: a byte now and then keeps no place.
stop_server || fail "orderly end"
start_server --workers 0 --max-connections 20 --spare-connections 4 --body-timeout 600 --stall-timeout 1
for _ in $(seq 20); do half_body; done
(while :; do
  for fd in "${silent[@]}"; do printf ' ' >&"$fd" || true; done
  sleep 0.2
done) 2>/dev/null &
trickle=$!
soon room || fail "a body that trickles makes no room"
kill "$trickle"
wait "$trickle" 2>/dev/null || true
close_silent

# All bodies together have a budget.
stop_server || fail "orderly end"
start_server --workers 0 --max-bodies 100000
head -c 150000 /dev/zero | tr '\0' ' ' >"$work/blank"
post "$work/blank"
expect_problem too-many-connections 503
head -c 90000 /dev/zero | tr '\0' ' ' >"$work/blank"
for _ in 1 2 3; do
  post "$work/blank"
  expect_problem invalid-json 400
done
