#!/usr/bin/env bash
# What broken, slow and greedy clients get, and that the others do not notice.
source "$(dirname "$0")/lib.sh"
start_server --workers 0 --header-timeout 100 --body-timeout 100 --idle-timeout 100 --max-connections 20 --max-body 100000

# raw SECONDS: sends stdin as it is, prints what comes back until the server closes or the time is over.
raw() {
  exec 3<>"/dev/tcp/$host/$port"
  cat >&3
  timeout "$1" cat <&3 || true
  exec 3>&- 3<&-
}
first_line() { head -n 1 | tr -d '\r'; }

expect_equal "$(printf 'GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n' | raw 60 | first_line)" "HTTP/1.1 200 OK"
# Two requests in one packet: two answers.
expect_equal "$(printf 'GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\nGET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n' |
  raw 60 | grep -c '200 OK')" 2 "pipelined"
expect_equal "$(printf 'GET /healthz HTTP/1.0\r\n\r\n' | raw 60 | first_line)" "HTTP/1.0 200 OK" "HTTP/1.0"
expect_equal "$(printf 'GET http://localhost/healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n' | raw 60 | first_line)" \
  "HTTP/1.1 200 OK" "absolute form"
refused() { expect_equal "$(printf "$2" | raw 60 | first_line | cut -d' ' -f2)" "$1" "for $(head -c 60 <<<"$2")"; }
refused 400 'nonsense\r\n\r\n'
refused 400 'GET /%%zz HTTP/1.1\r\nHost: localhost\r\n\r\n'
refused 400 'GET nothing HTTP/1.1\r\nHost: localhost\r\n\r\n'
refused 400 'GET / HTTP/1.1\r\n\r\n'
refused 400 'GET / HTTP/1.1\r\nHost: localhost\r\nHost: y\r\n\r\n'
refused 400 'GET / HTTP/1.1\r\nHost: localhost\r\nBro ken: y\r\n\r\n'
refused 400 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\nContent-Length: 6\r\n\r\nhello'
refused 400 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Length: five\r\n\r\n'
refused 400 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n'
refused 400 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n'
refused 413 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999\r\n\r\n'
refused 413 "POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n1869f\r\n$(head -c 99999 /dev/zero | tr '\0' a)\r\n10\r\naaaaaaaaaaaaaaaa\r\n"
refused 417 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\nExpect: miracles\r\n\r\n'
refused 431 "GET / HTTP/1.1\r\nHost: localhost\r\nX-Long: $(head -c 40000 /dev/zero | tr '\0' a)\r\n\r\n"
refused 505 'GET / HTTP/2.0\r\nHost: localhost\r\n\r\n'
refused 501 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: gzip, chunked\r\n\r\n0\r\n\r\n'
# The refusal is a problem document too.
printf 'GET / HTTP/1.1\r\n\r\n' | raw 60 | tr -d '\r' | sed '1,/^$/d' >"$work/body"
expect_json '.type == "/problems/bad-request" and .status == 400 and (.detail | length > 0)'

# Expect: 100-continue gets its 100 before the body is sent.
expect_equal "$(printf 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 2\r\nExpect: 100-continue\r\nConnection: close\r\n\r\n{}' |
  raw 60 | grep -o '^HTTP/1.1 [0-9]*' | tr '\n' ' ')" "HTTP/1.1 100 HTTP/1.1 422 "

# The connection that has been silent longest makes room for the next; twenty are the limit.
for i in $(seq 20); do exec {fd}<>"/dev/tcp/$host/$port"; silent[i]=$fd; done
request GET /v1/kinds
expect_status 200
timeout 60 cat <&"${silent[1]}" >"$work/first" || fail "the first one was not closed"
expect_equal "$(wc -c <"$work/first")" 0 "it is closed without an answer"
for fd in "${silent[@]}"; do exec {fd}>&-; done
request HEAD /v1/kinds
expect_status 200
length=$(header Content-Length)
request GET /v1/kinds
expect_equal "$(wc -c <"$work/body")" "$length" "HEAD's Content-Length"
request OPTIONS /v1/jobs
expect_status 204
expect_header Allow "DELETE, GET, HEAD, POST, OPTIONS"
request GET /healthz -H "X-Request-Id: $(head -c 200 /dev/zero | tr '\0' x)"
[[ $(header X-Request-Id) =~ ^[0-9a-f]{32}$ ]] || fail "an unusable request id is replaced"
# The log is JSON, line for line, whatever was sent.
request GET "/%00%ff%22%0a%7b"
expect_status 404
stop_server || fail "orderly end"
jq -e . "$work/log" >/dev/null || fail "the log is not JSON lines"
jq -se 'map(select(.event == "request")) | length > 5 and all(has("request") and has("status") and has("ms"))' "$work/log" >/dev/null ||
  fail "request lines of the log"

# closed_after MS: holds until the server closes the connection of a half request; not before this time.
start_server --workers 0 --header-timeout 1 --body-timeout 1 --idle-timeout 2
closed_after() {
  local began=$(date +%s%N) took
  exec 3<>"/dev/tcp/$host/$port"
  cat >&3
  timeout 60 cat <&3 >/dev/null || fail "the connection stays open"
  exec 3>&- 3<&-
  took=$((($(date +%s%N) - began) / 1000000))
  ((took >= $1)) || fail "closed after $took ms, expected $1"
}
printf 'GET / HTTP/1.1\r\nHost: localhost\r\nX-Half:' | closed_after 800                               # header never ends
printf 'POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Length: 50\r\n\r\nhalf' | closed_after 800 # body never ends
printf '' | closed_after 800                                                        # says nothing at all
# Slow loris: bytes that trickle in do not keep the header's time from running. The client ends when it cannot send any more.
exec 3<>"/dev/tcp/$host/$port"
printf 'GET / HTTP/1.1\r\n' >&3
trickle() (
  trap '' PIPE
  for _ in $(seq 300); do printf 'X: y\r\n' >&3 || return 0; sleep 0.2; done 2>/dev/null
  return 1
)
trickle || fail "a slow client held its connection"
exec 3>&- 3<&-
