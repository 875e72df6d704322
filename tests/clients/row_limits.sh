#!/usr/bin/env bash
# Times, shares and the columns use and limit of plans of every kind equal a count over all rows; views of a job that was stored without them are the same.
source "$(dirname "$0")/lib.sh"
start_server
export PYTHONPATH=$examples/clients/python PYTHONDONTWRITEBYTECODE=1
python3 "$root/tests/clients/row_limits_client.py" count "$url" "$root" "$work" || fail "the counts"

# An answer that the client has is not made again.
mapfile -t ids < <(cut -d' ' -f1 "$work/ids")
id=${ids[0]}
request GET "/v1/jobs/$id/limits?points=7"
expect_status 200
request GET "/v1/jobs/$id/limits?points=7" -H "If-None-Match: $(header ETag)"
expect_status 304
for query in first=-1 points=0 every=2 colour=1 first=1000000000; do
  request GET "/v1/jobs/$id/limits?$query"
  expect_problem schema-violation 422
done
request GET "/v1/jobs/$id/setpoints?columns=use,limit&count=3&format=f32"
expect_equal "$(wc -c <"$work/body")" 24 "bytes of 3 rows of 2 columns"
expect_header X-Columns use,limit

# As a version without views stored them.
for id in "${ids[@]}"; do
  request GET "/v1/jobs/$id/limits?points=50"
  cp "$work/body" "$work/$id.limits"
  request GET "/v1/jobs/$id/setpoints?points=50"
  cp "$work/body" "$work/$id.envelope"
done
stop_server TERM || fail "the server ends"
python3 -c 'import sqlite3, sys
store = sqlite3.connect(sys.argv[1])
store.execute("DELETE FROM views")
store.execute("UPDATE results SET views = 0")
store.commit()' "$work/store.db"
start_server
for id in "${ids[@]}"; do
  request GET "/v1/jobs/$id/limits?points=50"
  cmp "$work/body" "$work/$id.limits" || fail "limits of a job stored without views"
  request GET "/v1/jobs/$id/setpoints?points=50"
  cmp "$work/body" "$work/$id.envelope" || fail "envelope of a job stored without views"
done
request DELETE "/v1/jobs/$id"
expect_status 204
request GET "/v1/jobs/$id/limits"
expect_problem not-found 404
