#!/usr/bin/env bash
# The pages for people: the list, a page per job; every link of them leads somewhere.
source "$(dirname "$0")/lib.sh"
start_server --workers 1
browser='Accept: text/html,application/xhtml+xml,application/xml;q=0.9,image/avif,*/*;q=0.8'
policy="default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; form-action 'self'; frame-ancestors 'none'; base-uri 'none'; require-trusted-types-for 'script'"
# page ADDRESS [STATUS [curl's arguments…]]: the page is in $work/page. It keeps to the policy, and has one module.
page() {
  local address=$1 expected=${2:-200}
  shift $(($# < 2 ? $# : 2))
  request GET "$address" -H "$browser" "$@"
  expect_status "$expected"
  expect_header Content-Type "text/html; charset=utf-8"
  expect_header Content-Security-Policy "$policy"
  expect_header X-Content-Type-Options nosniff
  [[ $(grep -o '<script' "$work/body" | wc -l) == 1 ]] || fail "several scripts in $address"
  grep -qE '<script type="module" src="/assets/[0-9a-f]{16}/[a-z]+\.js"></script>' "$work/body" || fail "no module in $address"
  grep -qiE ' style=|onload|javascript:|<style' "$work/body" && fail "scripts or styles in $address"
  cp "$work/body" "$work/page"
}
# unchanged ADDRESS: who has the page gets no body.
unchanged() {
  request GET "$1" -H "$browser"
  request GET "$1" -H "$browser" -H "If-None-Match: $(header ETag)"
  expect_status 304
  [[ ! -s $work/body ]] || fail "a body with 304"
}
# Every address that the last page names answers, with what a browser would send.
links() {
  local count=0 link
  for link in $(grep -oE '(href|src)="[^"]*"' "$work/page" | cut -d'"' -f2 | sed 's/&amp;/\&/g' | sort -u); do
    [[ $link == /* ]] || fail "an outside address: $link"
    request GET "$link" -H "$browser"
    expect_status 200
    [[ -s $work/body ]] || fail "$link is empty"
    count=$((count + 1))
  done
  ((count >= $1)) || fail "only $count links"
}
has() { grep -q -- "$1" "$work/page" || fail "the page lacks '$1'"; }
hasnt() { grep -q -- "$1" "$work/page" && fail "the page has '$1'" || true; }

# Without any job: what this is, and an example of every kind with its picture.
page /
has 'data-example='
for kind in contour motion_law winding fill_factor probe_path; do has "/assets/[0-9a-f]*/$kind.svg"; done
for example in $(grep -o 'data-example="[^"]*"' "$work/page" | cut -d'"' -f2); do
  request GET "/v1/examples/$example"
  expect_status 200
done
has "--data-binary @job.json $url/v1/jobs"
links 10
unchanged /
page '/?lang=de'
has '<html lang="de">'
has 'Dieses Beispiel planen'
for address in /new /compare; do
  page $address
  links 6
  unchanged $address
done

jq '.name = "<script>alert(1)</script>"' "$examples/bracket.json" >"$work/job.json"
post "$work/job.json"
await succeeded
page "/jobs/$id"
has '&lt;script&gt;'
has 'class="state succeeded"'
has 'Verification: passed'
has '>acceleration x</th>'
has '<th scope="row">path length</th><td>1178.19 mm</td>'
has 'setpoints?format=csv'
has 'data-verdict><strong class="big">[0-9.]* s</strong> <strong class="state succeeded">good</strong><br> Feed 5[0-9] %, '
has ' At the programmed feed the cuts take [0-9.]* s; '
has '<tr data-limit="[0-9]*"><th scope="row">feed</th><td class="k"><meter max="1" aria-label="feed" value="0.53'
has '<h2>Slowest blocks</h2>'
has '<details><summary>[0-9]* exactness checks passed, largest use '
has 'No motion within these limits is shorter than [0-9.]* s: at most [0-9.]* % to gain'
has '<th scope="row">created</th><td><time datetime="20[^"]*Z">20[^<]* UTC</time>'
has ' data-independent="time" data-unit="s" data-columns="x,y,'
links 8

# Lines of a program come with their text, escaped; at most five.
jq -n --slurpfile job "$examples/bracket.json" '$job[0] | .spec.contour = {gcode: "G21 G90\nG0 X10 (<b>)\nG1 X50 F6000\nG1 Y30\nG1 X20\nG1 Y5\nG1 X5\nG0 X0 Y0\n"}' >"$work/program.json"
post "$work/program.json"
await succeeded
page "/jobs/$id"
has '<h2>Slowest lines</h2>'
has '<code><bdi>G0 X10 (&lt;b&gt;)</bdi></code>'
has '<tr data-first="[0-9]*" data-count="[0-9]*"><th scope="row" class="n">[0-9]</th>'
[[ $(grep -c '</code></td><td class="n k">' "$work/page") == 7 ]] || fail "all lines that move"
page "/jobs/$id?lang=de"
has '<h2>Langsamste Zeilen</h2>'
has ' Mit dem programmierten Vorschub dauern die Schnitte [0-9,]* s'

# Every figure of a kind has its unit.
jq '.spec.machine = $machine' --argjson machine "$(jq -c . "$examples/machines/md1.json")" "$examples/bracket.json" >"$work/stages.json"
post "$work/stages.json"
await succeeded 120
page "/jobs/$id"
has '<th scope="row">coarse smoothness</th><td>x [0-9.e+]*, y [0-9.e+]* mm²/s³</td>'
has '<th scope="row">peak coarse acceleration</th><td>x [0-9.e+]*, y [0-9.e+]* mm/s²</td>'

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
has '>not good</strong><br> Failed: setpoint '
has ' % <strong class="state failed">failed</strong></td>'
[[ $(grep -n 'Verification: failed' "$work/page" | cut -d: -f1) -lt $(grep -n 'id="why"' "$work/page" | cut -d: -f1) ]] || fail "failed checks come first"
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
has '<section id="live"><p><progress max="1" value="'
hasnt '/result"'
links 3
request POST "/v1/jobs/$id/cancel"
await cancelled
page "/jobs/$id"
has 'The job was cancelled'
has 'href="/new?from='
hasnt 'id="live"'
links 4

page /
has '<td class="n duration">3.315 s</td><td class="age"><time datetime='
for state in succeeded failed cancelled; do has "class=\"state $state\""; done
has '&lt;script&gt;'
links 20
unchanged /
# Filters stand in the address, as /v1/jobs has them; empty ones, which forms send, say nothing.
page '/?state=failed&kind=&text=&sort='
has 'class="state failed"'
hasnt 'class="state succeeded"'
has '<a href="/?state=failed" data-state="failed" aria-current="true">'
page '/?text=nothing%20of%20that%20name'
has '<p id="none">'
page '/?limit=2'
[[ $(grep -c '<tr data-id' "$work/page") == 2 ]] || fail "two jobs"
next=$(grep -oE 'rel="next" href="[^"]*"' "$work/page" | cut -d'"' -f4 | sed 's/&amp;/\&/g')
page "$next"
[[ $(grep -c '<tr data-id' "$work/page") == 2 ]] || fail "the next two"
page '/?lang=de'
has 'fehlgeschlagen'
has '3,315 s'
# What the page follows: the list with the durations, tagged.
request GET '/jobs?state=succeeded&kind=contour&sort=oldest'
expect_json '.jobs[0].duration > 3.31 and .jobs[0].state == "succeeded" and .counts.failed > 0 and .next == null'
request GET '/jobs?state=succeeded&kind=contour&sort=oldest' -H "If-None-Match: $(header ETag)"
expect_status 304

# Errors that a browser meets are pages that say what to do, in its language; programs get documents.
page /jobs/nobody 404
has 'There is no job nobody'
has 'What to do'
has 'href="/"'
page '/jobs/nobody?lang=de' 404
has 'Was zu tun ist'
page '/?state=lost' 422
has '<code>/query/state</code>'
page /nothing/here 404
page /v1/jobs/nobody 404
request GET /jobs/nobody
expect_problem not-found 404
request GET /jobs/nobody -H 'Accept: application/json, text/html'
expect_problem not-found 404
request GET "/jobs/$id" -H 'Accept: application/json'
expect_problem not-acceptable 406
