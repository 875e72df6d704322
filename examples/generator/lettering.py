"""The word BAHNWERK engraved with single strokes, capitals of 40 mm, and a wave below it.

The strokes are lines, arcs, and Bezier curves of degree 2 and 3: in G-code G1, G2/G3, G5.1 and G5, in DXF LINE, ARC and
SPLINE. The wave is a chain of G5 that go on without I J, in DXF one SPLINE of many spans.
"""
from .dxf import Drawing
from .gcode import Program
from .shapes import Arc, Bezier, Line, Shape, length

GAP = 8.0  # between letters
FEED = 6000
WAVES, WAVE_DEPTH, WAVE_BASE = 16, 4.0, -14.0


def quadratic(c, end):
    return Bezier((c,), end)


def cubic(c, d, end):
    return Bezier((c, d), end)


# Width and strokes, each from its start.
LETTERS = {
    "B": (24, [Shape((0, 0), [Line((0, 40)), cubic((14, 40), (20, 37), (20, 30)),
                              cubic((20, 24), (14, 21.5), (4, 21.5)), cubic((16, 21.5), (24, 18), (24, 11)),
                              cubic((24, 4), (16, 0), (0, 0))])]),
    "A": (30, [Shape((0, 0), [quadratic((10, 14), (15, 40)), quadratic((20, 14), (30, 0))]),
               Shape((7, 13), [quadratic((15, 10), (23, 13))])]),
    "H": (26, [Shape((0, 0), [Line((0, 40))]), Shape((0, 20), [cubic((9, 25), (17, 15), (26, 20))]),
               Shape((26, 40), [Line((26, 0))])]),
    "N": (26, [Shape((0, 0), [Line((0, 40)), cubic((4, 30), (22, 10), (26, 0)), Line((26, 40))])]),
    "W": (40, [Shape((0, 40), [quadratic((4, 16), (11, 0)), quadratic((17, 12), (20, 28)),
                               quadratic((23, 12), (29, 0)), quadratic((36, 16), (40, 40))])]),
    "E": (22, [Shape((22, 40), [Line((8, 40)), Arc((0, 32), (8, 32), True), Line((0, 8)), Arc((8, 0), (8, 8), True),
                                Line((22, 0))]), Shape((0, 20), [Line((17, 20))])]),
    "R": (25, [Shape((0, 0), [Line((0, 40)), Line((12, 40)), Arc((12, 20), (12, 30), False), Line((0, 20))]),
               Shape((12, 20), [cubic((18, 18), (18, 4), (25, 0))])]),
    "K": (24, [Shape((0, 0), [Line((0, 40))]), Shape((23, 40), [quadratic((10, 26), (0, 19))]),
               Shape((6, 23), [cubic((13, 20), (15, 6), (24, 0))])]),
}


def _moved(shape, x):
    def at(p):
        return (p[0] + x, float(p[1]))

    curves = []
    for curve in shape.curves:
        if isinstance(curve, Line):
            curves.append(Line(at(curve.end)))
        elif isinstance(curve, Arc):
            curves.append(Arc(at(curve.end), at(curve.centre), curve.ccw))
        else:
            curves.append(Bezier(tuple(at(p) for p in curve.inner), at(curve.end)))
    return Shape(at(shape.start), curves)


def strokes(word="BAHNWERK"):
    """All strokes in the order of writing, and the width of the word."""
    x, result = 0.0, []
    for letter in word:
        width, shapes = LETTERS[letter]
        result += [_moved(shape, x) for shape in shapes]
        x += width + GAP
    return result, x - GAP


def wave(width):
    """Up and down, with a common tangent and equal handles at every joint, as G5 without I J wants it."""
    step = width / WAVES
    curves = []
    for i in range(WAVES):
        x, side = i * step, 1 if i % 2 == 0 else -1
        rise = side * WAVE_DEPTH
        level = WAVE_BASE + rise
        curves.append(cubic((x + step / 3, level), (x + 2 * step / 3, level), (x + step, WAVE_BASE)))
    return Shape((0.0, WAVE_BASE), curves)


def gcode():
    program = Program(["BAHNWERK, CAPITALS OF 40 MM"], ["G21 G17 G90 G40 G94"], numbered=5)
    shapes, width = strokes()
    for each in [*shapes, wave(width)]:
        program.rapid(*each.start)
        program.tool(True)
        program.follow(each, feed=FEED)
        program.tool(False)
    program.rapid(0, 0)
    program.word("M2")
    return program.text(), program.cut


def dxf():
    drawing = Drawing({"LETTERS": 2, "WAVE": 4})
    shapes, width = strokes()
    for each in shapes:
        drawing.model.shape(each, "LETTERS")
    below = wave(width)
    points, knots = [below.start], [0] * 4
    for i, curve in enumerate(below.curves):
        points += [*curve.inner, curve.end]
        knots += [i + 1] * 3
    drawing.model.spline(3, points, knots + [WAVES], "WAVE")
    return drawing.text(), sum(length(each) for each in shapes) + length(below)
