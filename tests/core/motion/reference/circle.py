#!/usr/bin/env python3
"""Independent fine computation of the time optimum: a full circle between two lines, two axes, acceleration-limited.

It uses the kinetic energy of each axis: d(v_k^2) = 2 a_k dx_k, so between two stations |v_k2^2 - v_k1^2| <= 2 A_k |x_k2 - x_k1| where x_k is
monotone, without any discretisation error. The largest speeds that satisfy these conditions at n stations converge with n^-2 to the
optimum; two grids are extrapolated. Run: python3 circle.py > circle.csv
"""
import math


def optimum(radius, run_in, V, A, feed, n):
    """Duration, s. Lines of `run_in` mm along +x before and after a counter-clockwise circle of n cells (n divisible by 4)."""
    pieces = [[(0.0, 0.0, 1.0, 0.0, 0.0), (run_in, 0.0, 1.0, 0.0, 0.0)]]  # a line is one cell
    circle = []
    for i in range(n + 1):
        w = 2 * math.pi * i / n
        tx, ty = math.cos(w), math.sin(w)
        if (4 * i) % n == 0:  # exact zeros at the quarter points
            tx, ty = float(round(tx)), float(round(ty))
        circle.append((run_in + radius * ty, radius * (1 - tx), tx, ty, 1 / radius))
    pieces.append(circle)
    pieces.append([(run_in, 0.0, 1.0, 0.0, 0.0), (2 * run_in, 0.0, 1.0, 0.0, 0.0)])

    cells = []
    length = {0: run_in, 1: 2 * math.pi * radius / n, 2: run_in}
    for j, piece in enumerate(pieces):
        for l, r in zip(piece, piece[1:]):
            cells.append((l, r, length[j]))

    def cap(st):
        x, y, tx, ty, k = st
        b = feed * feed if feed else math.inf
        for t in (tx, ty):
            if t:
                b = min(b, (V / t) ** 2)
        if k:  # some a with |h'' b + h' a| <= A on both axes exists
            b = min(b, A * (abs(tx) + abs(ty)) / k)
            if tx == 0 or ty == 0:
                b = min(b, A / k)
        return b

    count = len(cells)
    U = [math.inf] * (count + 1)
    for c, (l, r, d) in enumerate(cells):
        U[c] = min(U[c], cap(l))
        U[c + 1] = min(U[c + 1], cap(r))
    U[0] = U[count] = 0.0

    def step(b, p1, p2, l, r):
        """Largest v^2 at the other end: p are the squared tangent components there and here."""
        best = math.inf
        for k in (0, 1):
            if p2[k] > 0:
                best = min(best, (p1[k] * b + 2 * A * abs(r[k] - l[k])) / p2[k])
        return best

    for sweep in range(3):
        for c, (l, r, d) in enumerate(cells):
            U[c + 1] = min(U[c + 1], step(U[c], (l[2] ** 2, l[3] ** 2), (r[2] ** 2, r[3] ** 2), l, r))
        for c in range(count - 1, -1, -1):
            l, r, d = cells[c]
            U[c] = min(U[c], step(U[c + 1], (r[2] ** 2, r[3] ** 2), (l[2] ** 2, l[3] ** 2), l, r))

    def line_time(b1, b2, d, most):
        """Accelerate, hold, brake."""
        peak = min(most, (b1 + b2) / 2 + A * d)
        v1, v2, v = math.sqrt(b1), math.sqrt(b2), math.sqrt(peak)
        return (v - v1) / A + (v - v2) / A + (d - (peak - b1) / (2 * A) - (peak - b2) / (2 * A)) / v

    time = 0.0
    for c, (l, r, d) in enumerate(cells):
        time += 2 * d / (math.sqrt(U[c]) + math.sqrt(U[c + 1])) if l[4] else line_time(U[c], U[c + 1], d, cap(l))
    return time


if __name__ == "__main__":
    print("radius,run_in,velocity,acceleration,feed,duration,difference_of_grids")
    for radius, run_in, V, A, feed in [(10, 100, 1800, 16000, 0), (10, 100, 1800, 16000, 400), (10, 100, 1800, 16000, 250), (10, 100, 1800, 16000, 440)]:
        coarse, fine = optimum(radius, run_in, V, A, feed, 100000), optimum(radius, run_in, V, A, feed, 200000)
        print(f"{radius},{run_in},{V},{A},{feed},{fine + (fine - coarse) / 3:.12f},{abs(fine - coarse):.1e}")
