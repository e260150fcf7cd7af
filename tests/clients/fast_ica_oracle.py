#!/usr/bin/python3
"""Writes tests/nodes/components/fast_ica_oracle.inc: what scikit-learn's FastICA (Debian's python3-sklearn 1.2) finds in
the mixed sources of fast_ica_test.cpp, for every nonlinearity and method.

    /usr/bin/python3 tests/clients/fast_ica_oracle.py > tests/nodes/components/fast_ica_oracle.inc
"""
import numpy as np
from sklearn.decomposition import FastICA

FRAMES, CHANNELS, SOURCES = 600, 6, 4


def uniform_numbers(count):
    state, out = 2024, []
    for _ in range(count):
        state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
        out.append((state >> 11) / 2**53)
    return np.array(out)


def sources():
    u = uniform_numbers(7 * FRAMES).reshape(FRAMES, 7)
    s = np.empty((FRAMES, SOURCES))
    s[:, 0] = 2 * u[:, 0] - 1
    s[:, 1] = (2 * u[:, 1] - 1) ** 5
    s[:, 2] = np.where(u[:, 3] < 0.2, 2 * u[:, 2] - 1, 0)
    s[:, 3] = u[:, 4] * u[:, 5] * u[:, 6]
    return s / s.std(axis=0)


def mixing():
    return np.array([[((7 * i + 3 * j * j + i * j + 5) % 11 - 5) / 3 for j in range(SOURCES)] for i in range(CHANNELS)])


def amari(p):
    p = np.abs(p)
    n = len(p)
    rows = (p / p.max(axis=1, keepdims=True)).sum() - n
    columns = (p / p.max(axis=0, keepdims=True)).sum() - n
    return (rows + columns) / (2 * n * (n - 1))


def lines():
    s, a = sources(), mixing()
    x = s @ a.T
    for fun, name in (("logcosh", "logcosh"), ("cube", "pow3"), ("exp", "gauss")):
        for algorithm in ("parallel", "deflation"):
            ica = FastICA(n_components=SOURCES, algorithm=algorithm, fun=fun, whiten="unit-variance", tol=1e-8,
                          max_iter=2000, w_init=np.eye(SOURCES))
            ica.fit(x)
            w = ica.components_
            rows = ", ".join(repr(float(v)) for v in w.ravel())
            symmetric = "true" if algorithm == "parallel" else "false"
            yield "{Nonlinearity::%s, %s, %r, {%s}}," % (name, symmetric, float(amari(w @ a)), rows)


if __name__ == "__main__":
    print("// Written by tests/clients/fast_ica_oracle.py: nonlinearity, symmetric, Amari index, unmixing matrix.")
    print("\n".join(lines()))
