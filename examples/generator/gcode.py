"""Writes part programs as a post-processor does: modal words, coordinates with four decimals."""
import math

from .shapes import Arc, Bezier, Line, curve_length
from .text import number

DECIMALS = 4


class Program:
    """`numbered`: step of the N words, 0 = none. `unit`: mm per unit of the program's coordinates (25.4: inches); the
    arguments of all methods are in program units."""

    def __init__(self, comments, setup, numbered=0, unit=1.0):
        self.unit, self.step, self.count = unit, numbered, 0
        self.lines = ["%"] + [f"({each})" for each in comments]
        self.at = [None, None, None]
        self.motion = None
        self.feed_rate = None
        self.on = False
        self.cut = 0.0
        for each in setup:
            self.word(each)

    def word(self, text):
        if self.step:
            self.count += self.step
            text = f"N{self.count} {text}"
        self.lines.append(text)

    def comment(self, text):
        self.lines.append(f"({text})")

    def tool(self, on):
        self.on = on
        self.word("M3" if on else "M5")

    def rapid(self, x=None, y=None, z=None):
        self._straight("G0", (x, y, z), None)

    def line(self, x=None, y=None, z=None, feed=None):
        self._straight("G1", (x, y, z), feed)

    def arc(self, end, centre, ccw, z=None, feed=None):
        """In the plane of x and y; with z a helix."""
        start, end = tuple(self.at[:2]), (_cut(end[0]), _cut(end[1]))
        flat = curve_length(start, Arc(end, centre, ccw))
        rise = 0.0 if z is None else _cut(z) - self.at[2]
        words = [*self._coordinates((*end, z), always=True)]
        words += [f"I{number(centre[0] - start[0], DECIMALS)}", f"J{number(centre[1] - start[1], DECIMALS)}"]
        self._move("G3" if ccw else "G2", words, math.hypot(flat, rise), feed)

    def bezier(self, inner, end, feed=None):
        """G5.1 for one inner control point; G5 for two, without I J where they go on as the last G5 ended."""
        start, end = tuple(self.at[:2]), (_cut(end[0]), _cut(end[1]))
        first = _offset(inner[0], start)
        distance = curve_length(start, Bezier(inner, end))
        words = self._coordinates((*end, None), always=True)
        if len(inner) == 1:
            self._move("G5.1", words + [f"I{first[0]}", f"J{first[1]}"], distance, feed)
            return
        last = _offset(inner[1], end)
        smooth = self.motion == "G5" and self.handle == tuple(_negative(each) for each in first)
        if not smooth:
            words += [f"I{first[0]}", f"J{first[1]}"]
        self._move("G5", words + [f"P{last[0]}", f"Q{last[1]}"], distance, feed)
        self.handle = last

    def follow(self, shape, feed=None):
        """Cuts a shape from its start, where the tool already is."""
        for _, curve in shape.pieces():
            if isinstance(curve, Line):
                self.line(*curve.end, feed=feed)
            elif isinstance(curve, Arc):
                self.arc(curve.end, curve.centre, curve.ccw, feed=feed)
            else:
                self.bezier(curve.inner, curve.end, feed=feed)

    def text(self):
        return "\n".join(self.lines + ["%"]) + "\n"

    def _straight(self, code, target, feed):
        before = list(self.at)
        words = self._coordinates(target)
        if not words:
            return
        moved = [(a, b) for a, b in zip(before, self.at) if a is not None]  # unknown before the first move
        distance = math.dist(*zip(*moved)) if moved else 0.0
        self._move(code, words, distance, feed)

    def _coordinates(self, target, always=False):
        words = []
        for axis, (letter, value) in enumerate(zip("XYZ", target)):
            if value is None:
                continue
            value = _cut(value)
            if always or value != self.at[axis]:
                words.append(letter + number(value, DECIMALS))
            self.at[axis] = value
        return words

    def _move(self, code, words, distance, feed):
        if code != self.motion:
            words = [code, *words]
            self.motion = code
        if feed is not None and feed != self.feed_rate:
            words.append(f"F{number(feed, 1)}")
            self.feed_rate = feed
        if self.on and code != "G0":
            self.cut += distance * self.unit
        self.word(" ".join(words))


def _cut(value):
    """As it will be read again."""
    return float(number(value, DECIMALS))


def _offset(point, origin):
    return tuple(number(a - b, DECIMALS) for a, b in zip(point, origin))


def _negative(text):
    return text if text == "0" else text[1:] if text.startswith("-") else "-" + text
