#!/usr/bin/env python3
"""Derives the constants of nodes/motion/elementary.cpp (needs python3-mpmath).

Each polynomial interpolates its function at Chebyshev nodes in 60-digit arithmetic, which is within a factor of a few of
the best possible one; prints the coefficients as exact hexadecimal doubles and the largest relative error left."""
from mpmath import mp, mpf, cos, sin, atan, asin, exp, log, pi, sqrt, matrix, lu_solve, floor

mp.dps = 60


def double(x):
    return float(x)


def fit(name, function, low, high, terms, relative_to=lambda z: mpf(1)):
    low, high = mpf(low), mpf(high)
    nodes = [(low + high) / 2 + (high - low) / 2 * cos(pi * (2 * i + 1) / (2 * terms)) for i in range(terms)]
    a = matrix(terms, terms)
    b = matrix(terms, 1)
    for i, z in enumerate(nodes):
        b[i] = function(z)
        for j in range(terms):
            a[i, j] = z ** j
    c = [double(v) for v in lu_solve(a, b)]
    worst = max(abs(sum(mpf(v) * z ** j for j, v in enumerate(c)) - function(z)) * relative_to(z)
                for z in (low + (high - low) * mpf(i) / 997 for i in range(1, 998)))
    print(f"{name}: error {mp.nstr(worst, 3)} = 2^{mp.nstr(log(worst, 2), 4)}")
    print("  {" + ", ".join(v.hex() for v in c) + "}")


def split(name, value, bits):
    """Parts of `value` of the given numbers of bits each, the last one a full double."""
    parts = []
    rest = value
    for b in bits:
        e = floor(log(abs(rest), 2))
        unit = mpf(2) ** (e - b + 1)
        part = floor(rest / unit) * unit
        parts.append(double(part))
        rest -= part
    parts.append(double(rest))
    print(f"{name}: " + ", ".join(v.hex() for v in parts))


def series(function, expansion):
    """`function`, but its expansion where the closed form cancels."""
    return lambda z: expansion(z) if z < mpf(10) ** -6 else function(z)


q = (pi / 4) ** 2 * mpf("1.0001")
# sin x = x + x z S(z), cos x = 1 - z/2 + z² C(z), z = x²
fit("S", series(lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: -mpf(1) / 6 + z / 120 - z * z / 5040), 0, q, 7,
    lambda z: z)
fit("C", series(lambda z: (cos(sqrt(z)) - 1 + z / 2) / z ** 2, lambda z: mpf(1) / 24 - z / 720 + z * z / 40320), 0, q, 6,
    lambda z: z * z)
# atan x = x + x z T(z), |x| <= 7/16
fit("T", series(lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z, lambda z: -mpf(1) / 3 + z / 5 - z * z / 7), 0,
    (mpf(7) / 16) ** 2, 12, lambda z: z)
# asin x = x + x z A(z), |x| <= 1/2
fit("A", series(lambda z: (asin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: mpf(1) / 6 + 3 * z / 40 + 15 * z * z / 336), 0,
    mpf(1) / 4, 14, lambda z: z)


def exp_tail(r):
    if abs(r) < mpf(10) ** -6:
        return mpf(1) / 2 + r / 6 + r * r / 24 + r ** 3 / 120
    return (exp(r) - 1 - r) / r ** 2


# exp r = 1 + r + r² E(r), |r| <= ln 2 / 2
h = log(mpf(2)) / 2 * mpf("1.0001")
fit("E", exp_tail, -h, h, 11, lambda r: r * r)
# log((1 + s)/(1 - s)) = 2 s + s z L(z), |s| <= 3 - 2 sqrt 2; and with its first term apart: L = 2/3 + z M(z)
m = (3 - 2 * sqrt(mpf(2))) ** 2 * mpf("1.0001")


def log_tail(z):
    if z < mpf(10) ** -6:
        return mpf(2) / 3 + 2 * z / 5 + 2 * z * z / 7 + 2 * z ** 3 / 9
    s = sqrt(z)
    return (log((1 + s) / (1 - s)) / s - 2) / z


def log_tail2(z):
    if z < mpf(10) ** -6:
        return mpf(2) / 5 + 2 * z / 7 + 2 * z * z / 9 + 2 * z ** 3 / 11
    return (log_tail(z) - mpf(2) / 3) / z


fit("L", log_tail, 0, m, 8, lambda z: z)
fit("M", log_tail2, 0, m, 9, lambda z: z * z)
split("pi/2", pi / 2, [32, 32])
split("ln 2", log(mpf(2)), [32])
split("ln 2 (three)", log(mpf(2)), [32, 32])
split("2/3", mpf(2) / 3, [53])
split("pi", pi, [53])
