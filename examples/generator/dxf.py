"""Writes drawings in DXF, release 2000 (AC1015), in mm, with the tables that strict readers ask for.

Each value is a pair of lines, group code and value [Autodesk: DXF Reference].
"""
import math

from .shapes import Arc, Line, sweep
from .text import number

DECIMALS = 9
MODEL, PAPER = "*Model_Space", "*Paper_Space"


class Tags:
    """A run of tags; entities written into it belong to the block with the handle `owner`."""

    def __init__(self, drawing, owner):
        self.drawing, self.owner, self.lines = drawing, owner, []

    def tag(self, *pairs):
        for code, value in zip(pairs[::2], pairs[1::2]):
            self.lines.append(f"{code:3d}")
            self.lines.append(number(value, DECIMALS) if isinstance(value, float) else str(value))

    def point(self, code, at):
        self.tag(code, float(at[0]), code + 10, float(at[1]), code + 20, 0.0)

    def entity(self, kind, layer, marker):
        self.tag(0, kind, 5, self.drawing.handle(), 330, self.owner, 100, "AcDbEntity", 8, layer, 100, marker)

    def line(self, a, b, layer):
        self.entity("LINE", layer, "AcDbLine")
        self.point(10, a)
        self.point(11, b)

    def circle(self, centre, radius, layer):
        self.entity("CIRCLE", layer, "AcDbCircle")
        self.point(10, centre)
        self.tag(40, float(radius))

    def arc(self, start, arc, layer):
        """Always counter-clockwise, angles in deg."""
        first, last = (start, arc.end) if arc.ccw else (arc.end, start)
        self.entity("ARC", layer, "AcDbCircle")
        self.point(10, arc.centre)
        self.tag(40, math.dist(start, arc.centre), 100, "AcDbArc")
        self.tag(50, _degrees(first, arc.centre), 51, _degrees(last, arc.centre))

    def spline(self, degree, points, knots, layer):
        self.entity("SPLINE", layer, "AcDbSpline")
        self.tag(210, 0.0, 220, 0.0, 230, 1.0)
        self.tag(70, 8, 71, degree, 72, len(knots), 73, len(points), 74, 0, 42, 1e-9, 43, 1e-9)
        for knot in knots:
            self.tag(40, float(knot))
        for each in points:
            self.point(10, each)

    def polyline(self, shape, layer, closed):
        """LWPOLYLINE of lines and arcs; the bulge is tan(sweep / 4)."""
        self.entity("LWPOLYLINE", layer, "AcDbPolyline")
        pieces = list(shape.pieces())
        self.tag(90, len(pieces) + (0 if closed else 1), 70, 1 if closed else 0, 43, 0.0)
        for start, curve in pieces:
            self.tag(10, float(start[0]), 20, float(start[1]))
            if isinstance(curve, Arc):
                self.tag(42, math.tan(sweep(start, curve) / 4))
        if not closed:
            self.tag(10, float(pieces[-1][1].end[0]), 20, float(pieces[-1][1].end[1]))

    def text(self, at, height, text, layer):
        self.entity("TEXT", layer, "AcDbText")
        self.point(10, at)
        self.tag(40, float(height), 1, text, 100, "AcDbText")

    def insert(self, block, at, layer, columns=1, rows=1, spacing=(0.0, 0.0)):
        self.entity("INSERT", layer, "AcDbBlockReference")
        self.tag(2, block)
        self.point(10, at)
        self.tag(70, columns, 71, rows, 44, float(spacing[0]), 45, float(spacing[1]))

    def shape(self, shape, layer):
        """Every curve as an entity of its own."""
        for start, curve in shape.pieces():
            if isinstance(curve, Line):
                self.line(start, curve.end, layer)
            elif isinstance(curve, Arc) and curve.end == start:
                self.circle(curve.centre, math.dist(start, curve.centre), layer)
            elif isinstance(curve, Arc):
                self.arc(start, curve, layer)
            else:
                controls = [start, *curve.inner, curve.end]
                self.spline(len(controls) - 1, controls, [0] * len(controls) + [1] * len(controls), layer)


def _degrees(point, centre):
    return math.degrees(math.atan2(point[1] - centre[1], point[0] - centre[0])) % 360.0


class Drawing:
    def __init__(self, layers, frozen=()):
        """`layers`: name → colour number."""
        self.last = 0xF
        self.layers, self.frozen = layers, frozen
        self.tables = {name: self.handle() for name in ("LTYPE", "LAYER", "STYLE", "APPID", "BLOCK_RECORD")}
        self.records = {}
        self.blocks = {}
        for name in (MODEL, PAPER):
            self.block(name)
        self.model = self.blocks[MODEL]

    def handle(self):
        self.last += 1
        return f"{self.last:X}"

    def block(self, name):
        """A new block; what is written into the result is inside."""
        self.records[name] = self.handle()
        self.blocks[name] = Tags(self, self.records[name])
        return self.blocks[name]

    def text(self):
        tables, blocks, objects = self._tables(), self._blocks(), self._objects()
        head = Tags(self, "0")
        head.tag(0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1015", 9, "$INSUNITS", 70, 4)
        head.tag(9, "$MEASUREMENT", 70, 1, 9, "$HANDSEED", 5, f"{self.last + 1:X}", 0, "ENDSEC")
        lines = head.lines + tables.lines + blocks.lines
        for each in (["  0", "SECTION", "  2", "ENTITIES"], self.model.lines, ["  0", "ENDSEC"], objects.lines):
            lines += each
        return "\n".join(lines + ["  0", "EOF"]) + "\n"

    def _record(self, tags, table, marker, name, handle=None):
        tags.tag(0, table, 5, handle or self.handle(), 330, self.tables[table])
        tags.tag(100, "AcDbSymbolTableRecord", 100, marker, 2, name)

    def _tables(self):
        tags = Tags(self, "0")
        tags.tag(0, "SECTION", 2, "TABLES")
        contents = {
            "LTYPE": ["ByBlock", "ByLayer", "Continuous"],
            "LAYER": ["0", *self.layers],
            "STYLE": ["Standard"],
            "APPID": ["ACAD"],
            "BLOCK_RECORD": list(self.records),
        }
        for table, names in contents.items():
            tags.tag(0, "TABLE", 2, table, 5, self.tables[table], 330, "0", 100, "AcDbSymbolTable", 70, len(names))
            for name in names:
                self._entry(tags, table, name)
            tags.tag(0, "ENDTAB")
        tags.tag(0, "ENDSEC")
        return tags

    def _entry(self, tags, table, name):
        if table == "LTYPE":
            self._record(tags, table, "AcDbLinetypeTableRecord", name)
            tags.tag(70, 0, 3, "", 72, 65, 73, 0, 40, 0.0)
        elif table == "LAYER":
            self._record(tags, table, "AcDbLayerTableRecord", name)
            tags.tag(70, 1 if name in self.frozen else 0, 62, self.layers.get(name, 7), 6, "Continuous")
        elif table == "STYLE":
            self._record(tags, table, "AcDbTextStyleTableRecord", name)
            tags.tag(70, 0, 40, 0.0, 41, 1.0, 50, 0.0, 71, 0, 42, 2.5, 3, "txt", 4, "")
        elif table == "APPID":
            self._record(tags, table, "AcDbRegAppTableRecord", name)
            tags.tag(70, 0)
        else:
            self._record(tags, table, "AcDbBlockTableRecord", name, self.records[name])

    def _blocks(self):
        tags = Tags(self, "0")
        tags.tag(0, "SECTION", 2, "BLOCKS")
        for name, inside in self.blocks.items():
            record = self.records[name]
            tags.tag(0, "BLOCK", 5, self.handle(), 330, record, 100, "AcDbEntity", 8, "0", 100, "AcDbBlockBegin")
            tags.tag(2, name, 70, 0)
            tags.point(10, (0, 0))
            tags.tag(3, name, 1, "")
            if inside is not self.model:
                tags.lines += inside.lines
            tags.tag(0, "ENDBLK", 5, self.handle(), 330, record, 100, "AcDbEntity", 8, "0", 100, "AcDbBlockEnd")
        tags.tag(0, "ENDSEC")
        return tags

    def _objects(self):
        tags, root, group = Tags(self, "0"), self.handle(), self.handle()
        tags.tag(0, "SECTION", 2, "OBJECTS")
        tags.tag(0, "DICTIONARY", 5, root, 330, "0", 100, "AcDbDictionary", 281, 1, 3, "ACAD_GROUP", 350, group)
        tags.tag(0, "DICTIONARY", 5, group, 330, root, 100, "AcDbDictionary", 281, 1)
        tags.tag(0, "ENDSEC")
        return tags
