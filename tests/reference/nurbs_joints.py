#!/usr/bin/env python3
"""Evaluates an exported path independently: is it as continuous at its joints as it says, are its arcs circles?

Usage: nurbs_joints.py PATH.json [--limit 1e-8] [--circle-limit 1e-12]
PATH.json: {"degree", "points": [[x, y, z, phi, psi], …], "weights", "knots", "joints": [{"parameter", "continuity"}, …],
"circles": [{"from", "to", "centre": [x, y, z], "radius"}, …]} (circles: spans of the parameter, optional).

Shares no code with the planner. At a joint the basis functions of both spans are expanded as polynomials in exact fractions
(Cox, de Boor), the quotient and the derivatives by arc length follow in 60 decimal digits. What differs is the difference
that the exported numbers have, not the rounding of an evaluation. Jumps are relative to the largest derivative of the same
order at 33 places in each of the two spans. Exit status 1 where a joint or a circle is beyond its limit.
"""
import argparse
import json
import sys
from bisect import bisect_right
from decimal import Decimal, getcontext
from fractions import Fraction

getcontext().prec = 60
ORDER = 4


def expansions(knots, degree, span, at):
    """{i: Taylor coefficients in (u - at) of N_i on [knots[span], knots[span + 1])}, exact."""
    basis = {span: [Fraction(1)]}
    for p in range(1, degree + 1):
        following = {}
        for i in range(span - p, span + 1):
            total = [Fraction(0)] * (p + 1)
            for j, low, sign in ((i, knots[i], 1), (i + 1, knots[i + p + 1], -1)):
                if j not in basis:
                    continue
                width = knots[j + p] - knots[j]
                if width == 0:
                    continue
                # sign · (u − low)/width, as a polynomial in u − at
                constant, slope = sign * (at - low) / width, sign * Fraction(1) / width
                for n, c in enumerate(basis[j]):
                    total[n] += constant * c
                    total[n + 1] += slope * c
            following[i] = total
        basis = following
    return basis


def decimal(fraction):
    return Decimal(fraction.numerator) / Decimal(fraction.denominator)


def product(a, b):
    return [sum(a[i] * b[n - i] for i in range(n + 1)) for n in range(ORDER + 1)]


def composed(outer, inner):
    result = [Decimal(0)] * (ORDER + 1)
    for c in reversed(outer):
        result = product(result, inner)
        result[0] += c
    return result


class Path:
    def __init__(self, document):
        self.degree = document["degree"]
        self.knots = [Fraction(k) for k in document["knots"]]
        weights = [Fraction(w) for w in document["weights"]]
        self.points = [[w * Fraction(c) for c in p] + [w] for p, w in zip(document["points"], weights)]
        assert len(self.knots) == len(self.points) + self.degree + 1, "numbers of knots and points"

    def span(self, u, left):
        """The non-empty span to the right of u, or to its left."""
        if left:
            return max(k for k in range(len(self.knots) - 1) if self.knots[k] < u and self.knots[k] < self.knots[k + 1])
        return bisect_right(self.knots, u) - 1

    def series(self, u, span):
        """Taylor coefficients of the five coordinates at u in that span."""
        basis = expansions(self.knots, self.degree, span, u)
        rows = []
        for d in range(6):
            total = [Fraction(0)] * (ORDER + 1)
            for i, coefficients in basis.items():
                for n, c in enumerate(coefficients[: ORDER + 1]):
                    total[n] += c * self.points[i][d]
            rows.append([decimal(c) for c in total])
        weight, result = rows[5], []
        for row in rows[:5]:
            q = []
            for n in range(ORDER + 1):
                q.append((row[n] - sum(weight[j] * q[n - j] for j in range(1, n + 1))) / weight[0])
            result.append(q)
        return result

    def by_length(self, u, span):
        """Derivatives 0 … 4 by the arc length of the place, one list of coordinates per order."""
        series = self.series(u, span)
        square = [Decimal(0)] * (ORDER + 1)
        for d in range(3):
            slope = [(n + 1) * series[d][n + 1] for n in range(ORDER)] + [Decimal(0)]
            square = [a + b for a, b in zip(square, product(slope, slope))]
        speed = [square[0].sqrt()]
        for n in range(1, ORDER + 1):
            speed.append((square[n] - sum(speed[i] * speed[n - i] for i in range(1, n))) / (2 * speed[0]))
        length = [Decimal(0)] + [speed[n - 1] / n for n in range(1, ORDER + 1)]
        inverse = [Decimal(0), 1 / length[1]] + [Decimal(0)] * (ORDER - 1)
        for n in range(2, ORDER + 1):
            inverse[n] = -composed(length, inverse)[n] / length[1]
        derivatives, factorial = [[] for _ in range(ORDER + 1)], [1, 1, 2, 6, 24]
        for d in range(5):
            for n, c in enumerate(composed(series[d], inverse)):
                derivatives[n].append(c * factorial[n])
        return derivatives


def size(vector):
    return sum(c * c for c in vector).sqrt()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("path")
    parser.add_argument("--limit", type=float, default=1e-8)
    parser.add_argument("--circle-limit", type=float, default=1e-12)
    options = parser.parse_args()
    with open(options.path) as file:
        document = json.load(file)
    path, worst, bad = Path(document), [0.0] * (ORDER + 1), 0
    peaks = {}

    def peak(span):
        if span not in peaks:
            a, b = path.knots[span], path.knots[span + 1]
            samples = [path.by_length(a + (b - a) * i / 32, span) for i in range(33)]
            peaks[span] = [max(size(s[n]) for s in samples) for n in range(ORDER + 1)]
        return peaks[span]

    for joint in document["joints"]:
        u = Fraction(joint["parameter"])
        spans = path.span(u, True), path.span(u, False)
        before, after = path.by_length(u, spans[0]), path.by_length(u, spans[1])
        for n in range(joint["continuity"] + 1):
            scale = max(peak(spans[0])[n], peak(spans[1])[n])
            jump = float(size([a - b for a, b in zip(before[n], after[n])]) / scale) if scale else 0.0
            worst[n] = max(worst[n], jump)
            if not jump <= options.limit:
                print(f"joint at {joint['parameter']}: derivative {n} by arc length jumps by {jump:.3g}")
                bad += 1
    print("largest relative jump of the derivatives by arc length:", " ".join(f"{w:.2g}" for w in worst))
    off = 0.0
    for circle in document.get("circles", []):
        a, b = Fraction(circle["from"]), Fraction(circle["to"])
        centre = [Decimal(c) for c in circle["centre"]]
        for i in range(65):
            u = a + (b - a) * i / 64
            place = [row[0] for row in path.series(u, path.span(u, i == 64))][:3]
            distance = size([p - c for p, c in zip(place, centre)])
            off = max(off, float(abs(distance / Decimal(circle["radius"]) - 1)))
    print(f"largest relative distance from a circle: {off:.2g}")
    bad += not off <= options.circle_limit
    return 3 if bad else 0  # not what Python returns when it fails


if __name__ == "__main__":
    sys.exit(main())
