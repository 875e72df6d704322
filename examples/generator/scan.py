"""A surface as a probe measured it, milled row by row in the XZ plane: chords of 0.05 to 0.3 mm, and z off by up to
0.05 mm from point to point. Rows are joined by short ways in y: the tool never rests but where the chords turn back."""
import math
import random

from .gcode import Program

FEED, CLEARANCE = 60000, 5.0
ROW, STEP = 180.0, 0.5  # length of a row and distance of rows, mm
SIZE = 169220  # lines


def gcode(seed=1, size=SIZE):
    rng = random.Random(f"scan {seed}")
    program = Program([f"SURFACE AS MEASURED, SEED {seed}"], ["G21 G17 G90 G40 G94"])
    program.rapid(z=CLEARANCE)
    program.rapid(0, 0)
    program.tool(True)
    x, y, forward = 0.0, 0.0, 1
    program.line(z=_height(x, y), feed=FEED)
    for _ in range(size):
        x += forward * rng.uniform(0.05, 0.3)
        if 0 <= x <= ROW:
            program.line(x, z=_height(x, y) + rng.uniform(-0.05, 0.05), feed=FEED)
        else:
            x, y, forward = min(max(x, 0.0), ROW), y + STEP, -forward
            program.line(y=y, feed=FEED)
    program.tool(False)
    program.rapid(z=CLEARANCE)
    program.word("M2")
    return program.text()


def _height(x, y):
    return -3 + 2 * math.sin(x / 17) * math.cos(y / 23) + 0.5 * math.sin((x + y) / 5)
