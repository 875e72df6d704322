#!/usr/bin/env bash
# Exit codes and sentences of the command line.
source "$(dirname "$0")/lib.sh"
code_of() { local code=0; "$@" >"$work/out" 2>"$work/err" || code=$?; echo $code; }

expect_equal "$(code_of "$bahnwerk" plan "$examples/line.json")" 0
expect_equal "$(code_of "$bahnwerk" plan /no/such/file)" 2
expect_equal "$(code_of "$bahnwerk" plan "$work")" 2 "a directory"
echo '{"kind":' | { code=0; "$bahnwerk" plan - >"$work/body" || code=$?; expect_equal $code 2; }
expect_json '.type == "/problems/invalid-json"'
jq '.kind = "nonsense"' "$examples/line.json" | { code=0; "$bahnwerk" plan - >"$work/body" || code=$?; expect_equal $code 2; }
expect_json '.type == "/problems/unknown-kind"'
snake 20000 '{"time_budget":0.2}' | { code=0; "$bahnwerk" plan - >"$work/body" || code=$?; expect_equal $code 1; }
expect_json '.type == "/problems/budget-exhausted"'
# Slow feeds are planned as any other; --out writes result, setpoints with mode and block, and the drawing.
jq '.spec.contour.blocks[0].feed = 0.1 | .spec.machine.cycle_time = 0.1' "$examples/line.json" >"$work/slow.json"
expect_equal "$(code_of "$bahnwerk" plan "$work/slow.json" --out "$work/slow")" 0 "100 mm at 0.1 mm/s"
expect_equal "$(head -n 1 "$work/slow/setpoints.csv" | tr -d '\r')" "x,y,vx,vy,ax,ay,s,v,mode,block"
expect_equal "$(tail -n 1 "$work/slow/setpoints.csv" | tr -d '\r')" "100,0,0,0,0,0,100,0,1,0"
grep -q '<path class="cut"' "$work/slow/contour.svg" || fail "a drawing of the contour"
expect_equal "$(jq '[.verification.checks[] | select(.name | startswith("setpoints ")).passed] | length > 8 and all' "$work/out")" true
# The same rows as a controller reads them; a layout needs rows to be written, and one that there is.
expect_equal "$(code_of "$bahnwerk" plan "$work/slow.json" --out "$work/slow" --layout twincat)" 0
expect_equal "$(sed -n '1p;$p' "$work/slow/setpoints.csv" | od -c -A n | tr -d ' \n')" 'x;y;vx;vy;mode;block\r\n100;0;0;0;1;0\r\n'
expect_equal "$(code_of "$bahnwerk" plan "$work/slow.json" --layout twincat)" 2
expect_equal "$(code_of "$bahnwerk" plan "$work/slow.json" --out "$work/slow" --layout nonsense)" 2
# Coarse and fine drives have files of their own, each with its delay; a group that there is not, or no time, is refused.
jq '{kind: "contour", spec: {contour: {points: [[0, 0], [30, 0]]}, machine: .}}' "$examples/machines/md2.json" >"$work/split.json"
expect_equal "$(code_of "$bahnwerk" plan "$work/split.json" --out "$work/split" --layout twincat --drives coarse=0 --drives fine=0.003)" 0
expect_equal "$(head -n 1 "$work/split/setpoints_coarse.csv" | tr -d '\r')" "xc;yc;vxc;vyc;mode;block"
expect_equal "$(head -n 1 "$work/split/setpoints_fine.csv" | tr -d '\r')" "xf;yf;vxf;vyf;mode;block"
expect_equal "$(($(wc -l <"$work/split/setpoints_fine.csv") - $(wc -l <"$work/split/setpoints_coarse.csv")))" 3 "cycles of 1 ms"
expect_equal "$(code_of "$bahnwerk" plan "$work/split.json" --out "$work/split" --drives fine)" 2
expect_equal "$(code_of "$bahnwerk" plan "$work/split.json" --out "$work/split" --drives quick=0.003)" 2
# A part program and a drawing take the contour's place.
printf 'G21 G90\nM3\nG1 X100 F6000\nM5\nG0 Y50\nM2\n' >"$work/part.ngc"
expect_equal "$(code_of "$bahnwerk" plan "$examples/line.json" --contour "$work/part.ngc")" 0
expect_equal "$(jq '[.details.blocks[].mode] | join(" ")' "$work/out")" '"cut position"'
printf '0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\n0\n20\n0\n40\n5\n0\nENDSEC\n0\nEOF\n' >"$work/part.DXF"
expect_equal "$(code_of "$bahnwerk" plan - --contour "$work/part.DXF" <"$examples/line.json")" 0
expect_equal "$(jq '.summary.path_length * 1e6 | round' "$work/out")" 31415927
# A binary drawing: its bytes travel in base64.
printf 'AutoCAD Binary DXF\r\n\x1a\x00\x00SECTION\x00\x02ENTITIES\x00\x00CIRCLE\x00\x28\x00\x00\x00\x00\x00\x00\x14\x40\x00ENDSEC\x00\x00EOF\x00' >"$work/binary.dxf"
expect_equal "$(code_of "$bahnwerk" plan "$examples/line.json" --contour "$work/binary.dxf")" 0
expect_equal "$(jq '.summary.path_length * 1e6 | round' "$work/out")" 31415927
printf 'G1 X10\nG41 X20\n' >"$work/wrong.nc"
expect_equal "$(code_of "$bahnwerk" plan "$examples/line.json" --contour "$work/wrong.nc")" 2
jq -e '.errors[0].pointer == "/spec/contour/gcode" and (.errors[0].message | startswith("line 2: "))' "$work/out" >/dev/null ||
  fail "the fault names its line"
expect_equal "$(code_of "$bahnwerk" nonsense)" 2
expect_equal "$(code_of "$bahnwerk")" 2
expect_equal "$(code_of "$bahnwerk" --help)" 0
expect_equal "$(code_of "$bahnwerk" serve --help)" 0
for flag in listen store workers role drain-timeout max-queued max-body; do
  grep -q -- "--$flag .*BAHNWERK_${flag//-/_}" <(tr 'a-z-' 'A-Z_' <"$work/out") 2>/dev/null ||
    grep -qi -- "--$flag.*(Env:BAHNWERK_$(tr 'a-z-' 'A-Z_' <<<"$flag"))" "$work/out" || fail "help names --$flag and its variable"
done
expect_equal "$(code_of "$bahnwerk" fetch x --server https://127.0.0.1:1)" 3
expect_equal "$(code_of "$bahnwerk" fetch x --server nonsense)" 2

# Refusals of serve, each a sentence.
refused() { # words, then the command
  local words=$1
  shift
  expect_equal "$(code_of timeout 20 "$@")" 2 "$words"
  grep -q -- "$words" "$work/err" || fail "expected a sentence with '$words', got: $(cat "$work/err")"
}
refused "server cannot be reached" "$bahnwerk" key list --store "postgresql://me:secret@/x?host=$work"
grep -q secret "$work/err" && fail "the password of the store was printed"
refused "has schema version 0" "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/new.db" --store-migrate never
expect_equal "$(code_of "$bahnwerk" migrate --store "sqlite:$work/new.db")" 0 "a store is made"
store=$work/new.db start_server --store-migrate never
refused "uses this store" "$bahnwerk" migrate --store "sqlite:$work/new.db"
stop_server || fail "an orderly end with --store-migrate never"
refused "there is no store" "$bahnwerk" migrate-store "$work/none.db" "postgresql://me@/x?host=$work"
refused "bahnwerk backup" "$bahnwerk" migrate-store "$work/a.db" "sqlite:$work/b.db"
refused "pg_dump" "$bahnwerk" migrate-store "postgresql://me@/x?host=$work" "postgresql://me@/y?host=$work"
refused "has no password" "$bahnwerk" serve --listen 127.0.0.1:0 --store "postgresql://me@/x?host=$work" --store-password-file "$work/none"
refused "is for a store postgresql" "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/a.db" --store-password-file "$work/none"
refused "not in {on,off}" "$bahnwerk" serve --store-notify maybe
refused "not in {on,off}" "$bahnwerk" serve --store-prepared maybe
refused "names a PostgreSQL server" "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/a.db" --store-listen-url "postgresql://me@/x?host=$work"
refused "unsupported store" "$bahnwerk" serve --listen 127.0.0.1:0 --store /tmp/x.db
refused "is no address" "$bahnwerk" serve --listen nonsense --store "sqlite:$work/a.db"
refused "is no port" "$bahnwerk" serve --listen 127.0.0.1:99999 --store "sqlite:$work/a.db"
refused "owned by one process" "$bahnwerk" serve --role worker
refused "workers" "$bahnwerk" serve --workers many
refused "is a directory" "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work"
refused "cannot make the store's directory" "$bahnwerk" serve --listen 127.0.0.1:0 --store sqlite:/proc/nowhere/a.db
echo "this is no database, but long enough to be looked at closely ................................" >"$work/text.db"
refused "not a database" "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/text.db"
start_server
refused "is taken by another program" "$bahnwerk" serve --listen "$address" --store "sqlite:$work/new/b.db"
[[ -e $work/new ]] && fail "a database was made before the address was sure"
refused "another bahnwerk" "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/store.db"
stop_server || fail "orderly end"

# Settings with which nothing could be served.
serve=("$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/settings.db")
for setting in store-reserve=-1 store-reserve=nan store-reserve=900000TiB event-heartbeat=0 event-heartbeat=nan event-heartbeat=-1 \
  header-timeout=0 body-timeout=0 write-timeout=nan idle-timeout=inf drain-timeout=nan drain-timeout=-1 stall-timeout=-0.1 \
  max-body=-1 max-body=0 max-bodies=0 max-bodies=-5 max-queued=0 max-queued=-1 workers=-1 workers=nan http-threads=0 http-threads=-1 \
  worker-nice=-1 max-connections=0 max-connections=-1 max-connections-per-address=-1 spare-connections=-1; do
  expect_equal "$(code_of timeout 20 "${serve[@]}" --"${setting%=*}=${setting#*=}")" 2 "$setting"
  [[ -s $work/err ]] || fail "$setting is refused without a sentence"
  name=BAHNWERK_$(tr 'a-z-' 'A-Z_' <<<"${setting%=*}")
  expect_equal "$(code_of timeout 20 env "$name=${setting#*=}" "${serve[@]}")" 2 "$name=${setting#*=}"
done
refused "does not fit on the store's disk" "${serve[@]}" --store-reserve 900000TiB
refused "BAHNWERK_WORKER is no setting" env BAHNWERK_WORKER=2 "${serve[@]}"
[[ ! -e $work/settings.db ]] || fail "a store was made before the settings were sure"

# Exit codes of the client, and a flag against its variable. `client CODE WORDS…`
start_server --workers 0 --max-queued 1
client() {
  local code=$1
  shift
  expect_equal "$(code_of "$bahnwerk" "$@")" "$code" "for bahnwerk $*: $(cat "$work/err")"
}
dead=http://127.0.0.1:1
client 0 submit "$examples/line.json" --server "$url"
id=$(jq -r .id "$work/out")
client 3 submit "$examples/line.json" --server "$url" # the queue is full: later
jq -e '.type == "/problems/too-many-jobs"' "$work/out" >/dev/null || fail "a refusal is printed"
client 2 submit /no/such/file --server "$url"
echo '{"kind":' >"$work/broken.json"
client 2 submit "$work/broken.json" --server "$url"
client 2 watch no-such-job --server "$url"
client 2 fetch no-such-job --server "$url"
client 2 fetch "$id" --server "$url" # not finished
client 2 fetch "$id" --format xml --server "$url"
request POST "/v1/jobs/$id/cancel"
client 1 watch "$id" --server "$url"
jq -e '.state == "cancelled"' "$work/out" >/dev/null || fail "watch prints the job"
client 1 fetch "$id" --server "$url"
grep -q '"/problems/no-result"' "$work/err" || fail "fetch says why"
[[ ! -s $work/out ]] || fail "fetch writes a problem where setpoints belong"
for command in "submit $examples/line.json" "watch $id" "fetch $id"; do
  client 3 $command --server "$dead"
  BAHNWERK_SERVER=$dead client 3 $command
  # A flag wins over its variable, and a variable of another command does not matter.
  expected=0
  [[ $command == submit* ]] || expected=1
  BAHNWERK_SERVER=$dead BAHNWERK_WORKERS=many client $expected $command --server "$url"
  [[ $command == submit* ]] && request POST "/v1/jobs/$(jq -r .id "$work/out")/cancel"
  BAHNWERK_SERVER=$url client $expected $command
  [[ $command == submit* ]] && request POST "/v1/jobs/$(jq -r .id "$work/out")/cancel"
  BAHNWERK_SERVER=$url client 3 $command --server "$dead"
done
for flag in "" --ready; do
  client 0 health $flag --server "$url"
  client 3 health $flag --server "$dead"
done
jq -e '.status == "alive"' <("$bahnwerk" health --server "$url") >/dev/null || fail "health prints the answer"
stop_server || fail "orderly end"
start_server --workers 1
client 0 submit "$examples/line.json" --wait --server "$url"
id=$(sed -n 's/^bahnwerk: job //p' "$work/err")
client 0 watch "$id" --server "$url"
snake 20000 '{"time_budget":0.2}' >"$work/budget.json"
client 1 submit "$work/budget.json" --wait --server "$url"
jq -e '.type == "/problems/budget-exhausted"' "$work/out" >/dev/null || fail "submit --wait prints why"
stop_server || fail "orderly end"
for command in "" serve plan submit watch fetch health backup check migrate migrate-store; do
  client 0 $command --help
  grep -q "Exit codes: 0 " "$work/out" || fail "help of '$command' names the exit codes"
done

# Every flag of serve wins over its variable, and every variable is read.
client 0 serve --help
mapfile -t flags < <(grep -o 'Env:BAHNWERK_[A-Z_]*' "$work/out" | sort -u | sed 's/Env:BAHNWERK_//')
((${#flags[@]} >= 14)) || fail "help names ${#flags[@]} variables"
declare -A good=([LISTEN]= [STORE]= [WORKERS]=1 [ROLE]=all [STORE_NOTIFY]=off [STORE_PREPARED]=on [STORE_MIGRATE]=auto [STORE_CONNECTIONS]=8 [HTTP_THREADS]=1 [MAX_QUEUED]=5 [MAX_BODY]=1MiB [MAX_CONNECTIONS]=9
  [HEADER_TIMEOUT]=5 [BODY_TIMEOUT]=5 [IDLE_TIMEOUT]=5 [WRITE_TIMEOUT]=5 [DRAIN_TIMEOUT]=1 [LOG_LEVEL]=debug)
for name in "${flags[@]}"; do
  [[ -v "good[$name]" ]] || continue
  base=()
  [[ $name == LISTEN ]] || base+=(--listen 127.0.0.1:0)
  [[ $name == STORE ]] || base+=(--store "sqlite:$work/flags.db")
  export "BAHNWERK_$name=nonsense"
  expect_equal "$(code_of timeout 20 "$bahnwerk" serve "${base[@]}")" 2 "BAHNWERK_$name is read"
  flag=()
  [[ -z ${good[$name]} ]] || flag=("--$(tr 'A-Z_' 'a-z-' <<<"$name")" "${good[$name]}")
  start_server "${flag[@]}" # gives --listen and --store itself
  stop_server || fail "an orderly end with BAHNWERK_$name"
  unset "BAHNWERK_$name"
done

# Flags from the environment.
export BAHNWERK_MAX_BODY=1kb
start_server
head -c 2000 /dev/zero | tr '\0' ' ' >"$work/big"
post "$work/big"
expect_problem payload-too-large 413
stop_server
unset BAHNWERK_MAX_BODY

# A PostgreSQL server that is away may come later; the password is not logged.
store_url="postgresql://me:secret@/x?host=$work" start_server
request GET /healthz
expect_status 200
request GET /readyz
expect_problem store-unavailable 503
request GET /v1/jobs
expect_problem store-unavailable 503
[[ -n $(header Retry-After) ]] || fail "expected Retry-After"
stop_server || fail "an orderly end while the store is away"
grep -q secret "$work/log" && fail "the password of the store was logged"
[[ $(grep -c store_away "$work/log") -ge 1 ]] || fail "the log does not say that the store is away"
