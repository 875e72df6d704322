"""Angle bracket of 140 x 110 mm: holes, bore, slot, window, rounded outline.

G-code: cut by laser, holes with a lead-in of half a circle from their centre, the outline last with a straight lead-in.
DXF: holes as CIRCLE, the slot as loose LINE and ARC, window and outline as LWPOLYLINE with bulges; text, and a bend
line on a frozen layer.
"""
from .dxf import Drawing
from .gcode import Program
from .shapes import circle, length, rounded_polygon, slot

HOLES = [((15.0, 95.0), 4.5), ((40.0, 95.0), 4.5), ((105.0, 12.0), 4.5), ((126.0, 33.0), 4.5), ((28.0, 28.0), 11.0)]
SLOT = ((88.0, 28.0), 22.0, 4.5)
WINDOW = [(12.0, 55.0, 5.0), (43.0, 55.0, 5.0), (43.0, 80.0, 5.0), (12.0, 80.0, 5.0)]
OUTLINE = [(0.0, 0.0, 8.0), (140.0, 0.0, 8.0), (140.0, 45.0, 8.0)]
OUTLINE += [(55.0, 45.0, 12.0), (55.0, 110.0, 8.0), (0.0, 110.0, 8.0)]
LEAD = 4.0
FEED_HOLE, FEED_OUTLINE = 9000, 15000


def gcode():
    program = Program(["BRACKET 140 X 110", "STEEL 3 MM, LASER"], ["G21 G17 G90 G40 G94", "G54"], numbered=10)
    for centre, radius in HOLES:
        program.comment(f"HOLE D{2 * radius:g}")
        rim = circle(centre, radius)
        program.rapid(*centre)
        program.tool(True)
        program.arc(rim.start, (centre[0] + radius / 2, centre[1]), True, feed=FEED_HOLE)
        program.follow(rim)
        program.tool(False)
    program.comment("SLOT AND WINDOW")
    for shape in (slot(*SLOT), rounded_polygon(WINDOW)):
        _straight_lead(program, shape, FEED_HOLE, inside=True)
    program.comment("OUTLINE")
    _straight_lead(program, rounded_polygon(OUTLINE), FEED_OUTLINE, inside=False)
    program.rapid(0, 0)
    program.word("M30")
    return program.text(), program.cut


def _straight_lead(program, shape, feed, inside):
    """All shapes begin with a line in +x, the material is below it inside and above it outside."""
    (x, y), side = shape.start, 1 if inside else -1
    program.rapid(x + LEAD, y + side * LEAD)
    program.tool(True)
    program.line(x, y, feed=feed)
    program.follow(shape)
    program.tool(False)


def dxf():
    drawing = Drawing({"OUTLINE": 7, "HOLES": 1, "BEND": 3, "NOTES": 8}, frozen=("BEND",))
    model = drawing.model
    total = 0.0
    for centre, radius in HOLES:
        model.circle(centre, radius, "HOLES")
        total += length(circle(centre, radius))
    model.shape(slot(*SLOT), "HOLES")
    for corners, layer in ((WINDOW, "HOLES"), (OUTLINE, "OUTLINE")):
        model.polyline(rounded_polygon(corners), layer, closed=True)
        total += length(rounded_polygon(corners))
    model.line((0.0, 45.0), (55.0, 45.0), "BEND")
    model.text((60.0, 100.0), 5.0, "BRACKET 140 X 110 X 3", "NOTES")
    return drawing.text(), total + length(slot(*SLOT))
