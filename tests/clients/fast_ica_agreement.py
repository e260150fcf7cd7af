#!/usr/bin/python3
"""scikit-learn's FastICA finds what Kinegraph's finds, for every nonlinearity and method.

    /usr/bin/python3 tests/clients/fast_ica_agreement.py FAST_ICA_SIGNALS

What fast_ica_test.cpp compares with is what this machine's scikit-learn finds; and on whitened channels of real
clips, from the same start with the same tolerance, the signals correlate by more than 0.999 up to order and sign
wherever both settle. scikit-learn takes whole steps only and may go round and round (Kinegraph halves its steps
then): the starts from which one of the two did not settle in a hundred rounds are named. At three components each
pair, nonlinearity and method has to agree from some start, unless scikit-learn settles from none: on 16_45 with
16_31, all together, it goes to and fro between two points for each of the nonlinearities.
Needs Debian's python3-sklearn. Clips: $KINEGRAPH_MOCAP or ../shared/mocap.
"""
import collections
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
ROUNDS = 100
STARTS = 4  # the identity, then quasi-random rotations
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
    """Every case, from every start: whether both settled, and then whether they agree."""
    clips = [MOCAP / f"cmu/asfamc/{name}.amc" for name in pair]
    agreed, failed, round_and_round = collections.defaultdict(int), [], collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        told = subprocess.run([program, folder, str(components), str(STARTS), *clips], check=True,
                              capture_output=True, text=True).stdout
        ours_unsettled = set(told.split())

        def read(name):
            return np.fromfile(f"{folder}/{name}.bin").reshape(components, -1)
        z = read("z")
        for start in range(STARTS):
            for fun, name, algorithm in METHODS:
                ica = FastICA(algorithm=algorithm, fun=fun, whiten=False, tol=1e-8, max_iter=ROUNDS,
                              w_init=read(f"start{start}"))
                theirs = ica.fit_transform(z.T).T
                file = f"{name}_{algorithm}{start}"
                case = f"{' with '.join(pair)}, {components} components, {name}, {algorithm}"
                unsettled = [who for who, it in (("scikit-learn", ica.n_iter_ >= ROUNDS),
                                                 ("Kinegraph", file in ours_unsettled)) if it]
                least = np.abs(np.corrcoef(theirs, read(file))[:components, components:]).max(axis=1).min()
                if unsettled:
                    round_and_round[case].append(f"{start} ({' and '.join(unsettled)})")
                elif least > 0.999:
                    agreed[case] += 1
                else:
                    failed.append(f"FAILED {case}, start {start}: least |correlation| {least:.6f}, "
                                  f"{ica.n_iter_} rounds")
    return agreed, failed, round_and_round


def main():
    warnings.simplefilter("ignore")  # that it did not settle is told below
    good = oracle_is_current()
    if (MOCAP / "README.md").exists():
        for components, least in ((3, 21), (5, 0)):
            cases = 0
            for pair in PAIRS:
                agreed, failed, unsettled = signals_agree(sys.argv[1], pair, components)
                for case in sorted({*agreed, *unsettled}):
                    going = f"; not settled from start {', '.join(unsettled[case])}" if case in unsettled else ""
                    print(f"{case}: agree from {agreed[case]} of {STARTS} starts{going}")
                print(*failed, sep="\n", end="\n" if failed else "")
                cases += sum(count > 0 for count in agreed.values())
                good &= not failed
            print(f"{components} components: {cases} of {len(PAIRS) * len(METHODS)} cases agree")
            good &= cases >= least
    else:
        print(f"no motion capture at {MOCAP}: real clips are left out")
    sys.exit(not good)


main()
