#!/usr/bin/env bash
# The pages for people: the list, a page per job; every link of them leads somewhere.
source "$(dirname "$0")/lib.sh"
start_server --workers 1
page() {
  request GET "$1" -H 'Accept: text/html,application/xhtml+xml;q=0.9,*/*;q=0.8'
  expect_status 200
  expect_header Content-Type "text/html; charset=utf-8"
  [[ $(header Content-Security-Policy) == "default-src 'none'; img-src 'self'; style-src 'sha256-"* ]] || fail "a strict policy"
  # The one script writes times in local time; the policy names its hash.
  script=$(sed -n 's/.*<script>\(.*\)<\/script>.*/\1/p' "$work/body")
  [[ $(header Content-Security-Policy) == *"; script-src 'sha256-$(printf %s "$script" | openssl dgst -sha256 -binary | base64)';"* ]] ||
    fail "the policy allows another script"
  [[ $(grep -o '<script' "$work/body" | wc -l) == 1 ]] || fail "several scripts in $1"
  grep -qiE 'style=|onload|javascript:' "$work/body" && fail "scripts or styles in $1"
  cp "$work/body" "$work/page"
}
# Every address that the last page names answers, with what a browser would send.
links() {
  local count=0 link
  for link in $(grep -oE '(href|src)="[^"]*"' "$work/page" | cut -d'"' -f2 | sort -u); do
    [[ $link == /* ]] || fail "an outside address: $link"
    request GET "$link" -H 'Accept: text/html,application/xhtml+xml,application/xml;q=0.9,image/avif,*/*;q=0.8'
    expect_status 200
    [[ -s $work/body ]] || fail "$link is empty"
    count=$((count + 1))
  done
  ((count >= $1)) || fail "only $count links"
}
has() { grep -q -- "$1" "$work/page" || fail "the page lacks '$1'"; }
hasnt() { grep -q -- "$1" "$work/page" && fail "the page has '$1'" || true; }

jq '.name = "<script>alert(1)</script>"' "$examples/bracket.json" >"$work/job.json"
post "$work/job.json"
await succeeded
page "/jobs/$id"
has '&lt;script&gt;'
has 'class="state succeeded"'
has 'Verification: passed'
has '<td>acceleration x</td>'
has '<th>path length</th><td>1178.19 mm</td>'
has 'setpoints?format=csv'
has '>verified</strong> · contour · duration <strong>[0-9.]* s</strong> · gap to the bound <strong>'
has '<tr><td>feed</td><td class="k"><meter max="1" value="0.53'
has '<h2>Slowest blocks</h2>'
has '<details><summary>geometry: [0-9]* checks passed, largest use '
has '<th>created</th><td><time datetime="20[^"]*Z">20[^<]* UTC</time>'
hasnt 'http-equiv="refresh"'
links 8

# Lines of a program come with their text, escaped; at most five.
jq -n --slurpfile job "$examples/bracket.json" '$job[0] | .spec.contour = {gcode: "G21 G90\nG0 X10 (<b>)\nG1 X50 F6000\nG1 Y30\nG1 X20\nG1 Y5\nG1 X5\nG0 X0 Y0\n"}' >"$work/program.json"
post "$work/program.json"
await succeeded
page "/jobs/$id"
has '<h2>Slowest lines</h2>'
has '<code>G0 X10 (&lt;b&gt;)</code>'
[[ $(grep -c '</code></td><td class="n k">' "$work/page") == 5 ]] || fail "five lines"

# Every figure of a kind has its unit.
jq '.spec.machine = $machine' --argjson machine "$(jq -c . "$examples/machines/md1.json")" "$examples/bracket.json" >"$work/stages.json"
post "$work/stages.json"
await succeeded 120
page "/jobs/$id"
has '<th>coarse smoothness</th><td>x [0-9.e+]*, y [0-9.e+]* mm²/s³</td>'
has '<th>peak coarse acceleration</th><td>x [0-9.e+]*, y [0-9.e+]* mm/s²</td>'

jq -c '.spec.wires = [0.9] | .spec.algorithms = ["orthocyclic_base", "needle"]' "$examples/stator_slot.json" >"$work/slot.json"
post "$work/slot.json"
await succeeded
page "/jobs/$id"
has 'drawings/needle.svg'
hasnt 'setpoints?' # this kind has none
links 6
request GET "/jobs/$id/drawings/needle.svg"
expect_header Content-Type image/svg+xml
request GET "/jobs/$id/drawings/nothing.svg"
expect_problem not-found 404

# A plan that failed its verification says first which checks failed, and shows what it is all the same.
jq '.spec.coil.turns = 1 | .spec.feed.interpolator = "taylor1"' "$examples/rotor_coil.json" >"$work/scatter.json"
post "$work/scatter.json"
await failed 120
page "/jobs/$id"
has '>not verified</strong> failed: setpoint [^·]* · winding · duration'
has ' % <strong>failed</strong></td>'
[[ $(grep -n 'Verification: failed' "$work/page" | cut -d: -f1) -lt $(grep -n '<h2>Drawings' "$work/page" | cut -d: -f1) ]] || fail "failed checks come first"
has 'drawings/feed.svg'
hasnt 'setpoints?'
links 6

snake 20000 '{"time_budget":0.5}' >"$work/budget.json"
post "$work/budget.json"
await failed
page "/jobs/$id"
has 'The time budget ran out'
has 'larger <code>time_budget</code>'
has 'href="/problems/budget-exhausted"'
hasnt '/result"'
hasnt 'setpoints?'
links 4

snake 20000 >"$work/long.json"
post "$work/long.json"
await running
page "/jobs/$id"
has 'http-equiv="refresh"'
has '<progress max="1" value="'
hasnt '/result"'
links 3
request POST "/v1/jobs/$id/cancel"
await cancelled
page "/jobs/$id"
has 'The job was cancelled'
hasnt 'http-equiv="refresh"'
links 4

page /
has '<td class="n k">3.315 s</td><td class="n k">[0-9.]* s</td><td><time datetime='
for state in succeeded failed cancelled; do has "class=\"state $state\""; done
links 8
request GET /jobs/nobody
expect_problem not-found 404
request GET "/jobs/$id" -H 'Accept: application/json'
expect_problem not-acceptable 406
