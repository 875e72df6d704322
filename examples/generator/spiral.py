"""A spiral of arcs in the plane, each tangent to the next: only the curvature jumps, by a little, at every joint."""
import math
import random

from .gcode import Program

FEED = 60000
FIRST, GROWTH = 5.0, 0.15  # radius of the first arc and what a quarter of a turn adds, mm
SIZE = 1000  # arcs


def gcode(seed=1, size=SIZE):
    rng = random.Random(f"spiral {seed}")
    program = Program([f"SPIRAL OF TANGENT ARCS, SEED {seed}"], ["G21 G17 G90 G40 G94"])
    program.rapid(FIRST, 0)
    program.tool(True)
    centre, angle, radius = (0.0, 0.0), 0.0, FIRST
    for _ in range(size):
        turn = rng.uniform(0.3, 1.0) * math.pi / 2
        angle += turn
        out = (math.cos(angle), math.sin(angle))
        end = (centre[0] + radius * out[0], centre[1] + radius * out[1])
        program.arc(end, centre, True, feed=FEED)
        grown = GROWTH * turn / (math.pi / 2)
        radius += grown
        centre = (centre[0] - grown * out[0], centre[1] - grown * out[1])
    program.tool(False)
    program.word("M2")
    return program.text()
