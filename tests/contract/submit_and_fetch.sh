#!/usr/bin/env bash
# The whole way: post a contour, watch it, read its result and its setpoints; the same with the terminal client.
source "$(dirname "$0")/lib.sh"
start_server

post "$examples/bracket.json" -H 'X-Request-Id: contract-1'
expect_status 202
expect_header X-Request-Id contract-1
expect_header Location "/v1/jobs/$id"
expect_json '.id | test("^[0-9a-f]{8}-[0-9a-f]{4}-7[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}$")'
expect_json '.kind == "contour" and .error == null and .deadline == null and .callback == null
  and (.state == "queued" or .state == "running" or .state == "succeeded") and has("planned_by")
  and (.created_at | test("^[0-9-]{10}T[0-9:]{8}\\.[0-9]{3}Z$")) and (.links.self == "/v1/jobs/" + .id)'
expect_json '(has("spec") | not) and .name == $document[0].name' --slurpfile document "$examples/bracket.json"
request GET "/v1/jobs/$id/spec"
expect_header Content-Type application/json
cmp "$work/body" "$examples/bracket.json" || fail "the document as posted"

await succeeded
expect_json '.progress.fraction == 1 and .attempt == 1 and .started_at >= .created_at and .finished_at >= .started_at'
expect_json '.planned_by == $version' --arg version "$("$bahnwerk" --version | cut -d' ' -f2)"

request GET "/v1/jobs/$id/result"
expect_status 200
expect_header Content-Type application/json
expect_json '.kind == "contour" and .summary.duration > 0 and .verification.passed and .bound.gap >= 0 and .bound.duration > 0'
expect_json '[.verification.checks[] | select(.passed | not)] == []'
expect_json '.setpoints.count == (.setpoints.duration / .setpoints.cycle_time | round) + 1'
rows=$(field .setpoints.count)
columns=$(field '[.setpoints.columns[].name] | join(",")')

# All four forms of the setpoints say the same.
request GET "/v1/jobs/$id/setpoints" -H 'Accept: text/csv'
expect_status 200
expect_header X-Columns "$columns"
expect_equal "$(head -n 1 "$work/body" | tr -d '\r')" "$columns"
expect_equal "$(wc -l <"$work/body")" $((rows + 1)) "lines of CSV"
cp "$work/body" "$work/setpoints.csv"
request GET "/v1/jobs/$id/setpoints" -H 'Accept: application/octet-stream'
expect_header X-Columns "$columns"
expect_equal "$(wc -c <"$work/body")" $((rows * 8 * $(tr , '\n' <<<"$columns" | wc -l))) "bytes"
request GET "/v1/jobs/$id/setpoints" -H 'Accept: application/x-ndjson'
expect_equal "$(wc -l <"$work/body")" "$rows" "lines of NDJSON"
request GET "/v1/jobs/$id/setpoints"
expect_header Content-Type application/json
jq -e . "$work/body" >/dev/null || fail "the default form is JSON"

# The same document planned offline gives the same, bit for bit.
"$bahnwerk" plan "$examples/bracket.json" --out "$work/offline" >"$work/printed.json"
cmp "$work/offline/setpoints.csv" "$work/setpoints.csv" || fail "offline and served setpoints differ"
request GET "/v1/jobs/$id/result"
expect_equal "$(jq -S . "$work/offline/result.json")" "$(jq -S . "$work/body")" "result document"
expect_equal "$(jq -S . "$work/printed.json")" "$(jq -S . "$work/body")" "printed document"

# The terminal client.
"$bahnwerk" submit "$examples/line.json" --server "$url" --wait >"$work/line.json"
jq -e '.verification.passed' "$work/line.json" >/dev/null || fail "submit --wait prints the result"
"$bahnwerk" submit - --server "$url" <"$examples/line.json" >"$work/job.json"
id=$(jq -r .id "$work/job.json")
"$bahnwerk" watch "$id" --server "$url" | jq -e '.state == "succeeded"' >/dev/null || fail "watch prints the final job"
"$bahnwerk" fetch "$id" --server "$url" --format csv >"$work/fetched.csv"
"$bahnwerk" plan "$examples/line.json" --out "$work/line" >/dev/null
cmp "$work/line/setpoints.csv" "$work/fetched.csv" || fail "fetch gives the setpoints"
"$bahnwerk" fetch "$id" --server "$url" --format f64 >"$work/fetched.f64"
request GET "/v1/jobs/$id/setpoints" -H 'Accept: application/octet-stream'
cmp "$work/body" "$work/fetched.f64" || fail "fetch --format f64"

stop_server TERM || fail "an orderly end exits 0"
code=0
"$bahnwerk" watch "$id" --server "$url" 2>"$work/message" || code=$?
expect_equal $code 3 "exit code without a server"
grep -q "no answer from $url" "$work/message" || fail "a clear sentence when no server is there"
