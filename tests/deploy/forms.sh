#!/usr/bin/env bash
# Checks the form of what deploy/ and docker/ hold, and that the OpenAPI document is good for a generator of types: forms.sh BAHNWERK. Needs npm and promtool; called by
# .ci/run package.
source "$(dirname "$0")/../contract/lib.sh"
bahnwerk=$(realpath "$bahnwerk")
modules=$root/build/npm
mkdir -p "$modules"
if ! cmp -s "$root/tests/deploy/package-lock.json" "$modules/package-lock.json"; then
  cp "$root"/tests/deploy/package{,-lock}.json "$modules/"
  npm ci --prefix "$modules" --ignore-scripts --no-audit --no-fund >"$work/npm" 2>&1 || { rm -f "$modules/package-lock.json"; tail -5 "$work/npm" >&2; fail "npm ci"; }
fi

# Alerts and dashboard: promtool reads each expression, and the alerts are raised where they must be.
cp -r "$root/deploy/prometheus" "$work/prometheus"
# Debian's promtool knows nothing of Kubernetes.
sed -i 's/kubernetes_sd_configs:/static_configs:/; s/role: pod/targets: [pod]/' "$work/prometheus/kubernetes.yml"
for file in prometheus kubernetes; do
  promtool check config "$work/prometheus/$file.yml" >"$work/out" 2>&1 || { cat "$work/out" >&2; fail "promtool check config: $file.yml"; }
done
promtool test rules "$root/deploy/prometheus/alerts_test.yml" >"$work/out" 2>&1 || { cat "$work/out" >&2; fail "promtool test rules"; }
jq '{groups: [{name: "dashboard", rules: [.panels[] | .id as $panel | .targets[] | {record: "panel\($panel)_\(.refId)", expr: (.expr | gsub("\\$__rate_interval"; "5m"))}]}]}' \
  "$root/deploy/grafana/bahnwerk.json" >"$work/dashboard.yml"
promtool check rules "$work/dashboard.yml" >"$work/out" 2>&1 || { cat "$work/out" >&2; fail "promtool check rules: the dashboard"; }
(($(jq '[.groups[].rules[]] | length' "$work/dashboard.yml") > 10)) || fail "panels"

start_server
request GET /openapi.json
cp "$root"/tests/deploy/*.{mjs,ts} "$work/"
ln -s "$modules/node_modules" "$work/node_modules"
cd "$work" || exit
# A member with a default need not be given.
node_modules/.bin/openapi-typescript body --default-non-nullable=false -o api.d.ts >out 2>&1 || { cat out >&2; fail "types from the OpenAPI document"; }
# Dockerfile, Kubernetes' own schemas; writes manifests.ts, in which the compiler finds members that no schema names.
node forms.mjs "$root" || fail "a form is wrong"
node_modules/.bin/tsc --noEmit --strict --target es2022 --module nodenext --moduleResolution nodenext client_types.ts manifests.ts >out 2>&1 || { cat out >&2; fail "tsc"; }
node_modules/.bin/dclint --disable-rule no-build-and-image --max-warnings 0 "$root/docker/compose.yaml" >out 2>&1 || { cat out >&2; fail "dclint"; }
# What several services have in common stands before them.
node_modules/.bin/dclint --disable-rule service-keys-order services-alphabetical-order top-level-properties-order --max-warnings 0 "$root/deploy/compose.postgres.yaml" >out 2>&1 ||
  { cat out >&2; fail "dclint: compose.postgres.yaml"; }

# Debian 12 has no kubectl; where there is one it puts the manifests together.
if command -v kubectl >/dev/null; then
  for folder in kubernetes kubernetes/postgres; do kubectl kustomize "$root/deploy/$folder" >out 2>&1 || { cat out >&2; fail "kubectl kustomize $folder"; }; done
fi

# systemd-analyze ends with 0 when it knows a key not, and says so: any word is a fault.
sed "s#^ExecStart=/usr/bin/bahnwerk#ExecStart=$bahnwerk#" "$root/deploy/systemd/bahnwerk.service" >bahnwerk.service
systemd-analyze verify --man=no "$work/bahnwerk.service" >out 2>&1 || { cat out >&2; fail "systemd-analyze verify"; }
[[ ! -s out ]] || { cat out >&2; fail "systemd-analyze verify"; }
systemd-analyze security --offline=yes --no-pager --threshold=20 "$work/bahnwerk.service" >out 2>&1 || { tail -30 out >&2; fail "systemd-analyze security: more exposed than 2.0"; }
echo "deployment files: $(tail -n 1 out | sed 's/^[^a-zA-Z]*//')"
