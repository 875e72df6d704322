"""Perforated sheet of 440 x 310 mm: 40 x 25 holes of 5 mm in a square pitch of 10 mm, 12 slots along two edges.

G-code: every hole a full circle, G2 and G3 in turn by row, rows in serpentine order. DXF: one hole in a block, a tile
of 8 x 5 of them in a second block, the tile inserted 5 x 5 times; the slots as an array of a third block.
"""
from .dxf import Drawing
from .gcode import Program
from .shapes import circle, length, rounded_polygon, slot

COLUMNS, ROWS, PITCH, RADIUS = 40, 25, 10.0, 2.5
TILE = (8, 5)
FIRST = (25.0, 35.0)  # centre of the first hole
SLOTS, SLOT_PITCH, SLOT_ROWS, SLOT_LENGTH, SLOT_RADIUS = 6, 70.0, (12.0, 298.0), 16.0, 3.0
FIRST_SLOT = 45.0
OUTLINE = [(0.0, 0.0, 10.0), (440.0, 0.0, 10.0), (440.0, 310.0, 10.0), (0.0, 310.0, 10.0)]
FEED = 12000


def slots():
    return [slot((FIRST_SLOT + i * SLOT_PITCH, y), SLOT_LENGTH, SLOT_RADIUS) for y in SLOT_ROWS for i in range(SLOTS)]


def gcode():
    program = Program([f"PERFORATED SHEET {COLUMNS} X {ROWS} D{2 * RADIUS:g}"], ["G21 G17 G90 G40 G94"], numbered=1)
    for row in range(ROWS):
        forward = row % 2 == 0
        for i in range(COLUMNS):
            column = i if forward else COLUMNS - 1 - i
            centre = (FIRST[0] + column * PITCH, FIRST[1] + row * PITCH)
            _cut_out(program, circle(centre, RADIUS, ccw=forward))
    program.comment("SLOTS")
    for each in slots():
        _cut_out(program, each)
    program.comment("OUTLINE")
    _cut_out(program, rounded_polygon(OUTLINE))
    program.word("M30")
    return program.text(), program.cut


def _cut_out(program, shape):
    program.rapid(*shape.start)
    program.tool(True)
    program.follow(shape, feed=FEED)
    program.tool(False)


def dxf():
    drawing = Drawing({"HOLES": 1, "SLOTS": 2, "OUTLINE": 7})
    drawing.block("HOLE").circle((0.0, 0.0), RADIUS, "0")
    drawing.block("TILE").insert("HOLE", (0.0, 0.0), "0", *TILE, (PITCH, PITCH))
    drawing.block("SLOT").shape(slot((0.0, 0.0), SLOT_LENGTH, SLOT_RADIUS), "0")
    spacing = (TILE[0] * PITCH, TILE[1] * PITCH)
    drawing.model.insert("TILE", FIRST, "HOLES", COLUMNS // TILE[0], ROWS // TILE[1], spacing)
    spacing = (SLOT_PITCH, SLOT_ROWS[1] - SLOT_ROWS[0])
    drawing.model.insert("SLOT", (FIRST_SLOT, SLOT_ROWS[0]), "SLOTS", SLOTS, 2, spacing)
    drawing.model.polyline(rounded_polygon(OUTLINE), "OUTLINE", closed=True)
    total = COLUMNS * ROWS * length(circle((0.0, 0.0), RADIUS)) + sum(length(each) for each in slots())
    return drawing.text(), total + length(rounded_polygon(OUTLINE))
