"""Trains the classifier on drawn sessions: python -m peers.train --out MODEL --count N --seed S [--omni-gap PATH]"""

import argparse
import sys
import time
from pathlib import Path

from peers.command import UNUSABLE, one_thread

one_thread()

import joblib  # noqa: E402
import numpy as np  # noqa: E402

from peers.catalogue import catalogue  # noqa: E402
from peers.design import Design  # noqa: E402
from peers.draw import drawn, learnable  # noqa: E402
from peers.features import features  # noqa: E402
from peers.learned import learned  # noqa: E402
from peers.mistakes import Mistake, Refused  # noqa: E402
from peers.tool import Tool  # noqa: E402

# Fewer sessions than these hardly hold two of a cause.
LEAST = 30


def examples(tool, count, seed):
    """Features and labels of so many sessions; those that the plant would not record are left out."""
    causes = learnable(catalogue(tool))
    found, labels = [], []
    for k in range(count):
        try:
            made = drawn(tool, causes, [seed, k])
            found.append(features(Design.of(tool, made.session), made.session.robot).values)
        except Refused as refused:
            print(f"session {k} left out: {refused}", file=sys.stderr)
            continue
        labels.append(made.label)
    names = sorted({name for values in found for name in values})
    table = np.array([[values.get(name, np.nan) for name in names] for values in found])
    return table, labels, names


def main(words=None):
    """Trains and leaves the model's file."""
    parser = argparse.ArgumentParser(prog="python -m peers.train")
    parser.add_argument("--out", type=Path, required=True, metavar="MODEL", help="the file to leave")
    parser.add_argument("--count", type=int, default=3000, metavar="N", help="sessions to learn from")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="the same seed draws the same sessions")
    parser.add_argument("--omni-gap", type=Path, metavar="PATH", help="the program; without it the one of this tree")
    asked = parser.parse_args(words)
    begun = time.perf_counter()
    try:
        if asked.count < LEAST:
            raise Mistake(f"--count {asked.count}: at least {LEAST} sessions are needed")
        with Tool.found(asked.omni_gap) as tool:
            table, labels, names = examples(tool, asked.count, asked.seed)
        recorded = time.perf_counter() - begun
        model = learned(table, labels, names, asked.seed)
        asked.out.parent.mkdir(parents=True, exist_ok=True)
        half = asked.out.with_name(f".{asked.out.name}.half")
        joblib.dump(model, half)
        half.replace(asked.out)
    except Mistake as mistake:
        print(f"train: {mistake}", file=sys.stderr)
        return UNUSABLE
    seconds = time.perf_counter() - begun
    print(f"{len(labels)} sessions in {recorded:.0f} s, trained in {seconds - recorded:.0f} s, threshold {model.threshold:.3f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
