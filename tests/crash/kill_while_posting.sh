#!/usr/bin/env bash
# Clients post without pause, the process is killed at random moments: whatever was acknowledged is there afterwards, once.
source "$(dirname "$0")/../contract/lib.sh"
RANDOM=${SEED:-7}
rounds=${ROUNDS:-6}
: >"$work/acknowledged"

# client N: posts until the server is gone; writes down key and id of every 202.
client() {
  local n=0 key answer
  while :; do
    key=$round-$1-$((n++))
    answer=$(curl -sS --max-time 10 -H 'Content-Type: application/json' -H "Idempotency-Key: $key" -w '\n%{http_code}' \
      --data-binary "@$examples/line.json" "$url/v1/jobs" 2>/dev/null) || return 0
    [[ ${answer##*$'\n'} == 202 ]] && echo "$key $(jq -r .id <<<"${answer%$'\n'*}")" >>"$work/acknowledged.$1"
  done
}

for round in $(seq "$rounds"); do
  start_server --workers 1
  [[ -n $url ]] || fail "no address"
  clients=()
  for n in 1 2 3 4; do
    client "$n" &
    clients+=($!)
  done
  enough() { (($(cat "$work"/acknowledged.* 2>/dev/null | wc -l) >= 6 * round)); }
  soon enough || fail "too few jobs are acknowledged"
  sleep "0.$((RANDOM % 9))$((RANDOM % 10))"
  stop_server KILL || true
  for pid in "${clients[@]}"; do wait "$pid"; done
done

start_server --workers 1
cat "$work"/acknowledged.* | sort >"$work/acknowledged"
count=$(wc -l <"$work/acknowledged")
cursor=
while :; do
  request GET "/v1/jobs?limit=200${cursor:+&cursor=$cursor}"
  expect_status 200
  field '.jobs[] | .id' >>"$work/present"
  cursor=$(field '.next // empty')
  [[ -n $cursor ]] || break
done
missing=$(comm -23 <(cut -d' ' -f2 "$work/acknowledged" | sort) <(sort "$work/present"))
[[ -z $missing ]] || fail "acknowledged, but missing: $missing"
expect_equal "$(sort "$work/present" | uniq -d | wc -l)" 0 "jobs listed twice"
# The keys survived with their jobs.
while read -r key expected; do
  post "$examples/line.json" -H "Idempotency-Key: $key"
  expect_status 202
  expect_equal "$id" "$expected" "the job of key $key"
done < <(shuf -n 20 --random-source=<(yes) "$work/acknowledged")
# And all of them are planned in the end.
id=$(cut -d' ' -f2 "$work/acknowledged" | sort | tail -n 1)
await succeeded 300
echo "$count acknowledged, $(wc -l <"$work/present") present, none missing"
