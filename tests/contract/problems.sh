#!/usr/bin/env bash
# Every problem that a client can meet, provoked once; and every slug has a page.
source "$(dirname "$0")/lib.sh"
start_server --workers 0 --max-queued 2 --max-body 1MiB

echo '{"kind":"contour",' >"$work/bad.json"
post "$work/bad.json"
expect_problem invalid-json 400
jq '.spec.contour = 7' "$examples/line.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem schema-violation 422
expect_json '.errors | length > 0 and all(.pointer | startswith("/spec"))'
jq '.spec.contour = {"points": [[1, 1], [1, 1]]}' "$examples/line.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem semantic-violation 422
expect_json '.errors | length > 0 and all((.pointer | startswith("/spec/contour")) and (.message | length > 0))'
jq '.kind = "teleport"' "$examples/line.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem unknown-kind 422

# The detail names the first place and how many follow.
jq '.callback = {url: "/done", secret: "s"} | .tags = ["two words"]' "$examples/line.json" >"$work/bad.json"
post "$work/bad.json"
expect_problem schema-violation 422
expect_json '(.detail | test("^/callback/url: .* \\(and 1 more\\)$")) and .errors[1].pointer == "/tags/0"'

# Packed bodies: gzip as any other, anything else is refused, a bomb is cut at the limit of a body.
gzip -c "$examples/line.json" >"$work/line.gz"
request POST /v1/jobs -H 'Content-Type: application/json' -H 'Content-Encoding: br' --data-binary "@$work/line.gz"
expect_problem unsupported-media-type 415
expect_header Accept-Encoding "gzip, identity"
request POST /v1/jobs -H 'Content-Type: application/json' -H 'Content-Encoding: gzip' --data-binary "@$examples/line.json"
expect_problem bad-request 400
head -c 300000000 /dev/zero | gzip -c >"$work/bomb.gz"
request POST /v1/jobs -H 'Content-Type: application/json' -H 'Content-Encoding: gzip' --data-binary "@$work/bomb.gz"
expect_problem payload-too-large 413
request POST /v1/jobs -H 'Content-Type: application/json' -H 'Content-Encoding: gzip' --data-binary "@$work/line.gz"
expect_status 202
packed=$(field .id)
request GET "/v1/jobs/$packed/spec"
cmp "$work/body" "$examples/line.json" || fail "the document as posted, unpacked"
request DELETE "/v1/jobs/$packed"
expect_status 204

# Parameters of the query: unknown, empty and repeated ones are refused, whatever the address.
for path in '/v1/jobs?state=' '/v1/jobs?limit=1&limit=1' '/v1/jobs/x?a=1' '/v1/jobs/x/result?a=' '/v1/kinds?x=1' '/?page=2' '/v1/jobs/x/setpoints?first='; do
  request GET "$path"
  expect_problem schema-violation 422
  expect_json '.errors | length == 1 and (.[0].pointer | startswith("/query/"))'
done

request GET /nothing/here
expect_problem not-found 404
request GET /v1/jobs/01890000-0000-7000-8000-000000000000
expect_problem not-found 404
request GET "/v1/jobs/%2e%2e%2fsecret"
expect_problem not-found 404
request DELETE /v1/kinds
expect_problem method-not-allowed 405
expect_header Allow "GET, HEAD, OPTIONS"
request PUT /v1/jobs
expect_problem method-not-allowed 405
expect_header Allow "DELETE, GET, HEAD, POST, OPTIONS"
request GET /v1/jobs -H 'Accept: application/pdf'
expect_problem not-acceptable 406
request POST /v1/jobs -H 'Content-Type: text/plain' --data-binary "@$examples/line.json"
expect_problem unsupported-media-type 415
request POST /v1/jobs -H 'Content-Type: application/json; charset=latin1' --data-binary "@$examples/line.json"
expect_problem unsupported-media-type 415
head -c 1100000 /dev/zero | tr '\0' ' ' >"$work/big"
request POST /v1/jobs -H 'Content-Type: application/json' -H 'Expect:' --data-binary "@$work/big"
expect_status 413
expect_json '.type == "/problems/payload-too-large"'

post "$examples/line.json" -H 'Idempotency-Key: key-1'
expect_status 202
request POST /v1/jobs -H 'Content-Type: application/json; charset=UTF-8' -H 'Idempotency-Key: key-1' --data-binary "@$examples/circle.json"
expect_problem idempotency-conflict 409
request GET "/v1/jobs/$id/result"
expect_problem job-not-finished 409
request GET "/v1/jobs/$id/setpoints"
expect_problem job-not-finished 409
request GET "/v1/jobs/$id/setpoints?first=minus"
expect_problem schema-violation 422
request GET "/v1/jobs/$id/setpoints" -H 'Accept: image/png'
expect_problem not-acceptable 406

post "$examples/line.json"
expect_status 202
post "$examples/line.json"
expect_problem too-many-jobs 429
[[ $(header Retry-After) =~ ^[0-9]+$ ]] || fail "429 says when to come again"

# Every slug has a page, for people and for programs.
request GET /openapi.json
expect_status 200
for slug in $(jq -r '.components.parameters.slug.schema.enum[]' "$work/body"); do
  request GET "/problems/$slug" -H 'Accept: application/json'
  expect_status 200
  expect_json '.type == "/problems/" + $slug and (.title | length > 0) and (.advice | length > 0)' --arg slug "$slug"
  request GET "/problems/$slug" -H 'Accept: text/html,application/xhtml+xml;q=0.9,*/*;q=0.8'
  expect_status 200
  expect_header Content-Type "text/html; charset=utf-8"
  [[ $(header Content-Security-Policy) == "default-src 'none';"* ]] || fail "pages carry a strict policy"
done
request GET /problems/no-such-slug
expect_problem not-found 404
