"""Involute spur gear with 24 teeth of module 2 mm, pressure angle 20 deg, bore 20 mm with a keyway 6 x 2.8 mm.

Root 1.25 modules below the pitch circle; the involutes begin at the base circle, below them the flank is radial and a
fillet of radius 0.6 mm leads to the root circle. G-code: chords of the teeth within 0.01 mm, rounded to 4 decimals;
arcs in the bore. DXF: involutes as cubic splines, all else as lines and arcs.
"""
import math

from .dxf import Drawing
from .gcode import Program
from .shapes import Arc, Line, Shape, length, polar, sweep
from .splines import through

TEETH, MODULE, PRESSURE = 24, 2.0, math.radians(20)
CENTRE = (40.0, 40.0)
PITCH = TEETH * MODULE / 2
BASE, TIP, ROOT, FILLET = PITCH * math.cos(PRESSURE), PITCH + MODULE, PITCH - 1.25 * MODULE, 0.6
HALF_BASE = math.pi / (2 * TEETH) + math.tan(PRESSURE) - PRESSURE  # half the angle of a tooth at the base circle
ROLL = math.sqrt((TIP / BASE) ** 2 - 1)  # roll angle at the tip
FILLET_ANGLE = math.asin(FILLET / (ROOT + FILLET))
SPANS = 8
CHORD_ERROR = 0.01
BORE, KEY_WIDTH, KEY_TOP = 10.0, 6.0, 12.8
FEED = 4800


def involute(roll, tooth, side):
    """Point at a roll angle; side −1: the flank that a counter-clockwise walk comes up, +1: the one it goes down."""
    angle = tooth + side * (HALF_BASE - roll + math.atan(roll))
    return polar(BASE * math.hypot(1, roll), angle, CENTRE)


def flank(tooth, side):
    """As a cubic spline, upwards. Its points are even in the roll angle: denser where the curvature is larger."""
    points = [involute(ROLL * i / SPANS, tooth, side) for i in range(SPANS + 1)]
    start = tooth + side * HALF_BASE
    last = start - side * ROLL
    return through(points, (math.cos(start), math.sin(start)), (math.cos(last), math.sin(last)))


def up(tooth):
    """From the root arc to where the involute begins: fillet and radial line."""
    angle = tooth - HALF_BASE
    fillet = polar(ROOT + FILLET, angle - FILLET_ANGLE, CENTRE)
    reach = (ROOT + FILLET) * math.cos(FILLET_ANGLE)
    begin = polar(ROOT, angle - FILLET_ANGLE, CENTRE)
    return Shape(begin, [Arc(polar(reach, angle, CENTRE), fillet, False), Line(polar(BASE, angle, CENTRE))])


def down(tooth):
    """From the foot of the involute over radial line, fillet and root arc to the next tooth."""
    angle = tooth + HALF_BASE
    fillet = polar(ROOT + FILLET, angle + FILLET_ANGLE, CENTRE)
    reach = (ROOT + FILLET) * math.cos(FILLET_ANGLE)
    low, after = polar(ROOT, angle + FILLET_ANGLE, CENTRE), up(tooth + 2 * math.pi / TEETH).start
    curves = [Line(polar(reach, angle, CENTRE)), Arc(low, fillet, False), Arc(after, CENTRE, True)]
    return Shape(polar(BASE, angle, CENTRE), curves)


def tip(tooth):
    half = HALF_BASE - ROLL + math.atan(ROLL)
    return Shape(polar(TIP, tooth - half, CENTRE), [Arc(polar(TIP, tooth + half, CENTRE), CENTRE, True)])


def bore():
    """From the right corner of the keyway counter-clockwise."""
    (x, y), half = CENTRE, KEY_WIDTH / 2
    level = y + math.sqrt(BORE**2 - half**2)
    curves = [Line((x + half, y + KEY_TOP)), Line((x - half, y + KEY_TOP)), Line((x - half, level))]
    return Shape((x + half, level), curves + [Arc((x + half, level), CENTRE, True)])


def arc_chords(start, arc):
    """Ends of equal chords of an arc."""
    radius = math.dist(start, arc.centre)
    first = math.atan2(start[1] - arc.centre[1], start[0] - arc.centre[0])
    turn = sweep(start, arc)
    count = math.ceil(abs(turn) / (2 * math.acos(1 - CHORD_ERROR / radius)))
    return [polar(radius, first + turn * i / count, arc.centre) for i in range(1, count + 1)]


def involute_rolls():
    """Roll angles of chords with equal error: with the radius of curvature BASE · roll their density is as its root."""
    count = math.ceil(2 / 3 * ROLL**1.5 * math.sqrt(BASE / (8 * CHORD_ERROR)))
    return [ROLL * (i / count) ** (2 / 3) for i in range(count + 1)]


def tooth_chords(tooth):
    """Ends of all chords of a tooth and of the gap behind it."""
    rolls = involute_rolls()
    points = []
    rising, falling = [involute(r, tooth, -1) for r in rolls[1:]], [involute(r, tooth, 1) for r in rolls[-2::-1]]
    for piece in (up(tooth), rising, tip(tooth), falling, down(tooth)):
        if isinstance(piece, list):
            points += piece
            continue
        for start, curve in piece.pieces():
            points += arc_chords(start, curve) if isinstance(curve, Arc) else [curve.end]
    return points


def gcode():
    program = Program(
        [f"SPUR GEAR Z{TEETH} M{MODULE:g} ALPHA 20", f"CHORD ERROR {CHORD_ERROR:g}"], ["G21 G17 G90 G40 G94"]
    )
    keyway = bore()
    program.comment("BORE WITH KEYWAY")
    program.rapid(*keyway.start)
    program.tool(True)
    program.follow(keyway, feed=FEED)
    program.tool(False)
    program.comment("TEETH")
    program.rapid(*up(0.0).start)
    program.tool(True)
    for i in range(TEETH):
        for point in tooth_chords(2 * math.pi * i / TEETH):
            program.line(*point, feed=FEED)
    program.tool(False)
    program.word("M30")
    return program.text(), program.cut


def dxf():
    drawing = Drawing({"GEAR": 5, "BORE": 1})
    model = drawing.model
    model.shape(bore(), "BORE")
    for i in range(TEETH):
        tooth = 2 * math.pi * i / TEETH
        model.shape(up(tooth), "GEAR")
        for side in (-1, 1):
            spline = flank(tooth, side)
            model.spline(3, spline.control_points(), spline.knots(), "GEAR")
        model.shape(tip(tooth), "GEAR")
        model.shape(down(tooth), "GEAR")
    each = length(up(0.0)) + length(tip(0.0)) + length(down(0.0)) + BASE * ROLL**2  # both involutes: roll² BASE / 2
    return drawing.text(), length(bore()) + TEETH * each
