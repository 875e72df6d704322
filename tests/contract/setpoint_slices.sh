#!/usr/bin/env bash
# A contour of many segments (fewer where a sanitizer makes everything slow): its setpoints in slices equal the CSV that `bahnwerk plan` writes.
source "$(dirname "$0")/lib.sh"
start_server
segments=3000
((${SLOWER:-1} == 1)) || segments=800
snake $segments >"$work/job.json"
post "$work/job.json"
expect_status 202
await succeeded 600
request GET "/v1/jobs/$id/result"
rows=$(field .setpoints.count)
((rows > 8192)) || fail "the series is too short to cross chunks"

"$bahnwerk" plan "$work/job.json" --out "$work/offline" >/dev/null
offline=$work/offline/setpoints.csv
expect_equal "$(wc -l <"$offline")" $((rows + 1)) "rows of the offline CSV"

# In slices of an odd length, glued together.
head -n 1 "$offline" >"$work/glued.csv"
for ((first = 0; first < rows; first += 10007)); do
  request GET "/v1/jobs/$id/setpoints?first=$first&count=10007" -H 'Accept: text/csv'
  expect_status 200
  expect_equal "$(head -n 1 "$work/body")" "$(head -n 1 "$offline")" "header line"
  tail -n +2 "$work/body" >>"$work/glued.csv"
done
cmp "$offline" "$work/glued.csv" || fail "slices differ from the offline CSV"

# Across a chunk's border, every third row, two columns.
request GET "/v1/jobs/$id/setpoints?first=4090&count=20&every=3&columns=y,x" -H 'Accept: text/csv'
expect_status 200
expect_header X-Columns y,x
names=$(head -n 1 "$offline")
column() { tr , '\n' <<<"$names" | grep -nx "$1" | cut -d: -f1; }
awk -F, -v x="$(column x)" -v y="$(column y)" \
  'NR == 1 { print "y,x" } NR >= 4092 && NR < 4112 && (NR - 4092) % 3 == 0 { print $y "," $x }' "$offline" >"$work/expected.csv"
cmp "$work/expected.csv" "$work/body" || fail "a thinned slice of two columns"

# The binary form holds the same doubles.
request GET "/v1/jobs/$id/setpoints?first=100&count=50&columns=x" -H 'Accept: application/octet-stream'
expect_equal "$(wc -c <"$work/body")" 400
od -A n -t f8 -w8 -v "$work/body" | awk '{ printf "%.12g\n", $1 }' >"$work/binary"
awk -F, -v x="$(column x)" 'NR >= 102 && NR < 152 { printf "%.12g\n", $x }' "$offline" >"$work/expected"
cmp "$work/expected" "$work/binary" || fail "float64 values"

# The envelope for charts is short.
request GET "/v1/jobs/$id/setpoints?points=500&columns=x" -H 'Accept: text/csv'
expect_status 200
lines=$(wc -l <"$work/body")
((lines > 100 && lines < 2100)) || fail "an envelope of 500 points has $lines lines"

request GET "/v1/jobs/$id/setpoints?first=$((rows - 1))" -H 'Accept: application/x-ndjson'
expect_equal "$(wc -l <"$work/body")" 1 "the last row"
for query in first=-1 every=0 count=x columns=nonsense points=0 colour=1 first= points= columns= format= format=xml 'first=1&first=2' "first=$((rows + 1))" 'points=5&every=2'; do
  request GET "/v1/jobs/$id/setpoints?$query"
  expect_problem schema-violation 422
done
# A link in a page cannot carry a header: the form in the query, and a name for the file.
for format in csv ndjson f64 json; do
  request GET "/v1/jobs/$id/setpoints?format=$format&count=3" -H 'Accept: text/html,*/*;q=0.8'
  expect_status 200
  expect_header Content-Disposition "attachment; filename=\"$id.$format\""
done
request HEAD "/v1/jobs/$id/setpoints"
expect_status 200
[[ -n $(header X-Columns) ]] || fail "HEAD carries the columns"
