"""One job document per machine, to be combined with a part file: `bahnwerk plan laser.json --contour gear.ngc`.

The contour in it is a square, there to be replaced. Its feed stays: drawings, which have none of their own, take it.
"""
from .text import job

LASER = {"x": (1800, 16000), "y": (1800, 16000)}
MILL = {"x": (500, 5000), "y": (500, 5000), "z": (300, 3000)}
LASER_CYCLE, MILL_CYCLE = 0.001, 0.002


def laser():
    contour = '{"points": [[0, 0], [100, 0], [100, 100], [0, 100]], "closed": true, "feed": 100}'
    return job("part on the laser", "laser", contour, LASER, LASER_CYCLE), 400.0


def mill():
    contour = '{"points": [[0, 0, 0], [100, 0, 0], [100, 100, -5], [0, 100, -5]], "closed": true, "feed": 30}'
    return job("part on the mill", "mill", contour, MILL, MILL_CYCLE), 200.0 + 2 * (100**2 + 5**2) ** 0.5
