#!/usr/bin/env bash
# Corners of HTTP: framing that two sides could read differently, forms of the target, conditions, packed answers.
source "$(dirname "$0")/lib.sh"
start_server --workers 0 --max-body 100000 --idle-timeout 100

# raw: sends stdin as it is, prints what comes back until the server closes.
raw() {
  exec 3<>"/dev/tcp/$host/$port"
  cat >&3
  timeout 60 cat <&3 || true
  exec 3>&- 3<&-
}
statuses() { raw | grep -aoE 'HTTP/1.[01] [0-9]{3}' | cut -d' ' -f2 | tr '\n' ' '; }
# gets STATUSES REQUEST: the answers on one connection.
gets() { expect_equal "$(printf "$2" | statuses)" "$1 " "for $(head -c 70 <<<"$2")"; }

job=$(jq -c . "$examples/line.json")
size=${#job}
post_head="POST /v1/jobs HTTP/1.0\r\nHost: localhost\r\nContent-Type: application/json\r\n"
# The end of an HTTP/1.0 message with a transfer coding is not sure: nothing behind it is a request.
gets 400 "${post_head}Connection: keep-alive\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\nGET /v1/kinds HTTP/1.1\r\nHost: localhost\r\n\r\n"
gets 202 "${post_head}Expect: 100-continue\r\nContent-Length: $size\r\n\r\n$job"
# The framing of a body counts as its bytes do.
extension=$(head -c 60000 /dev/zero | tr '\0' e)
gets 413 "POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n1;$extension\r\n{\r\n1;$extension\r\n}\r\n0\r\n\r\n"
# Blank lines before a request, as some clients send them behind a body.
gets "200 200" "\r\nGET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n\r\n\r\nGET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
gets 400 "$(printf '\\r\\n%.0s' {1..20})GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
# Targets.
last="Host: localhost\r\nConnection: close\r\n\r\n"
gets 204 "OPTIONS * HTTP/1.1\r\n$last"
gets 400 "GET * HTTP/1.1\r\n$last"
gets 200 "GET http://localhost:$port/healthz HTTP/1.1\r\n$last"
gets 200 "GET HTTP://localhost HTTP/1.1\r\nAccept: text/html\r\n$last"
gets 400 "GET http://user@localhost/healthz HTTP/1.1\r\n$last"
gets 403 "GET http://evil.example/healthz HTTP/1.1\r\n$last"
# Hosts.
for name in 'a b@c/..' '' 'x:y' 'user@localhost'; do gets 400 "GET /healthz HTTP/1.1\r\nHost: $name\r\n\r\n"; done
for name in localhost LOCALHOST:99 127.0.0.1 127.1.2.3:80 '[::1]:80'; do
  gets 200 "GET /healthz HTTP/1.1\r\nHost: $name\r\nConnection: close\r\n\r\n"
done

# A page of another site, whose name may be bound to this address, reaches nothing.
request GET /v1/kinds -H 'Host: evil.example'
expect_problem forbidden 403
json=(-H 'Content-Type: application/json' --data-binary "@$examples/line.json")
for origin in http://evil.example null http://127.0.0.1:1; do
  request POST /v1/jobs "${json[@]}" -H "Origin: $origin"
  expect_problem forbidden 403
done
request POST /v1/jobs "${json[@]}" -H "Origin: http://$address"
expect_status 202
id=$(field .id)
request GET /v1/jobs -H 'Origin: http://evil.example'
expect_status 200

# Conditions of requests that change something.
request GET "/v1/jobs/$id"
tag=$(header ETag)
for method in "DELETE /v1/jobs/$id" "POST /v1/jobs/$id/cancel"; do
  for condition in 'If-Match: "999"' "If-Match: W/$tag" "If-None-Match: $tag" 'If-None-Match: *'; do
    request $method -H "$condition"
    expect_problem precondition-failed 412
  done
done
request GET "/v1/jobs/$id" -H "If-None-Match: $tag"
expect_status 304
request DELETE "/v1/jobs/$id" -H "If-Match: \"999\", $tag"
expect_status 204
request DELETE "/v1/jobs/$id" -H 'If-Match: *'
expect_problem not-found 404

# Keys.
request POST /v1/jobs "${json[@]}" -H 'Idempotency-Key;'
expect_problem bad-request 400
request POST /v1/jobs "${json[@]}" -H 'Idempotency-Key: a' -H 'Idempotency-Key: a'
expect_problem bad-request 400

# Bytes behind a document, a NUL among them.
for rest in '\0' '\0garbage {{{' '\0\0' ' x'; do
  { cat "$examples/line.json" && printf "$rest"; } >"$work/rest.json"
  post "$work/rest.json"
  expect_problem invalid-json 400
done

# What a client sends is not sent back at length.
long=$(head -c 20000 /dev/zero | tr '\0' n)
for target in "/v1/jobs/$long" "/v1/schemas/$long" "/problems/$long" "/$long" "/v1/jobs?$long=1"; do
  request GET "$target"
  (($(wc -c <"$work/body") < 2000)) || fail "a long answer for ${target:0:20}"
done
jq -c --arg n "$long" '.[$n] = 1 | .spec[$n] = 1' "$examples/line.json" >"$work/long.json"
post "$work/long.json"
expect_problem schema-violation 422
(($(wc -c <"$work/body") < 5000)) || fail "a long answer for a long name"

# Answers are packed for those who accept it, and a packed answer has a tag of its own.
request GET /openapi.json
expect_equal "$(header Vary)$(header Content-Encoding)" Accept-Encoding
cp "$work/body" "$work/plain"
request GET /openapi.json -H 'Accept-Encoding: br, gzip;q=0.5'
expect_header Content-Encoding gzip
gzip -dc "$work/body" | cmp - "$work/plain" || fail "the packed answer is another one"
for refused in 'gzip;q=0' identity 'br' '*;q=0'; do
  request GET /openapi.json -H "Accept-Encoding: $refused"
  expect_equal "$(header Content-Encoding)" "" "for $refused"
done
request HEAD /openapi.json -H 'Accept-Encoding: gzip'
expect_header Content-Encoding gzip
jq '.name = ("a name of some length, " * 60)[:190]' "$examples/bracket.json" >"$work/named.json"
stop_server || fail "orderly end"
start_server --workers 1
post "$examples/bracket.json"
await succeeded
for target in result spec setpoints; do
  accept='Accept: application/json'
  [[ $target != setpoints ]] || accept='Accept: text/csv'
  request GET "/v1/jobs/$id/$target" -H "$accept"
  cp "$work/body" "$work/plain"
  tag=$(header ETag)
  request GET "/v1/jobs/$id/$target" -H "$accept" -H 'Accept-Encoding: gzip'
  expect_header Content-Encoding gzip
  packed=$(header ETag)
  expect_equal "$packed" "${tag%\"}-gzip\""
  gzip -dc "$work/body" | cmp - "$work/plain" || fail "the packed $target is another one"
  for known in "$packed" "$tag"; do
    request GET "/v1/jobs/$id/$target" -H "$accept" -H 'Accept-Encoding: gzip' -H "If-None-Match: $known"
    expect_status 304
    expect_header ETag "$known"
  done
done
