#!/usr/bin/python3
"""scikit-learn's FastICA finds what Kinegraph's finds, for every nonlinearity and method.

    /usr/bin/python3 tests/clients/fast_ica_agreement.py FAST_ICA_SIGNALS

What fast_ica_test.cpp compares with is what this machine's scikit-learn finds; and on whitened channels of real
clips, from the same start with the same tolerance, the signals correlate by more than 0.999 up to order and sign.
Needs Debian's python3-sklearn. Clips: $KINEGRAPH_MOCAP or ../shared/mocap.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import warnings

import numpy as np
from sklearn.decomposition import FastICA

import fast_ica_oracle

HOME = pathlib.Path(__file__).resolve().parents[2]
ORACLE = HOME / "tests/nodes/components/fast_ica_oracle.inc"
MOCAP = pathlib.Path(os.environ.get("KINEGRAPH_MOCAP", HOME / "../shared/mocap"))
ROUNDS = 2000
PAIRS = [("16_31", "17_03"), ("07_05", "17_03"), ("16_45", "17_03"), ("16_45", "16_31")]
METHODS = [(fun, name, algorithm) for fun, name in (("logcosh", "logcosh"), ("cube", "pow3"), ("exp", "gauss"))
           for algorithm in ("parallel", "deflation")]


def numbers(text):
    return np.array([float(n) for n in re.findall(r"-?\d+\.\d+(?:e-?\d+)?", text)])


def oracle_is_current():
    kept = [line for line in ORACLE.read_text().splitlines() if line.startswith("{")]
    found = list(fast_ica_oracle.lines())
    worst = max(np.abs(numbers(a) - numbers(b)).max() for a, b in zip(kept, found, strict=True))
    print(f"fast_ica_oracle.inc: {len(kept)} results, at most {worst:.1e} from this machine's")
    return worst < 1e-6


def signals_agree(program, pair, components):
    clips = [MOCAP / f"cmu/asfamc/{name}.amc" for name in pair]
    verdicts = []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, folder, str(components), *clips], check=True)
        def read(name):
            return np.fromfile(f"{folder}/{name}.bin").reshape(components, -1)
        z = read("z")
        for fun, name, algorithm in METHODS:
            ica = FastICA(algorithm=algorithm, fun=fun, whiten=False, tol=1e-8, max_iter=ROUNDS,
                          w_init=np.eye(components))
            theirs = ica.fit_transform(z.T).T
            ours = read(f"{name}_{algorithm}")
            least = np.abs(np.corrcoef(theirs, ours)[:components, components:]).max(axis=1).min()
            settled = ica.n_iter_ < ROUNDS
            verdict = "ok    " if least > 0.999 else "FAILED" if settled else "round "
            verdicts.append(verdict)
            print(f"{verdict} {' with '.join(pair)}, {components} components, {name}, {algorithm}: "
                  f"least |correlation| {least:.6f}{'' if settled else ', scikit-learn did not settle'}")
    return verdicts


def main():
    warnings.simplefilter("ignore")  # that it did not settle is told below
    good = oracle_is_current()
    if (MOCAP / "README.md").exists():
        verdicts = [verdict for pair in PAIRS for verdict in signals_agree(sys.argv[1], pair, 3)]
        good &= "FAILED" not in verdicts and verdicts.count("ok    ") >= 18
    else:
        print(f"no motion capture at {MOCAP}: real clips are left out")
    sys.exit(not good)


main()
