#!/usr/bin/env bash
# Callbacks: a receiver that fails and then accepts, signatures, what survives a kill, a receiver that holds up nobody, and what nobody sees.
source "$(dirname "$0")/lib.sh"

# A receiver: GET /status=N sets what it answers, /hang never answers; each call is a line of JSON with path, signature and body.
cat >"$work/receiver.py" <<'PY'
import http.server, json, socketserver, sys, threading, time
status = [500]
class Handler(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        status[0] = int(self.path.split("=")[1])
        self.send_response(200); self.end_headers()
    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"])).decode()
        with lock, open(sys.argv[2], "a") as file:
            file.write(json.dumps({"path": self.path, "type": self.headers["Content-Type"], "status": status[0],
                                   "signature": self.headers["Bahnwerk-Signature"], "body": body}) + "\n")
        if self.path.startswith("/hang"): time.sleep(3600)
        self.send_response(status[0])
        if status[0] == 302: self.send_header("Location", "/elsewhere")
        self.end_headers()
    def log_message(self, *_): pass
lock = threading.Lock()
class Server(socketserver.ThreadingMixIn, http.server.HTTPServer): daemon_threads = True
Server(("127.0.0.1", int(sys.argv[1])), Handler).serve_forever()
PY
free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }
receiver_port=$(free_port) receivers=()
trap 'kill "${receivers[@]}" 2>/dev/null || true; stop_server TERM >/dev/null 2>&1 || true; rm -rf "$work"' EXIT
# start_receiver PORT: its calls are lines of calls.PORT.
start_receiver() {
  touch "$work/calls.$1"
  python3 "$work/receiver.py" "$1" "$work/calls.$1" &
  receivers+=($!)
  soon curl -sS -o "$work/none" "http://127.0.0.1:$1/status=500" 2>"$work/none" || fail "the receiver runs"
}
answer() { curl -sS "http://127.0.0.1:$receiver_port/status=$1"; }
calls="$work/calls.$receiver_port"
# calls_of ID [FILTER]: number of calls for this job.
calls_of() { jq -c --arg id "$1" "select((.body | fromjson).id == \$id and (${2:-true}))" "$calls" | wc -l; }
# called ID [FILTER]: whether there is one.
called() { [[ $(calls_of "$@") -gt 0 ]]; }
# with_callback PATH [PORT]: line.json with a callback.
with_callback() {
  jq -c --arg url "http://127.0.0.1:${2:-$receiver_port}$1" '.callback = {url: $url, secret: "hush hush"}' "$examples/line.json" >"$work/job.json"
}
# delivered ID: whether the job says so.
delivered() { request GET "/v1/jobs/$1" && jq -e '.callback.delivered_at != null' "$work/body" >"$work/none"; }

# Without allowed hosts, and for another host, a callback is refused in words that say what to do.
start_server --workers 1
with_callback /done
post "$work/job.json"
expect_problem semantic-violation 422
expect_json '.errors[0].pointer == "/callback/url" and (.detail | test("--callback-host"))'
stop_server
start_server --workers 1 --callback-host 127.0.0.1 --callback-host '*.example.com'
for place in http://localhost:9/x http://example.com/ http://127.0.0.2/ 'http://0x7f000001/'; do
  jq -c --arg url "$place" '.callback = {url: $url, secret: "s"}' "$examples/line.json" >"$work/other.json"
  post "$work/other.json"
  expect_problem semantic-violation 422
  expect_json '.errors[0].pointer == "/callback/url"'
done
jq -c '.callback.secret = null' "$work/job.json" >"$work/other.json"
post "$work/other.json"
expect_json '.errors[0].pointer == "/callback/secret"'

# A receiver that fails, redirects, then accepts; meanwhile the server is restarted.
start_receiver "$receiver_port"
post "$work/job.json" -H "Prefer: wait=60"
expect_status 202
first=$id
expect_json '.state == "succeeded" and .callback.url == $url and (.callback | has("secret") | not)' --arg url "http://127.0.0.1:$receiver_port/done"
soon called "$first" || fail "the receiver is called"
failed_once() { request GET "/v1/jobs/$first" && jq -e '.callback | .attempts >= 1 and .error == "answered 500" and .delivered_at == null and .next_at != null' "$work/body" >"$work/none"; }
soon failed_once || fail "the job says why its callback failed"
answer 302
soon called "$first" '.status == 302' || fail "it is called again"
[[ $(jq -r .path "$calls" | sort -u) == /done ]] || fail "a redirect is not followed"
stop_server TERM || fail "the server ends while a callback waits"
answer 204
start_server --workers 1 --callback-host 127.0.0.1
soon delivered "$first" || fail "delivered after the restart"
expect_json '.callback | .error == null and .next_at == null and .attempts >= 3'
tag=$(header ETag)
request GET "/v1/jobs/$first" -H "If-None-Match: $tag"
expect_status 304

# The body is the job resource; the signature is of it and of the time, with the secret.
jq -c --arg id "$first" 'select((.body | fromjson).id == $id and .status == 204)' "$calls" | tail -n 1 >"$work/call"
jq -e '.type == "application/json" and (.body | fromjson | .state == "succeeded" and .kind == "contour" and (.links.result | endswith("/result")))' "$work/call" >"$work/none" || fail "the body"
t=$(jq -r .signature "$work/call" | sed 's/^t=\([0-9]*\),v1=.*/\1/')
signed=$({ printf '%s.' "$t"; jq -rj .body "$work/call"; } | openssl dgst -sha256 -hmac 'hush hush' -r | cut -d' ' -f1)
expect_equal "$(jq -r .signature "$work/call")" "t=$t,v1=$signed" "the signature"
(($(date +%s) - t < 600)) || fail "the time"

# Killed between the final state and the delivery.
receiver=${receivers[0]}
kill "$receiver"
wait "$receiver" 2>/dev/null || true
post "$work/job.json" -H "Prefer: wait=60"
expect_json '.state == "succeeded"'
second=$id
post "$work/job.json" -H "Idempotency-Key: x"
stop_server KILL || true
start_receiver "$receiver_port"
answer 200
start_server --workers 1 --callback-host 127.0.0.1
soon delivered "$second" || fail "a kill loses no callback"

# Cancelled jobs call, too, alone and in bulk; a removed one does not.
stop_server
start_server --workers 0 --callback-host 127.0.0.1
post "$work/job.json"
third=$id
request POST "/v1/jobs/$third/cancel"
soon called "$third" '(.body | fromjson).state == "cancelled"' || fail "a cancelled job calls"
post "$work/job.json"
fourth=$id
request POST "/v1/jobs/cancel?state=queued"
soon called "$fourth" '(.body | fromjson).state == "cancelled"' || fail "bulk cancel calls"
with_callback /done "$(free_port)"
post "$work/job.json"
request POST "/v1/jobs/$id/cancel"
request DELETE "/v1/jobs/$id"
expect_status 204
pending() { curl -sS "$url/metrics" | grep "^bahnwerk_callbacks_pending $1\$" >/dev/null; }
soon pending 0 || fail "a removed job's callback is withdrawn"

# A retried job calls with the secret of the first one, and a receiver that hangs holds up nobody.
with_callback /hang/a
for _ in 1 2 3 4 5 6 7 8 9 10 11 12; do
  post "$work/job.json"
  request POST "/v1/jobs/$id/cancel"
done
other_port=$(free_port)
start_receiver "$other_port"
curl -sS "http://127.0.0.1:$other_port/status=200"
calls="$work/calls.$other_port"
with_callback /quick "$other_port"
post "$work/job.json"
quick=$id
request POST "/v1/jobs/$quick/cancel"
soon delivered "$quick" || fail "a slow receiver holds up nobody"
request POST "/v1/jobs/$quick/retry"
expect_status 202
retried=$(field .id)
expect_json '.callback.url != null'
request POST "/v1/jobs/$retried/cancel"
soon delivered "$retried" || fail "a retried job calls"
grep -q '"signature": "t=' "$calls" || fail "signed"

# Nobody sees a secret; who was called how often is in the log and in the metrics.
request GET "/v1/jobs/$first/spec"
expect_json '.callback == {url: .callback.url, secret: null} and .kind == "contour"'
for path in "/v1/jobs/$first" "/v1/jobs" "/v1/jobs/$first/result" /metrics; do
  request GET "$path"
  ! grep -q "hush" "$work/body" || fail "the secret is in $path"
done
! grep -q "hush" "$work/log" || fail "the secret is in the log"
logged '.event == "audit" and .action == "callback" and .job == $id and .outcome == "delivered" and .status == 200' --arg id "$quick" || fail "an audit line"
curl -sS "$url/metrics" | grep '^bahnwerk_callback_attempts_total{outcome="delivered"} [1-9]' >/dev/null || fail "the metrics"
begin=$SECONDS
stop_server TERM || fail "the server ends while a receiver hangs"
((SECONDS - begin < 10 * ${SLOWER:-1} + 5)) || fail "it ends soon"
