#!/usr/bin/env bash
# TLS: a certificate made by hand, clients that check it, certificates of clients, a new certificate without a restart.
source "$(dirname "$0")/lib.sh"
# certificate NAME CN [authority]: NAME.pem and NAME.key, signed by itself or by the authority
certificate() {
  python3 - "$work" "$@" <<'P'
import subprocess, sys
work, name, cn = sys.argv[1:4]
ca = sys.argv[4] if len(sys.argv) > 4 else None
key, pem = f"{work}/{name}.key", f"{work}/{name}.pem"
run = lambda *args: subprocess.run(["openssl", *args], check=True, stderr=subprocess.DEVNULL)
if ca:
    run("req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-subj", f"/CN={cn}", "-keyout", key, "-out", f"{work}/{name}.csr")
    open(f"{work}/{name}.ext", "w").write("subjectAltName=DNS:localhost,IP:127.0.0.1\n")
    run("x509", "-req", "-in", f"{work}/{name}.csr", "-CA", f"{work}/{ca}.pem", "-CAkey", f"{work}/{ca}.key", "-CAcreateserial", "-days", "2",
        "-extfile", f"{work}/{name}.ext", "-out", pem)
else:
    run("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2", "-subj", f"/CN={cn}", "-keyout", key, "-out", pem)
P
}
certificate ca authority
certificate other stranger
certificate server first ca
certificate client client ca

start_server --tls-cert "$work/server.pem" --tls-key "$work/server.key"
url=https://$address
export BAHNWERK_SERVER=$url BAHNWERK_CA=$work/ca.pem
curl -fsS --cacert "$work/ca.pem" "$url/healthz" >/dev/null || fail "TLS"
for version in 1.2 1.3; do
  curl -fsS --cacert "$work/ca.pem" --tlsv$version --tls-max $version "$url/healthz" >/dev/null || fail "TLS $version"
done
curl -s --cacert "$work/ca.pem" --tls-max 1.1 --ciphers DEFAULT@SECLEVEL=0 "$url/healthz" >/dev/null && fail "TLS 1.1"
curl -s --cacert "$work/other.pem" "$url/healthz" >/dev/null && fail "the certificate is checked by the test, too"
curl -s "http://$address/healthz" >/dev/null && fail "plain HTTP"

# The command line and the clients.
"$bahnwerk" submit --wait "$examples/line.json" >"$work/result.json" || fail "submit over TLS"
jq -e .verification.passed "$work/result.json" >/dev/null || fail "the result"
"$bahnwerk" health --ready >/dev/null || fail "health over TLS"
code=0
"$bahnwerk" health --ca "$work/other.pem" 2>"$work/err" || code=$?
[[ $code == 3 ]] || fail "a server whose certificate comes from elsewhere is not reached"
python3 "$root/examples/clients/python/bahnwerk.py" --server "$url" "$examples/line.json" >/dev/null || fail "the Python client"
NODE_EXTRA_CA_CERTS=$work/ca.pem node "$root/examples/clients/node/bahnwerk.mjs" "$examples/line.json" "$url" >/dev/null || fail "the Node client"
# A long answer and a stream.
id=$(curl -fsS --cacert "$work/ca.pem" -H 'Content-Type: application/json' --data-binary @"$examples/bracket.json" "$url/v1/jobs" | jq -r .id)
curl -fsS --cacert "$work/ca.pem" "$url/v1/jobs/$id/events" >"$work/events" || fail "events over TLS"
grep -q '"state":"succeeded"' "$work/events" || fail "the last event"
curl -fsS --cacert "$work/ca.pem" -H 'Accept: text/csv' "$url/v1/jobs/$id/setpoints" >"$work/rows.csv" || fail "setpoints over TLS"
rows=$(curl -fsS --cacert "$work/ca.pem" "$url/v1/jobs/$id/result" | jq .setpoints.count)
[[ $(wc -l <"$work/rows.csv") == $((rows + 1)) ]] || fail "all rows"

# A new certificate for new connections; one that is wrong changes nothing.
subject() { curl -sv --cacert "$work/ca.pem" "$url/healthz" 2>&1 | sed -n 's/^\* *subject: CN *= *//p'; }
[[ $(subject) == first ]] || fail "the first certificate"
certificate server second ca
kill -HUP "$server_pid"
renewed() { [[ $(subject) == second ]]; }
soon renewed || fail "SIGHUP reads the certificate"
echo nonsense >"$work/server.pem"
kill -HUP "$server_pid"
soon logged '.event == "certificate_not_loaded"' || fail "the log names the fault"
renewed || fail "the certificate in use stays"
certificate server third ca
stop_server || fail "an orderly end"

# Clients need a certificate of this authority, too.
start_server --tls-cert "$work/server.pem" --tls-key "$work/server.key" --tls-client-ca "$work/ca.pem"
url=https://$address
curl -s --cacert "$work/ca.pem" "$url/healthz" >/dev/null && fail "without a certificate"
curl -s --cacert "$work/ca.pem" --cert "$work/other.pem" --key "$work/other.key" "$url/healthz" >/dev/null && fail "with a stranger's"
curl -fsS --cacert "$work/ca.pem" --cert "$work/client.pem" --key "$work/client.key" "$url/healthz" >/dev/null || fail "with its own"
"$bahnwerk" health --server "$url" --cert "$work/client.pem" --cert-key "$work/client.key" >/dev/null || fail "the command line's certificate"
# Clients that never finish their handshake keep nobody from an end.
exec 5<>"/dev/tcp/$host/$port"
stop_server || fail "an end while a client shakes hands"
exec 5>&-

refused() { # word, then flags
  local word=$1 code=0
  shift
  "$bahnwerk" serve --listen 127.0.0.1:0 --store "sqlite:$work/refused.db" "$@" 2>"$work/err" || code=$?
  [[ $code == 2 ]] && grep -qF -- "$word" "$work/err" || fail "expected a refusal with '$word': $(cat "$work/err")"
}
refused 'tls-key' --tls-cert "$work/server.pem"
refused 'tls-cert' --tls-key "$work/server.key"
refused "$work/none.pem" --tls-cert "$work/none.pem" --tls-key "$work/server.key"
refused mismatch --tls-cert "$work/server.pem" --tls-key "$work/other.key"
