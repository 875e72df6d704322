"""row_limits_client.py count URL ROOT WORK: called by row_limits.sh. Plans an example of every kind of limit and counts limits over all rows."""
import json
import math
import random
import sys
from pathlib import Path

from bahnwerk import Client

STATES = ["ahead", "stop", "dwell"]
ORDERS = {"position": 0, "stroke": 0, "tube": 0, "tension": 0, "velocity": 1, "feed": 1, "speed": 1,
          "acceleration": 2, "jerk": 3, "snap": 4}


def differences(limit, columns):
    """How often the limit's column has to be differentiated."""
    words, column = limit["name"].split(), limit["column"]
    order = next(ORDERS[word] for word in words if word in ORDERS)
    axis = column[1:]
    named = column == "v" or (axis in columns and column[0] in "vajs") or column in ("a", "j")
    return order - (" vajs".index(column[0]) if named else 0)


def permitted(limit, row):
    if "intervals" not in limit:
        return limit
    return next(each for each in limit["intervals"] if each["first"] <= row < each["first"] + each["count"])


def share(value, bounds):
    high, low = bounds["value"], bounds.get("lowest")
    if "lowest" not in bounds:
        return abs(value) / high if high else 0
    if low is None:
        return max(0, value / high) if high > 0 else high / value if high < 0 else float(value >= -1e-9)
    if high is None:
        return max(0, value / low) if low < 0 else low / value if low > 0 else float(value <= 1e-9)
    return abs(value - 0.5 * (low + high)) * 2 / (high - low) if high > low else 0


def recount(client, job, name):
    answer, rows = client.limits(job), client.rows(job)
    count, cycle, limits = answer["count"], answer["cycle_time"], answer["limits"]
    assert [each["name"] for each in limits[:3]] == STATES and [each["id"] for each in limits] == list(range(len(limits)))
    assert not any(each.get("more") for each in limits), "take an example of fewer changes"
    columns = rows.columns
    tables = {column: list(map(float, rows[column])) for column in columns}
    uses, numbers = [], []
    for k in range(count):
        best, number = 0.0, 0
        for limit in limits[3:]:
            assert limit["column"] is not None, limit
            n, values = differences(limit, columns), tables[limit["column"]]
            if count <= n:
                continue
            i = min(k, count - 1 - n)
            value = [lambda: values[i], lambda: (values[i + 1] - values[i]) / cycle,
                     lambda: (values[i + 2] - 2 * values[i + 1] + values[i]) / cycle ** 2][n]()
            use = share(value, permitted(limit, k))
            if use is not None and use > best:
                best, number = use, limit["id"]
        if best < 0.98:
            rest = abs(tables["v"][k]) <= 1e-9
            number = 0 if not rest else 2 if k + 1 < count and abs(tables["v"][k + 1]) <= 1e-9 else 1
        uses.append(best)
        numbers.append(number)
    served = client.rows(job, columns=["use", "limit"])
    wrong = 0
    for k in range(count):
        assert math.isclose(served["use"][k], uses[k], rel_tol=1e-6, abs_tol=1e-9), (name, k, served["use"][k], uses[k])
        wrong += served["limit"][k] != numbers[k]
    assert wrong <= 0.001 * count, (name, wrong, "rows at the very threshold")
    for limit in limits:
        time = cycle * sum(number == limit["id"] for number in served["limit"][:-1])
        assert math.isclose(limit["time"], time, abs_tol=1e-9), (name, limit, time)
    assert math.isclose(sum(each["time"] for each in limits), (count - 1) * cycle, rel_tol=1e-12)
    for _ in range(20):
        first = random.randrange(count)
        query = {"first": first, "count": random.randint(1, count - first), "points": random.randint(1, 200)}
        zoom = client.limits(job, **query)
        ends = zoom["points"]["index"][1:] + [query["first"] + query["count"]]
        for b, (begin, end) in enumerate(zip(zoom["points"]["index"], ends)):
            end = end - 1 if end == count and end > begin + 1 else end
            part = list(served["limit"][begin:end])
            for limit, shares in zip(limits, zoom["points"]["shares"]):
                assert math.isclose(shares[b], part.count(limit["id"]) / len(part), abs_tol=1e-12)
    print(name, {each["name"]: round(each["share"], 3) for each in limits if each["share"] > 0}, count, "rows,", wrong)


def main(url, root, work):
    random.seed(1)
    client = Client(url)
    documents = ["contour/complete", "contour/minimal", "contour/dwell", "contour/gcode", "contour/coarse_fine",
                 "contour/coarse_fine_jerk", "contour/blend", "probe_path/minimal", "probe_path/arcs", "winding/minimal",
                 "motion_law/minimal", "motion_law/complete", "motion_law/free_angles", "motion_law/tolerance_boxes"]
    jobs = {}
    for name in documents:
        document = json.loads(Path(root, "schemas/examples", name + ".json").read_text())
        jobs[name] = client.submit({"kind": name.split("/")[0], "spec": document.get("spec", document)})["id"]
    for name, job in jobs.items():
        client.wait(job)
        recount(client, job, name)
    Path(work, "ids").write_text("".join("%s %s\n" % (job, name) for name, job in jobs.items()))


main(*sys.argv[2:5])
