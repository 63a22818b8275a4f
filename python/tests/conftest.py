"""Sessions that the command stages, and the command itself: the program that OMNI_GAP names."""

import csv
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

PROGRAM = os.environ["OMNI_GAP"]
EXAMPLES = Path(__file__).parents[2] / "examples"
EFFECTS = '[effects.dead_time]\nvoltage_loss_V = 0.3\n\n[[effects.motor_mismatch]]\nwheel = 2\ntorque_constant_ratio = 0.9\n'


def command(*words, fails=False):
    """What the command says on standard output, or on standard error where it is to fail."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    assert (done.returncode == 2) == fails, done.stderr
    return done.stderr if fails else done.stdout


def answer(*words):
    """What the command answers with --json."""
    return json.loads(command(*words, "--json"))


@pytest.fixture(scope="session")
def demo(tmp_path_factory):
    """The folder of `omni-gap demo`: session/ and report/."""
    folder = tmp_path_factory.mktemp("demo")
    command("demo", "--out", folder)
    return folder


@pytest.fixture(scope="session")
def session(demo):
    """A session folder of a robot with four wheels and a hidden dead time."""
    return demo / "session"


@pytest.fixture(scope="session")
def robot(session):
    """Its robot file."""
    return session / "robot.toml"


def columns(path):
    """The columns of a run log; an empty field is NaN."""
    with open(path, encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    cells = zip(*rows)
    return {name: np.array([float(x) if x else np.nan for x in column]) for name, column in zip(header, cells)}


@pytest.fixture(scope="session")
def runs(session):
    """The recordings of the session, as dictionaries of arrays by name."""
    return {path.stem: columns(path) for path in sorted(session.glob("runs/*.csv"))}


@pytest.fixture(scope="session")
def run(runs):
    """One of them."""
    return runs["run00"]
