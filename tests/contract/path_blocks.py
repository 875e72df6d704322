"""Compares /path and /blocks of a job with all of its rows: python3 path_blocks.py URL ID [ID…]"""
import array
import json
import math
import random
import sys
import urllib.error
import urllib.request

url = sys.argv[1]
random.seed(1)


def get(path, accept="application/json"):
    with urllib.request.urlopen(urllib.request.Request(url + path, headers={"Accept": accept})) as answer:
        return answer.read(), answer.headers


def document(path):
    return json.loads(get(path)[0])


def single(value):
    return array.array("f", [value])[0]


def distance(p, a, b):
    way = [y - x for x, y in zip(a, b)]
    length = sum(w * w for w in way)
    t = sum((x - y) * w for x, y, w in zip(p, a, way)) / length if length > 0 else 0
    t = min(1, max(0, t))
    return math.dist(p, [x + t * w for x, w in zip(a, way)])


def check_path(id, rows, names, query, area, span):
    """Every row of the span that lies in the area is within the tolerance of the chord between the vertices around it."""
    answer = document("/v1/jobs/%s/path?%s" % (id, query))
    values, tolerance = answer["values"], answer["tolerance"]
    vertices = list(zip(*[values[name] for name in names]))
    chords = {}
    for i, row in enumerate(values["row"]):
        assert all(abs(single(c) - v) <= 1e-6 * abs(c) for c, v in zip(rows[row], vertices[i])), (query, row)
        if values["begin"][i] == 0:
            chords[values["row"][i - 1]] = (row, vertices[i - 1], vertices[i])
    begin = None
    for row in range(min(chords, default=0), span[1]):
        if row in chords:
            begin = row
        inside = area is None or (area[0] <= rows[row][0] <= area[2] and area[1] <= rows[row][1] <= area[3])
        if row < span[0] or not inside or row in values["row"][-1:]:
            continue
        end, a, b = chords[begin] if begin is not None else (-1, None, None)
        assert row <= end, (query, row, "has no chord")
        assert distance(rows[row], a, b) <= tolerance, (query, row, distance(rows[row], a, b), tolerance)
    return answer


def check_paths(id, columns, table, count):
    for of, names in (("tool", "xyz"), ("coarse", ("xc", "yc", "zc"))):
        places = [columns.index(name) for name in names if name in columns]
        if not places:
            continue
        rows = [[row[c] for c in places] for row in table]
        low, high = [min(c) for c in zip(*rows)], [max(c) for c in zip(*rows)]
        axes = "xyz"[: len(places)]
        whole = check_path(id, rows, axes, "of=%s&points=50" % of, None, (0, count))
        assert 2 <= whole["count"] <= 50, whole["count"]
        for _ in range(12):
            first = random.randrange(count)
            span = (first, random.randrange(first, count) + 1)
            size = [(h - l) * 10 ** random.uniform(-2, 0) for l, h in zip(low, high)]
            corner = [random.uniform(l, h - s) for l, h, s in zip(low, high, size)]
            area = (corner[0], corner[1], corner[0] + size[0], corner[1] + size[1]) if random.random() < 0.7 else None
            query = "of=%s&first=%d&count=%d" % (of, span[0], span[1] - span[0])
            if area:
                query += "&box=%r,%r,%r,%r" % area
            query += random.choice(["&points=%d" % random.randrange(2, 500), "&tolerance=%r" % 10 ** random.uniform(-4, 1)])
            check_path(id, rows, axes, query, area, span)


def check_blocks(id, columns, table, step):
    pages = {}
    for by in ("block", "segment", "line"):
        try:
            first, pages[by] = 0, []
            while True:
                page = document("/v1/jobs/%s/blocks?by=%s&first=%d&count=1000" % (id, by, first))
                pages[by] += page["blocks"]
                first += 1000
                if first >= page["total"]:
                    break
        except urllib.error.HTTPError as error:
            assert by == "line" and error.code == 422
            del pages[by]  # this contour is no program
    result = document("/v1/jobs/%s/result?parts=summary,setpoints.duration,details.blocks_total" % id)
    duration, length = result["setpoints"]["duration"], result["summary"]["path_length"]
    for by, entries in pages.items():
        assert math.isclose(sum(e["time"] for e in entries), duration, rel_tol=1e-6), by
        assert math.isclose(sum(e["length"] for e in entries), length, rel_tol=1e-6), by
        for e in entries:
            if e["feed"] is not None and by == "segment":
                assert math.isclose(e["lost"], e["time"] - e["length"] / e["feed"], rel_tol=1e-4, abs_tol=1e-5), e
            assert e["lost"] > -1e-4 * e["time"] - 1e-6, e
    counts = {}
    block = columns.index("block")
    for row in table[:-1]:
        counts[row[block]] = counts.get(row[block], 0) + 1
    for e in pages["block"]:
        assert abs(counts.get(e["block"], 0) * step - e["time"]) <= step * (e["visits"] + 0.01), e
    assert result["details"]["blocks_total"] >= len(pages["block"])
    order = [e["lost"] for e in document("/v1/jobs/%s/blocks?by=segment&sort=lost&count=1000" % id)["blocks"]]
    assert order == sorted(order, reverse=True)


for id in sys.argv[2:]:
    body, headers = get("/v1/jobs/%s/setpoints" % id, "application/octet-stream")
    columns, flat = headers["X-Columns"].split(","), array.array("d", body)
    table = [flat[i : i + len(columns)] for i in range(0, len(flat), len(columns))]
    check_paths(id, columns, table, len(table))
    if "block" in columns:
        check_blocks(id, columns, table, document("/v1/jobs/%s/result?parts=setpoints" % id)["setpoints"]["cycle_time"])
