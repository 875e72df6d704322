"""Pockets cleared ring by ring from the outside in, as CAM programs write it: outlines of free shape, offset and cut up
into chords of 0.02 to 0.5 mm with four decimals. A ring is entered by a plunge of its own. Some 40 000 lines, 900 kB."""
import math
import random

from .gcode import Program

FEED, PLUNGE, CLEARANCE = 1500, 300, 5.0
STEP = 0.8  # between rings, mm
SIZE = 40000  # lines


def gcode(seed=1, size=SIZE):
    rng = random.Random(f"clearing {seed}")
    program = Program([f"POCKETS CLEARED IN RINGS, SEED {seed}"], ["G21 G17 G90 G40 G94"])
    program.tool(True)
    pocket, last = 0, len(program.lines) + size
    while len(program.lines) < last:
        _pocket(program, rng, (70.0 * (pocket % 6), 70.0 * (pocket // 6)), last)
        pocket += 1
    program.rapid(z=CLEARANCE)
    program.word("M2")
    return program.text()


def _pocket(program, rng, centre, last):
    radius = rng.uniform(10, 28)
    waves = [(k, rng.uniform(0, 0.25) / k, rng.uniform(0, 2 * math.pi)) for k in (2, 3, 5, 8, 13)]
    while radius > STEP and len(program.lines) < last:
        _ring(program, rng, centre, radius, waves)
        radius -= STEP


def _ring(program, rng, centre, radius, waves):
    angle = 0.0
    first = _point(centre, radius, waves, angle)
    program.rapid(z=CLEARANCE)
    program.rapid(*first)
    program.line(z=-2, feed=PLUNGE)
    while True:
        angle += rng.choice((0.02, 0.06, 0.15, 0.5)) * rng.uniform(0.8, 1.2) / radius
        if angle >= 2 * math.pi:
            break
        program.line(*_point(centre, radius, waves, angle), feed=FEED)
    program.line(*first, feed=FEED)


def _point(centre, radius, waves, angle):
    r = radius * (1 + sum(a * math.cos(k * angle + phase) for k, a, phase in waves))
    return (centre[0] + r * math.cos(angle), centre[1] + r * math.sin(angle))
