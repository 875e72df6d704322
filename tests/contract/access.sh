#!/usr/bin/env bash
# Who reaches the service: beyond loopback, pages of other sites, proxies, a Unix socket.
source "$(dirname "$0")/lib.sh"

# Beyond loopback it serves nobody without keys, and says what to do.
code=0
"$bahnwerk" serve --listen 0.0.0.0:0 --store "sqlite:$work/new.db" 2>"$work/err" || code=$?
[[ $code == 2 ]] || fail "expected 2, got $code"
for word in 'bahnwerk key add' --insecure-listen 127.0.0.1; do grep -qF -- "$word" "$work/err" || fail "the refusal names $word"; done
[[ ! -e $work/new.db ]] || fail "a refusal leaves no store behind"
listen=0.0.0.0:0
start_server --insecure-listen
curl -fsS "http://127.0.0.1:$port/v1/jobs" >/dev/null || fail "--insecure-listen"
stop_server
"$bahnwerk" key add acme --scope submit,read --store "sqlite:$work/store.db" >"$work/key" 2>/dev/null
key=$(cat "$work/key")
start_server
url=http://127.0.0.1:$port
request GET /v1/jobs
expect_problem unauthorized 401
BAHNWERK_KEY=$key "$bahnwerk" submit --wait "$examples/line.json" --server "$url" >/dev/null || fail "the command line sends a key"
"$bahnwerk" submit --wait "$examples/line.json" --server "$url" --key-file "$work/key" >/dev/null || fail "the command line sends a key of a file"
BAHNWERK_KEY=$key python3 "$root/examples/clients/python/bahnwerk.py" --server "$url" "$examples/line.json" >/dev/null || fail "the Python client"
BAHNWERK_KEY=$key node "$root/examples/clients/node/bahnwerk.mjs" "$examples/line.json" "$url" >/dev/null || fail "the Node client"
code=0
"$bahnwerk" submit "$examples/line.json" --server "$url" >/dev/null 2>&1 || code=$?
[[ $code == 2 ]] || fail "without a key it is refused"
stop_server

# Pages of other sites: none changes anything, those allowed do.
store=$work/open.db listen=127.0.0.1:0
start_server --cors-origin https://erp.example --trusted-proxy 127.0.0.1
post "$examples/line.json" -H 'Origin: https://evil.example'
expect_problem forbidden 403
[[ -z $(header Access-Control-Allow-Origin) ]] || fail "no other site reads answers"
post "$examples/line.json" -H 'Origin: https://erp.example'
expect_status 202
expect_header Access-Control-Allow-Origin https://erp.example
[[ $(header Vary) == *Origin* ]] || fail "caches know"
request OPTIONS "/v1/jobs/$id" -H 'Origin: https://erp.example' -H 'Access-Control-Request-Method: DELETE'
expect_status 204
[[ $(header Access-Control-Allow-Methods) == *DELETE* && $(header Access-Control-Allow-Headers) == *Authorization* ]] || fail "what a browser asks before"
request GET /v1/jobs/none -H 'Origin: https://erp.example'
expect_problem not-found 404
expect_header Access-Control-Allow-Origin https://erp.example

# A trusted proxy tells whose address it is, and what it puts before our paths.
proxy=(-H 'X-Forwarded-For: 10.9.8.7' -H 'X-Forwarded-Proto: https' -H 'X-Forwarded-Prefix: /plan')
post "$examples/line.json" "${proxy[@]}"
expect_header Location "/plan/v1/jobs/$id"
expect_json '.links.self == "/plan/v1/jobs/" + $id' --arg id "$id"
soon logged '.event == "request" and .peer == "10.9.8.7" and .job == $id' --arg id "$id" || fail "the log has the client's address"
request GET / -H 'Accept: text/html' "${proxy[@]}"
grep -q "href=\"/plan/jobs/$id\"" "$work/body" || fail "links of pages"
request GET /v1/kinds "${proxy[@]}"
expect_json '.kinds[0].schema | startswith("/plan/v1/schemas/")'
stop_server
start_server
post "$examples/line.json" "${proxy[@]}"
expect_header Location "/v1/jobs/$id"
logged '.event == "request" and .peer == "10.9.8.7"' && fail "nobody else is believed"
stop_server
# The limit per address is the client's, not the proxy's.
start_server --trusted-proxy 127.0.0.1 --max-connections-per-address 1
hold() { curl -sS -o /dev/null -H "X-Forwarded-For: $1" -H 'Prefer: wait=30' "$url/v1/jobs/$waiting" & }
snake 20000 >"$work/snake.json"
post "$work/snake.json" -H 'X-Forwarded-For: 10.0.0.9'
waiting=$id
hold 10.0.0.1
both_open() { request GET /metrics && grep -q '^bahnwerk_http_connections 2' "$work/body"; }
soon both_open || fail "the held request arrives"
held() { request GET /v1/jobs -H 'X-Forwarded-For: 10.0.0.1' && [[ $status == 503 ]]; }
soon held || fail "the limit holds for one client"
request GET /v1/jobs -H 'X-Forwarded-For: 10.0.0.2'
expect_status 200
request POST "/v1/jobs/$waiting/cancel" -H 'X-Forwarded-For: 10.0.0.2'
stop_server

# A Unix socket, with permissions; one that a killed process left is replaced, one in use is not.
listen=unix:$work/socket
start_server --socket-mode 600
[[ $(stat -c %a "$work/socket") == 600 ]] || fail "permissions"
curl -fsS --unix-socket "$work/socket" http://localhost/healthz >/dev/null || fail "the Unix socket"
"$bahnwerk" submit --wait "$examples/line.json" --server "unix:$work/socket" >/dev/null || fail "the command line by the Unix socket"
code=0
"$bahnwerk" serve --listen "unix:$work/socket" --store "sqlite:$work/second.db" 2>"$work/err" || code=$?
[[ $code == 2 ]] && grep -q taken "$work/err" || fail "a socket in use"
stop_server KILL || true
start_server
[[ $(stat -c %a "$work/socket") == 660 ]] || fail "permissions by default"
curl -fsS --unix-socket "$work/socket" http://localhost/healthz >/dev/null || fail "the socket of a killed process"
stop_server || fail "an orderly end"
[[ ! -e $work/socket ]] || fail "the socket goes with the process"
