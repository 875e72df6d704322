"""Milled plate in inches: six threads 3/4-10 on a bolt circle, and a pocket with a ramp.

Thread: cutter of 0.5 in, so the helix has a radius of 0.125 in; half a circle in, six turns upwards, half a circle out.
Pocket: five laps down a ramp along its wall, a level lap, then three smaller ones; every lap rounded in the corners.
"""
import math

from .gcode import Program
from .shapes import Line, length, polar, rounded_polygon

INCH = 25.4
HOLES, BOLT_CIRCLE = 6, 2.0
PITCH, TURNS, RADIUS, DEPTH = 0.1, 6, 0.125, -0.7
CLEARANCE, RETRACT = 0.1, 1.0
POCKET, CORNER = (1.0, 0.6), 0.25  # half width and height of the centre line, radius
LAPS, LAP_DEPTH, STEP_OVER = 5, 0.05, 0.15
FEED_THREAD, FEED_PLUNGE, FEED_POCKET = 25.0, 10.0, 60.0


def gcode():
    program = Program(
        ["PLATE 6 IN, INCHES", "T1 THREAD MILL D.5, T2 END MILL D.375"],
        ["G20 G17 G40 G49 G80 G90 G94", "T1 M6", "S3000 M3"],
        numbered=10,
        unit=INCH,
    )
    program.on = True
    program.rapid(*polar(BOLT_CIRCLE, 0.0))
    program.word("G43 H1")
    program.rapid(z=RETRACT)
    for i in range(HOLES):
        program.comment(f"THREAD {i + 1}")
        _thread(program, polar(BOLT_CIRCLE, 2 * math.pi * i / HOLES))
    program.rapid(z=RETRACT)
    program.word("T2 M6")
    program.word("G43 H2")
    program.comment("POCKET")
    _pocket(program)
    program.rapid(z=RETRACT)
    program.rapid(0, 0)
    program.word("M5")
    program.word("M30")
    return program.text(), program.cut


def _thread(program, centre):
    x, y = centre
    program.rapid(x, y)
    program.rapid(z=CLEARANCE)
    program.line(z=DEPTH, feed=FEED_PLUNGE)
    z = DEPTH + PITCH / 2
    program.arc((x + RADIUS, y), (x + RADIUS / 2, y), True, z, FEED_THREAD)
    for _ in range(TURNS):
        z += PITCH
        program.arc(tuple(program.at[:2]), (x, y), True, z, FEED_THREAD)
    program.arc((x, y), (x + RADIUS / 2, y), True, z + PITCH / 2, FEED_THREAD)
    program.rapid(z=CLEARANCE)


def lap(inset):
    w, h, r = POCKET[0] - inset, POCKET[1] - inset, CORNER - inset / 2
    return rounded_polygon([(-w, -h, r), (w, -h, r), (w, h, r), (-w, h, r)])


def _pocket(program):
    wall = lap(0.0)
    program.rapid(*wall.start)
    program.rapid(z=CLEARANCE)
    program.line(z=0.0, feed=FEED_PLUNGE)
    whole, z = length(wall), 0.0
    for _ in range(LAPS):
        for start, curve in wall.pieces():
            z -= LAP_DEPTH * length(wall._replace(start=start, curves=[curve])) / whole
            _along(program, curve, z)
    for i in range(4):
        inner = lap(i * STEP_OVER)
        program.line(*inner.start, feed=FEED_POCKET)
        for _, curve in inner.pieces():
            _along(program, curve, None)


def _along(program, curve, z):
    if isinstance(curve, Line):
        program.line(*curve.end, z, feed=FEED_POCKET)
    else:
        program.arc(curve.end, curve.centre, curve.ccw, z, FEED_POCKET)
