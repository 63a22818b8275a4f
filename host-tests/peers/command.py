"""What all contestants share as commands: the arguments, the report that is left, one clear message where it goes wrong."""

import argparse
import os
import sys
import time
from pathlib import Path

from peers.mistakes import Mistake
from peers.report import write
from peers.session import Session
from peers.tool import Tool

UNUSABLE = 2


def arguments(name, options=()):
    """The parser of a contestant; `options` are pairs of a flag and what argparse takes for it."""
    parser = argparse.ArgumentParser(prog=f"python -m peers.{name}")
    parser.add_argument("session", type=Path, metavar="SESSION_FOLDER", help="robot.toml and runs/*.csv")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where report.json is left")
    parser.add_argument("--omni-gap", type=Path, metavar="PATH", help="the program; without it the one of this tree")
    for flag, how in options:
        parser.add_argument(flag, **how)
    return parser


def one_thread():
    """Keeps linear algebra from spreading over cores: the matrices are small. To be called before NumPy is imported."""
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")


def run(name, answer, options=(), words=None):
    """Runs a contestant: `answer(session, tool, asked)` gives an Answer. Returns the exit code."""
    asked = arguments(name, options).parse_args(words)
    begun = time.perf_counter()
    try:
        session = Session.read(asked.session)
        with Tool.found(asked.omni_gap) as tool:
            given = answer(session, tool, asked)
        report = write(asked.out, session, name, given, time.perf_counter() - begun)
    except Mistake as mistake:
        print(f"{name}: {mistake}", file=sys.stderr)
        return UNUSABLE
    best = max(report["which"], key=lambda one: one["probability"])
    print(f"{report['verdict']}: {best['cause']} {best['probability']:.3f}; {report['engine']['seconds']:.1f} s")
    return 0
