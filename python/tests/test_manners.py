"""Ctrl-C, threads, stubs, and charts."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import matplotlib
import numpy as np
import pytest

import omni_gap
from omni_gap import fleet, plot

matplotlib.use("Agg")

PACKAGE = Path(omni_gap.__file__).parent
CONFIGURATION = Path(__file__).parents[1] / "pyproject.toml"


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signal")
def test_ctrl_c_ends_a_diagnosis_before_its_end(session):
    begun = time.perf_counter()
    omni_gap.diagnose(session)
    whole = time.perf_counter() - begun
    pressed = threading.Timer(0.2 * whole, os.kill, (os.getpid(), signal.SIGINT))
    pressed.start()
    begun = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        omni_gap.diagnose(session)
    assert time.perf_counter() - begun < 0.95 * whole
    # and nothing is left behind that would spoil the next
    assert omni_gap.diagnose(session).verdict == "effect"


def test_diagnoses_run_beside_each_other(session, robot, run):
    told = omni_gap.diagnose(session).to_json()
    found = [None, None]

    def diagnose(at):
        found[at] = omni_gap.diagnose(session).to_json()

    threads = [threading.Thread(target=diagnose, args=(at,)) for at in range(2)]
    for thread in threads:
        thread.start()
    counted = 0
    while any(thread.is_alive() for thread in threads):
        counted += 1
        time.sleep(0.002)
    assert counted > 5, "this thread went on while the others worked"
    assert found == [told, told]


def test_the_package_is_typed():
    assert (PACKAGE / "py.typed").is_file()
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--allow-any-generics", "--no-warn-return-any", "--python-version", "3.11", "--config-file", str(CONFIGURATION), str(PACKAGE)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "MYPY_CACHE_DIR": os.devnull},
    )
    assert checked.returncode == 0, checked.stdout


def test_the_stub_names_what_the_compiled_part_has():
    stub = (PACKAGE / "_omni_gap.pyi").read_text(encoding="utf-8")
    told = set(re.findall(r"^(?:class|def) (\w+)", stub, re.MULTILINE)) - {"Mapping"}
    there = {name for name in dir(omni_gap._omni_gap) if not name.startswith("_")}
    assert told == there
    for name in there:
        one = getattr(omni_gap._omni_gap, name)
        if isinstance(one, type) and name != "OmniGapError":
            body = re.search(rf"^class {name}\b.*?(?=^\S|\Z)", stub, re.MULTILINE | re.DOTALL)[0]
            members = set(re.findall(r"^    (?:def )?(\w+)", body, re.MULTILINE)) - {"__init__"}
            assert members == {member for member in vars(one) if not member.startswith("_")}, name


@pytest.mark.parametrize("module", [omni_gap, fleet])
def test_everything_public_is_documented(module):
    for name in module.__all__:
        one = getattr(module, name)
        assert name == "__version__" or one.__doc__, name
        if isinstance(one, type):
            for member, what in vars(one).items():
                assert member.startswith("_") or callable(what) is False or what.__doc__, f"{name}.{member}"


@pytest.mark.parametrize("draw", [plot.signals, plot.residuals, plot.gap, plot.which])
def test_charts_are_drawn(session, tmp_path, draw):
    figure = draw(omni_gap.diagnose(session))
    axes = figure.get_axes()
    assert axes
    for one in axes:
        drawn = [line.get_ydata() for line in one.lines if len(line.get_ydata()) > 2]
        assert one.patches or drawn and all(np.isfinite(values).all() for values in drawn)
    figure.savefig(tmp_path / "chart.png")
    assert (tmp_path / "chart.png").stat().st_size > 10_000


def test_a_residual_is_what_is_left(session):
    diagnosis = omni_gap.diagnose(session)
    panels = diagnosis.signals["panels"]
    for panel, ax in zip(panels, plot.residuals(diagnosis).get_axes(), strict=True):
        if panel["unit"] == "rad":
            continue  # within half a turn
        for line, model in zip(ax.lines, ["nominal", "corrected"]):
            apart = panel["series"]["measured"] - panel["series"][model]
            np.testing.assert_array_equal(line.get_ydata(), apart[~np.isnan(apart)])
    assert any(np.isnan(panel["series"]["measured"]).any() for panel in panels), "the camera misses no row here"


def test_there_is_nothing_to_draw_of_recordings_that_cannot_be_used(run, robot):
    still = {name: column * (0 if name[0] in "uiw" else 1) for name, column in run.items()}
    diagnosis = omni_gap.diagnose(still, robot)
    assert diagnosis.verdict == "unfit_data"
    for draw in [plot.signals, plot.residuals, plot.gap]:
        with pytest.raises(omni_gap.OmniGapError, match="could not be used"):
            draw(diagnosis)
