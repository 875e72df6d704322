"""names.py ROOT METRICS HELP VERSION: called by names.sh."""
import json
import re
import sys
from pathlib import Path

root = Path(sys.argv[1])
metrics, help_text, version = (Path(name).read_text() for name in sys.argv[2:5])
version = version.split()[1]
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


# The series that the service has, with their labels.
labels = {"up": {"job", "instance"}}
for line in metrics.splitlines():
    found = re.match(r"(\w+)(?:\{(.*)\})? ", line)
    if found and not line.startswith("#"):
        labels.setdefault(found[1], {"job", "instance"}).update(re.findall(r'(\w+)="', found[2] or ""))
used = set()
for place, expression in expressions():
    names = re.findall(r"\b((?:bahnwerk|process)_\w+|up)\b", re.sub(r'"[^"]*"', '""', expression))
    expect(names, f"{place}: no metric in {expression}")
    known = set()
    for name in names:
        expect(name in labels, f"{place}: there is no metric {name}")
        known |= labels.get(name, set())
        used.add(re.sub(r"_(bucket|count|sum)$", "", name))
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
variables = set(re.findall(r"Env:(BAHNWERK_\w+)", help_text))
expect(len(variables) > 10, "the help names no variables")
named = ["docker/Dockerfile", "docker/compose.yaml", "deploy/kubernetes/statefulset.yaml", "deploy/systemd/bahnwerk.service", "deploy/systemd/bahnwerk.default",
         "docs/operations.md"]
for name in named:
    for variable in set(re.findall(r"\bBAHNWERK_\w+", (root / name).read_text())):
        expect(variable in variables, f"{name}: the program has no variable {variable}")

# One number for memory, three quarters of the limit of unit, container and pod.
for name, limit in [("deploy/systemd/bahnwerk.service", "MemoryMax=4G\n"), ("docker/compose.yaml", "mem_limit: 4g\n"),
                    ("deploy/kubernetes/statefulset.yaml", "memory: 4Gi\n")]:
    text = (root / name).read_text()
    expect(limit in text, f"{name} has no {limit.strip()}")
    expect(re.search(r"BAHNWERK_MAX_MEMORY\W+(?:value: )?3GiB", text), f"{name} does not set BAHNWERK_MAX_MEMORY to 3GiB")

# The version stands in three more places.
expect(f"image: bahnwerk:{version}\n" in (root / "docker/compose.yaml").read_text(), f"docker/compose.yaml is not of version {version}")
expect(f"newTag: {version}\n" in (root / "deploy/kubernetes/kustomization.yaml").read_text(), f"kustomization.yaml is not of version {version}")

for fault in faults:
    print(fault)
sys.exit(bool(faults))
