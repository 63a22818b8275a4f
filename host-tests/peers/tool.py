"""The product through its command line: its simulator as a user has it."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import tomli_w

from peers.mistakes import Mistake, Refused

# Where a build of this tree leaves the program.
BUILT = Path(__file__).resolve().parents[2] / "target" / "release" / "omni-gap"


class Tool:
    """The program and a folder for what goes to and from it; a context manager that removes the folder."""

    def __init__(self, program):
        self.program = program
        self.kept = tempfile.TemporaryDirectory(prefix="peers-")
        self.folder = Path(self.kept.name)

    @classmethod
    def found(cls, asked=None):
        """The program that was asked for, or the one of this tree, or the one on the path."""
        if asked is not None:
            if not os.access(asked, os.X_OK) or asked.is_dir():
                raise Mistake(f"{asked}: not a program; name omni-gap's file behind --omni-gap")
            return cls(asked.resolve())
        program = BUILT if BUILT.is_file() else shutil.which("omni-gap")
        if program is None:
            raise Mistake("omni-gap is not there; build it with `cargo build --release`, or name it behind --omni-gap")
        return cls(program)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kept.cleanup()

    def said(self, *words):
        """What the program prints; its complaint is Refused."""
        try:
            done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True, encoding="utf-8")
        except OSError as why:
            raise Mistake(f"{self.program}: cannot be run ({why.strerror}); build it again") from why
        if done.returncode != 0:
            complaint = " ".join(done.stderr.split()) or f"exit code {done.returncode}"
            raise Refused(f"omni-gap {words[0]}: {complaint}")
        return done.stdout

    def robot(self, robot):
        """A robot written where the program finds it."""
        path = self.folder / "robot.toml"
        path.write_text(tomli_w.dumps(robot), encoding="utf-8")
        return path

    def predict(self, robot, run, horizon):
        """Free runs of a robot over a recording's file, restarted every `horizon` [s]: columns by name."""
        return self.made("predict", self.robot(robot), run, "--horizon", horizon)

    def simulate(self, robot, run, seed, out, noise=True):
        """Records what a robot does with a recording's inputs."""
        words = ("--input", run, "--seed", seed, "--noise", str(noise).lower(), "--out", out)
        self.said("simulate", "--quiet", self.robot(robot), *words)
        return out

    def explain(self, *words):
        """What the program says of a cause, or of all."""
        return self.said("explain", *words)

    def made(self, command, *words):
        """A table that the program fills: columns by name."""
        path = self.folder / "made.csv"
        self.said(command, "--quiet", *words, "--out", path)
        with path.open(encoding="utf-8") as file:
            header = file.readline().strip().split(",")
            table = np.loadtxt(file, delimiter=",", ndmin=2)
        return dict(zip(header, table.T, strict=True))
