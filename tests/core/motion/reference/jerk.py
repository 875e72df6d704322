#!/usr/bin/env python3
"""Independent direct computation of time-optimal motions under velocity, acceleration and jerk limits of two axes.

Formulation in time, not along the path, and by the curve's own parameter u, not by arc length: with w(tau) = u(tau T), w''' is constant on
each of n even intervals of [0, 1]. Required at the ends and the middle of each interval, with x = x(w):
    |x' w'| <= V T,  |x'' w'^2 + x' w''| <= A T^2,  |x''' w'^3 + 3 x'' w' w'' + x' w'''| <= J T^3,  w' >= 0,
w = 0 and w = 1 at the ends, w' = w'' = 0 there. T is minimised by a sequence of linear programs (HiGHS) with a trust region on w'''.
Run: python3 jerk.py > jerk.csv   (numpy, scipy; a few minutes)
"""
import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csr_matrix

PROBLEMS = [  # x coefficients, y coefficients (power basis), V, A, J per axis
    ([0, 30, 10, -20], [0, 5, 40, -25], (500, 500), (5000, 5000), (2e5, 2e5)),
    ([0, 30, 10, -20], [0, 5, 40, -25], (500, 300), (5000, 2000), (2e5, 5e4)),
    ([0, 30, 10, -20], [0, 5, 40, -25], (150, 150), (5000, 5000), (2e6, 2e6)),
    ([0, 60, -150, 100], [0, 50, -20, 10], (1000, 1000), (8000, 8000), (4e5, 4e5)),
    ([0, 60, -150, 100], [0, 50, -20, 10], (1000, 1000), (8000, 8000), (4e6, 4e6)),
    ([0, 2, 1, -1], [0, 1, -3, 2.5], (500, 500), (5000, 5000), (5e5, 5e5)),
    ([0, 100, 0, 0], [0, 20, -60, 45], (800, 800), (10000, 3000), (3e5, 9e5)),
    ([0, 10, 0, 5], [0, 40, -70, 35], (400, 400), (4000, 6000), (1e5, 1e5)),
    ([0, 80, -200, 160, 0, 10], [0, 10, 60, -100, 60, 5], (900, 900), (12000, 12000), (1e6, 1e6)),
    ([0, 15, 20, -40, 10, 12], [0, -20, 50, 10, -60, 30], (300, 500), (3000, 4000), (6e4, 1.2e5)),
]


def solve(px, py, V, A, J, n):
    curves = [np.polynomial.Polynomial(p) for p in (px, py)]
    derivatives = [[c.deriv(k) for k in range(1, 5)] for c in curves]
    h = 1.0 / n
    # w'', w', w are linear in c = w''' (n values)
    rows3, rows2, rows1, rows0 = [], [], [], []
    b2, b1, b0 = np.zeros(n), np.zeros(n), np.zeros(n)
    for i in range(n):
        e = np.zeros(n)
        e[i] = 1
        for f in (0.0, 0.5, 1.0):
            d = f * h
            rows3.append(e)
            rows2.append(b2 + d * e)
            rows1.append(b1 + d * b2 + d * d / 2 * e)
            rows0.append(b0 + d * b1 + d * d / 2 * b2 + d ** 3 / 6 * e)
        b0 = b0 + h * b1 + h * h / 2 * b2 + h ** 3 / 6 * e
        b1 = b1 + h * b2 + h * h / 2 * e
        b2 = b2 + h * e
    W3, W2, W1, W0 = (np.array(r) for r in (rows3, rows2, rows1, rows0))
    ends = np.array([b0, b1, b2])
    tau = (np.arange(n) + 0.5) * h
    c = 60 - 360 * tau + 360 * tau ** 2  # w = 10 t^3 - 15 t^4 + 6 t^5
    T = 1.0
    # a feasible T for the start
    def ratios(c):
        w, w1, w2, w3 = W0 @ c, W1 @ c, W2 @ c, W3 @ c
        r = []
        for d, v, a, j in zip(derivatives, V, A, J):
            x1, x2, x3, _ = (p(w) for p in d)
            r.append(np.max(np.abs(x1 * w1)) / v)
            r.append(np.sqrt(np.max(np.abs(x2 * w1 ** 2 + x1 * w2)) / a))
            r.append(np.cbrt(np.max(np.abs(x3 * w1 ** 3 + 3 * x2 * w1 * w2 + x1 * w3)) / j))
        return max(r)
    T = ratios(c)
    radius = 0.2 * np.max(np.abs(c))
    for _ in range(150):
        w, w1, w2, w3 = W0 @ c, W1 @ c, W2 @ c, W3 @ c
        G, g = [], []
        for d, v, a, j in zip(derivatives, V, A, J):
            x1, x2, x3, x4 = (p(w) for p in d)
            for value, parts, dT in (
                (x1 * w1 / (v * T), ((x2 * w1, W0), (x1, W1)), (v * T, 1)),
                ((x2 * w1 ** 2 + x1 * w2) / (a * T ** 2), ((x3 * w1 ** 2 + x2 * w2, W0), (2 * x2 * w1, W1), (x1, W2)), (a * T ** 2, 2)),
                ((x3 * w1 ** 3 + 3 * x2 * w1 * w2 + x1 * w3) / (j * T ** 3),
                 ((x4 * w1 ** 3 + 3 * x3 * w1 * w2 + x2 * w3, W0), (3 * x3 * w1 ** 2 + 3 * x2 * w2, W1), (3 * x2 * w1, W2), (x1, W3)), (j * T ** 3, 3)),
            ):
                D = sum(q[:, None] * M for q, M in parts) / dT[0]
                t = -dT[1] * value[:, None]  # by d ln T
                G.append(np.hstack([D, t]))
                g.append(1 - value)
                G.append(np.hstack([-D, -t]))
                g.append(1 + value)
        G.append(np.hstack([-W1, np.zeros((len(W1), 1))]))
        g.append(w1)
        G, g = np.vstack(G), np.concatenate(g)
        keep = g < 1.0  # rows that matter
        E = np.hstack([ends, np.zeros((3, 1))])
        e = np.array([1, 0, 0]) - ends @ c
        bounds = [(-radius, radius)] * n + [(-0.3, 0.3)]
        cost = np.zeros(n + 1)
        cost[-1] = 1
        res = linprog(cost, A_ub=csr_matrix(G[keep]), b_ub=np.maximum(g[keep], 0), A_eq=csr_matrix(E), b_eq=e, bounds=bounds, method="highs-ipm",
                      options={"ipm_optimality_tolerance": 1e-9})
        if res.x is None:
            radius *= 0.5
            continue
        new = c + res.x[:-1]
        need = ratios(new)  # the T that this shape needs: always feasible at the samples
        if need < T * (1 - 1e-9):
            gain = 1 - need / T
            c, T = new, need
            radius *= 1.6
            if gain < 1e-7:
                break
        else:
            radius *= 0.4
            if radius < 1e-5 * np.max(np.abs(c)):
                break
    return T


if __name__ == "__main__":
    print("# " + "x and y power basis (6 each), V A J per axis (x y), duration on n and 2 n intervals")
    for px, py, V, A, J in PROBLEMS:
        pad = lambda p: list(p) + [0] * (6 - len(p))
        T1, T2 = (solve(px, py, V, A, J, n) for n in (120, 240))
        print(",".join(f"{v:g}" for v in pad(px) + pad(py) + [*V, *A, *J]) + f",{T1:.8f},{T2:.8f}", flush=True)
