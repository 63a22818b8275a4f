"""The re-fits on a toy that is linear: a wheel's current under a bridge that loses a voltage, and other causes beside it.

    i = (u - V_d sign(u)) / R
"""

import itertools

import numpy as np
import pytest

from peers.bic import BELIEVED, compared
from peers.candidate import Candidate, candidates
from peers.catalogue import Cause, Parameter
from peers.clock import Clock
from peers.fit import fitted, nominal
from peers.problem import Problem, beginning, shortened
from peers.residuals import Floor
from peers.screen import screened
from peers.session import Run, Session
from peers.tests.made import FOUR, session, table

NOISE = 0.02
VOLTS = np.random.default_rng(4).uniform(-6, 6, 600)


def cause(name, typical, kind="effect"):
    return Cause(name, kind, "electrical", (Parameter("size", "sizes", 0.0, typical, -10 * typical, 10 * typical),))


CAUSES = [cause("dead_time", 0.3), cause("offset", 0.1), cause("saturation", 0.02)]


def current(robot):
    """The toy's current, with what the robot's effects do to it."""
    effects = {name: table["size"] for name, table in robot.get("effects", {}).items()}
    lost = effects.get("dead_time", 0.0) * np.sign(VOLTS) + effects.get("saturation", 0.0) * VOLTS * np.abs(VOLTS)
    return (VOLTS - lost) / robot["motor"]["resistance_ohm"] + effects.get("offset", 0.0)


class Toy:
    """Stands for the program."""

    def predict(self, robot, _run, _horizon):
        return {"t_s": np.arange(VOLTS.size) / 100, "i0_A": current(robot)}


def problem(robot):
    """A recording of a robot whose file says what FOUR says."""
    noise = np.random.default_rng(5).normal(0, NOISE, VOLTS.size)
    run = Run(None, {"t_s": np.arange(VOLTS.size) / 100, "i0_A": current(robot) + noise})
    return Problem(Toy(), FOUR, [run], 2.0, Floor({"i0_A": 1.0}, {"i0_A": 1.0}))


def answered(robot):
    """The winner of the comparison and the fits."""
    posed, ticking = problem(robot), itertools.count()
    clock = Clock(1e6, lambda: next(ticking))
    base = nominal(posed, clock)
    fits = fitted(posed, base, screened(posed, base, [Candidate(one) for one in CAUSES], clock), clock)
    which = compared(FOUR, base.square, fits, posed.numbers())
    top = max(which, key=lambda one: one[2])[0]
    return (top if isinstance(top, str) else top.id), fits


def robot(**effects):
    off = FOUR | {"motor": FOUR["motor"] | {"resistance_ohm": 4.3111 * 1.08}}
    return off | {"effects": {name: {"size": size} for name, size in effects.items()}}


def test_a_hidden_dead_time_is_picked_and_its_size_found():
    top, fits = answered(robot(dead_time=0.4))
    assert top == "dead_time"
    found = next(fit for fit in fits if fit.candidate.cause.id == top)
    assert found.numbers["size"] == pytest.approx(0.4, abs=0.02)
    assert found.robot(FOUR)["motor"]["resistance_ohm"] == pytest.approx(4.3111 * 1.08, rel=0.005)


def test_a_wrong_number_within_its_uncertainty_is_no_gap():
    assert answered(robot())[0] == "no_gap"


def test_what_no_candidate_explains_is_unknown():
    strange = problem(robot())
    strange.runs[0].columns["i0_A"] += 0.2 * np.sin(np.arange(VOLTS.size))
    base = nominal(strange, Clock(1e6))
    fits = fitted(strange, base, screened(strange, base, [Candidate(one) for one in CAUSES], Clock(1e6)), Clock(1e6))
    which = compared(FOUR, base.square, fits, strange.numbers())
    assert max(which, key=lambda one: one[2])[0] == "unknown"
    assert base.square > BELIEVED * strange.numbers()


def test_no_time_still_gives_an_answer():
    posed = problem(robot(dead_time=0.4))
    base = nominal(posed, Clock(0))
    assert screened(posed, base, [Candidate(CAUSES[0])], Clock(0)) == []
    which = compared(FOUR, base.square, [], posed.numbers())
    assert sum(weight for *_, weight in which) == pytest.approx(1)


def test_candidates_are_what_the_log_can_show(tmp_path):
    read = Session.read(session(tmp_path / "s"))
    wheeled = Cause("cogging", "effect", "electrical", CAUSES[0].parameters, one_wheel=True)
    offered = candidates([*CAUSES, wheeled, cause("gyro_bias", 1.0), cause("speed_loop", 1.0)], read)
    assert [one.wheel for one in offered if one.cause is wheeled] == [0, 1, 2, 3]
    assert {one.cause.id for one in offered} == {"dead_time", "offset", "saturation", "cogging"}


def test_long_recordings_keep_their_beginnings(tmp_path):
    table(tmp_path / "run.csv", {"t_s": np.arange(100) / 10, "x_m": np.arange(100.0)})
    run = Run.read(tmp_path / "run.csv")
    assert shortened([run], 100, tmp_path) == [run]
    assert [len(one.time) for one in shortened([run, run], 60, tmp_path)] == [30, 30]
    assert beginning(run, 7, tmp_path / "some.csv").columns["x_m"].tolist() == list(range(7))


def test_a_number_that_is_let_go_pays_for_its_prior_alone():
    wider = Cause("resistance", "parameter", "electrical", CAUSES[0].parameters, keys=(("motor", "resistance_ohm"),))
    assert Candidate(wider).price(FOUR, 1e9) == pytest.approx(2 * np.log(10))
    assert Candidate(CAUSES[0]).price(FOUR, 1e9) == pytest.approx(np.log(1e9))
