#!/usr/bin/env bash
# Keys: who may do what, made and removed beside the server.
source "$(dirname "$0")/lib.sh"
key() { "$bahnwerk" key "$@" --store "sqlite:$work/store.db" 2>>"$work/cli"; }
# as KEY METHOD PATH [curl's arguments…]
as() { local key=$1; shift; request "$@" -H "Authorization: Bearer $key"; }

start_server
request GET /v1/jobs
expect_status 200
post "$examples/line.json"
expect_status 202
before=$id

# The first key, added beside the server, closes it for everyone else.
acme=$(key add acme --scope submit,read --max-queued 50)
[[ $acme =~ ^bw_[0-9a-f]{8}_[0-9a-f]{64}$ ]] || fail "the key is printed, alone"
closed() { request GET /v1/jobs && [[ $status == 401 ]]; }
soon closed || fail "the key takes effect"
expect_problem unauthorized 401
expect_header WWW-Authenticate 'Bearer realm="bahnwerk"'
request GET /problems/unauthorized -H 'Accept: application/json'
expect_status 200
for open in /healthz /readyz /metrics; do
  request GET $open
  expect_status 200
done
request GET /metrics -H 'X-Forwarded-For: 1.2.3.4'
expect_problem unauthorized 401
other=$(key add other --scope submit,read) admin=$(key add boss --scope admin) reader=$(key add acme --scope read)
known() { as "$reader" GET /v1/jobs && [[ $status == 200 ]]; }
soon known || fail "further keys take effect"

# What was posted without a key belongs to nobody: administrators alone see it.
as "$acme" GET "/v1/jobs/$before"
expect_problem not-found 404
as "$admin" GET "/v1/jobs/$before"
expect_status 200

post "$examples/line.json" -H "Authorization: Bearer $acme"
expect_status 202
for part in "" /spec /events /result /setpoints; do
  as "$other" GET "/v1/jobs/$id$part" -H 'Accept: */*'
  expect_problem not-found 404
done
ended() { as "$reader" GET "/v1/jobs/$id" && [[ $(field .state) == succeeded ]]; }
soon ended || fail "another key of the same name sees the job"
as "$reader" DELETE "/v1/jobs/$id"
expect_problem forbidden 403
as "$other" DELETE "/v1/jobs/$id"
expect_problem not-found 404
as "$admin" GET /v1/jobs
expect_json '.jobs | length == 2'
as "$acme" GET /v1/jobs
expect_json '.jobs | length == 1'
request GET /v1/jobs -H "Authorization: Bearer ${acme}0"
expect_problem unauthorized 401
expect_header WWW-Authenticate 'Bearer realm="bahnwerk", error="invalid_token"'
as "$acme" DELETE "/v1/jobs/$id"
expect_status 204
deleted=$id

# Every change leaves a line that says who made it.
logged '.event == "audit" and .key == "acme" and .peer == "127.0.0.1" and .action == "DELETE /v1/jobs/{id}" and .job == $id and .status == 204' \
  --arg id "$deleted" || fail "the audit line of the removal"
logged '.event == "audit" and .action == "POST /v1/jobs" and .job == $id' --arg id "$deleted" || fail "the audit line of the post"
logged '.event == "audit" and .status == 403 and .key == "acme"' || fail "the audit line of a refused change"

# In a browser a form exchanges the key for a cookie, which serves the pages of this service: their changes have its Origin.
html='Accept: text/html,application/xhtml+xml,*/*;q=0.8'
for address in / /new /v1/jobs "/v1/jobs/$before/result"; do
  request GET "$address" -H "$html"
  expect_status 401
  grep -q "<form class=\"login\" method=\"post\" action=\"/login\">" "$work/body" || fail "the form at $address"
done
request GET / -H "$html" -H 'Accept-Language: de'
grep -q 'Anmelden' "$work/body" || fail "the form in German"
request POST /login -H "$html" --data-urlencode "key=bw_wrong" --data-urlencode 'to=/'
expect_status 401
grep -q 'role="alert"' "$work/body" || fail "a wrong key is told"
request POST /login --data-urlencode "key=$acme" --data-urlencode 'to=/?state=failed'
expect_status 303
expect_header Location '/?state=failed'
[[ $(header Set-Cookie) == "bahnwerk_key=$acme; Path=/; HttpOnly; SameSite=Strict" ]] || fail "the cookie"
cookie="Cookie: bahnwerk_key=$acme"
request GET / -H "$html" -H "$cookie"
expect_status 200
grep -q 'action="/logout"' "$work/body" || fail "a way out"
posts() { request POST /v1/jobs -H 'Content-Type: application/json' --data-binary "@$examples/line.json" -H "$cookie" "$@"; }
posts
expect_problem unauthorized 401
posts -H 'Origin: http://evil.example'
expect_problem forbidden 403
posts -H 'Origin: null'
expect_problem forbidden 403
posts -H "Origin: $url"
expect_status 202
request DELETE "/v1/jobs/$(field .id)" -H "$cookie" -H 'Sec-Fetch-Site: cross-site'
expect_problem unauthorized 401
request POST /v1/jobs -H 'Content-Type: application/json' --data-binary "@$examples/line.json" -H "Cookie: bahnwerk_key=$reader" -H "Origin: $url"
expect_problem forbidden 403
request GET "/v1/jobs/$before" -H "$html" -H "$cookie"
expect_status 404
grep -q 'What to do' "$work/body" || fail "another's job is a page, too"
request POST /logout -H "$cookie" -H "Origin: $url"
expect_status 303
[[ $(header Set-Cookie) == 'bahnwerk_key=; Path=/; HttpOnly; SameSite=Strict; Max-Age=0' ]] || fail "the cookie is removed"

# A removed key is not valid any more; without any key left the service stays closed.
key list | jq -e '.keys | length == 4' >/dev/null || fail "key list"
grep -q "$acme" "$work/store.db" "$work/log" <(key list) && fail "the key's text is nowhere"
for name in acme other boss; do key remove $name >/dev/null; done
gone() { as "$acme" GET /v1/jobs && [[ $status == 401 ]]; }
soon gone || fail "the removal takes effect"
stop_server
start_server
request GET /v1/jobs
expect_problem unauthorized 401
key remove acme && fail "there is none to remove"
key add 'a b' && fail "a name without blanks"
key add c --scope everything && fail "a scope that is none"
true
