"""Lettering carved with a V-shaped tool, as CAM programs write it: the tool follows the middle of every stroke, deeper
where the stroke is wider.

A stroke is a chain of arcs of 2 to 100 mm radius with ramps in z. Each arc goes on in the direction in which the last
one ended, but for the rounding to four decimals: tangents jump by up to 1e-4 rad, curvature by any amount. Short lines
lead in and out. 130 strokes are some 2 300 lines.
"""
import math
import random

from .gcode import Program

PAGE, PITCH = 300.0, 25.0  # width of the page, distance of strokes
FEED, CLEARANCE = 1500, 5.0
SIZE = 130  # strokes


def gcode(seed=1, size=SIZE):
    rng = random.Random(f"carving {seed}")
    program = Program([f"LETTERING CARVED WITH A V TOOL, SEED {seed}"], ["G21 G17 G90 G40 G94"])
    program.tool(True)
    for i in range(size):
        row, place = divmod(i, int(PAGE / PITCH))
        _stroke(program, rng, place * PITCH, -row * PITCH)
    program.rapid(z=CLEARANCE)
    program.word("M2")
    return program.text()


def _stroke(program, rng, x, y):
    heading, depth = rng.uniform(-math.pi, math.pi), 0.0
    program.rapid(z=CLEARANCE)
    program.rapid(x, y)
    program.line(z=0, feed=FEED / 3)
    for _ in range(rng.randint(1, 3)):
        depth = _deeper(rng, depth)
        _line(program, rng.uniform(0.2, 2), heading, depth)
    for _ in range(rng.randint(6, 20)):
        depth = _deeper(rng, depth)
        heading = _arc(program, rng, heading, depth)
    _line(program, rng.uniform(0.2, 2), heading, 0.0)


def _deeper(rng, depth):
    return min(0.0, max(-3.0, depth + rng.uniform(-0.3, 0.2)))


def _line(program, length, heading, depth):
    x, y = program.at[:2]
    program.line(x + length * math.cos(heading), y + length * math.sin(heading), depth, feed=FEED)


def _arc(program, rng, heading, depth):
    """From where the tool is, on in its direction; returns the direction at the end."""
    radius, ccw = 2 * 50 ** rng.random(), rng.random() < 0.5
    turn = min(rng.uniform(0.5, 12) / radius, 2.5) * (1 if ccw else -1)
    side = radius if ccw else -radius
    x, y = program.at[:2]
    centre = (x - side * math.sin(heading), y + side * math.cos(heading))
    heading += turn
    end = (centre[0] + side * math.sin(heading), centre[1] - side * math.cos(heading))
    program.arc(end, centre, ccw, z=depth, feed=FEED)
    return heading
