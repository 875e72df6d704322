"""names.py ROOT METRICS HELP VERSION: called by names.sh. HELP.COMMAND is the help of a command."""
import json
import re
import sys
from pathlib import Path

root = Path(sys.argv[1])
metrics, version = Path(sys.argv[2]).read_text(), Path(sys.argv[4]).read_text().split()[1]
helps = {command: Path(f"{sys.argv[3]}.{command}").read_text() for command in ("serve", "submit", "migrate")}
manifests = sorted(path.relative_to(root).as_posix() for path in (root / "deploy/kubernetes").rglob("*.yaml"))
faults = []


def expect(condition, fault):
    if not condition:
        faults.append(fault)


def expressions():
    """(file, expression) of all alerts and panels."""
    text = (root / "deploy/prometheus/alerts.yml").read_text()
    for rule in re.split(r"^ *- alert: ", text, flags=re.M)[1:]:
        block = re.search(r"^ *expr: \|?(.*?)^ *(?:for|labels):", rule, re.M | re.S)
        yield "alerts.yml, " + rule.split()[0], block[1]
    for panel in json.loads((root / "deploy/grafana/bahnwerk.json").read_text())["panels"]:
        for target in panel["targets"]:
            yield "bahnwerk.json, " + panel["title"], target["expr"]
    for name in manifests:
        for query in re.findall(r"^ *query: (.*)", (root / name).read_text(), re.M):
            yield name, query


# The series that the service has, with their labels and those that Prometheus gives them.
given = {"job", "instance", "store"}
for name in ("prometheus.yml", "kubernetes.yml"):
    expect("target_label: store" in (root / "deploy/prometheus" / name).read_text(), f"{name} names no stores")
labels = {"up": set(given)}
for line in metrics.splitlines():
    found = re.match(r"(\w+)(?:\{(.*)\})? ", line)
    if found and not line.startswith("#"):
        labels.setdefault(found[1], set(given)).update(re.findall(r'(\w+)="', found[2] or ""))
# What docs/operations.md says of them: whether the values of several processes are summed, or tell the same.
over = {}
for names, how in re.findall(r"^\| ((?:`\w+(?:\{[\w,]*\})?`(?:, )?)+) \|.*\| (\w+) \|$", (root / "docs/operations.md").read_text(), re.M):
    over |= {name: how for name in re.findall(r"`(bahnwerk_\w+)", names)}
expect(set(over) == {re.sub(r"_(bucket|count|sum)$", "", name) for name in labels if name.startswith("bahnwerk_")},
       f"docs/operations.md explains other metrics than there are: {sorted(set(over) ^ {re.sub(r'_(bucket|count|sum)$', '', name) for name in labels if name.startswith('bahnwerk_')})}")


def aggregation(expression, position):
    """The function with by () or without that the series at this position is inside of, the innermost one; '': there is none."""
    depth = 0
    for k in range(position - 1, -1, -1):
        depth += {")": 1, "(": -1}.get(expression[k], 0)
        if depth < 0:
            found = re.search(r"\b(sum|avg|max|min|count)(?: +by \([^()]*\))? *$", expression[:k])
            if found:
                return found[1]
            depth = 0
    return ""


used = set()
for place, expression in expressions():
    names = re.findall(r"\b((?:bahnwerk|process)_\w+|up)\b", re.sub(r'"[^"]*"', '""', expression))
    expect(names, f"{place}: no metric in {expression}")
    known = set()
    for name in names:
        expect(name in labels, f"{place}: there is no metric {name}")
        known |= labels.get(name, set())
        used.add(re.sub(r"_(bucket|count|sum)$", "", name))
    for found in re.finditer(r"\bbahnwerk_\w+", expression):
        how, function = over.get(found[0]), aggregation(expression, found.start())
        if how in ("largest", "least"):
            expect(function == {"largest": "max", "least": "min"}[how], f"{place}: all processes of a store tell {found[0]}: take the {how}, not {function or 'each'}")
    named = re.findall(r"(\w+) *(?:=~|!~|!=|=) *\"", expression)
    for group in re.findall(r"\b(?:by|on|without) *\(([^)]*)\)", expression):
        named += [name.strip() for name in group.split(",")]
    for name in named:
        expect(name in known, f"{place}: none of its metrics has the label {name}")
for name in {re.sub(r"_(bucket|count|sum)$", "", name) for name in labels} - used:
    expect(False, f"neither an alert nor a panel shows {name}")

# Each alert is explained.
operations = (root / "docs/operations.md").read_text()
headings = {re.sub(r"[^\w -]", "", line.lstrip("# ")).strip().lower().replace(" ", "-") for line in operations.splitlines() if line.startswith("#")}
for alert in re.findall(r"- alert: (\w+)", (root / "deploy/prometheus/alerts.yml").read_text()):
    expect(alert.lower() in headings, f"docs/operations.md has no section {alert}")

# Variables are those of the program.
variables = {variable for text in helps.values() for variable in re.findall(r"Env:(BAHNWERK_\w+)", text)}
expect(len(variables) > 10, "the help names no variables")
composes = ["docker/compose.yaml", "deploy/compose.postgres.yaml"]
for name in ["docker/Dockerfile", "deploy/systemd/bahnwerk.service", "deploy/systemd/bahnwerk.default", "docs/operations.md", *composes, *manifests]:
    for variable in set(re.findall(r"\bBAHNWERK_\w+", (root / name).read_text())):
        expect(variable in variables, f"{name}: the program has no variable {variable}")

# Commands have these flags, probes ask for what is served.
served = json.loads((root / "schemas/openapi.json").read_text())["paths"]
for name in [*composes, *manifests]:
    text = (root / name).read_text()
    for words in re.findall(r"^ *(?:args|command): \[((?:serve|migrate).*)\]", text, re.M):
        command, *rest = re.split(", *", words)
        for word in rest:
            flag = not word.startswith("--") or re.search(rf"(?<![\w-]){word}(?![\w-])", helps[command])
            expect(flag, f"{name}: bahnwerk {command} has no {word}")
    for path in re.findall(r"^ *(?:path|prometheus.io/path): (/\S*)", text, re.M):
        expect(path in served, f"{name}: the service has no {path}")
for role in ("api", "worker"):
    expect(re.search(rf"--role .*\{{[^}}]*\b{role}\b", helps["serve"]), f"there is no role {role}")

# One number for memory, three quarters of the limit of unit, container and pod.
for name, limit in [("deploy/systemd/bahnwerk.service", "MemoryMax=4G\n"), ("docker/compose.yaml", "mem_limit: 4g\n"),
                    ("deploy/compose.postgres.yaml", "mem_limit: 4g\n"), ("deploy/kubernetes/statefulset.yaml", "memory: 4Gi\n"),
                    ("deploy/kubernetes/postgres/worker.yaml", "memory: 4Gi\n")]:
    text = (root / name).read_text()
    expect(limit in text, f"{name} has no {limit.strip()}")
    expect(re.search(r"BAHNWERK_MAX_MEMORY\W+(?:value: )?3GiB", text), f"{name} does not set BAHNWERK_MAX_MEMORY to 3GiB")

# The version stands in six more places.
for name in composes:
    expect(f"image: bahnwerk:{version}\n" in (root / name).read_text(), f"{name} is not of version {version}")
for name in ["deploy/kubernetes/kustomization.yaml", "deploy/kubernetes/postgres/kustomization.yaml"]:
    expect(f"newTag: {version}\n" in (root / name).read_text(), f"{name} is not of version {version}")
job = f"name: bahnwerk-migrate-{version.replace('.', '-')}\n"
expect(job in (root / "deploy/kubernetes/postgres/migrate.yaml").read_text(), f"migrate.yaml has no {job.strip()}")

for fault in faults:
    print(fault)
sys.exit(bool(faults))
