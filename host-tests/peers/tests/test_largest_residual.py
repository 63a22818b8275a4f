"""The rule takes the largest channel, tells one wheel from all, and is silent below its threshold."""

from peers.largest_residual import scores, triaged, weighed
from peers.tests.made import cause
from peers.triage import ALL, ONE

QUIET = {f"{kind}{j}{unit}": 0.5 for j in range(4) for kind, unit in (("i", "_A"), ("w", "_rad_s"))}
POSE = {"x_m": 0.4, "y_m": 0.4, "theta_rad": 0.4}
CAUSES = {name: cause(name) for name in {*ALL.values(), *ONE.values()}}


def first(scored):
    entries = weighed(triaged(scored), CAUSES)
    top, where, _ = max(entries, key=lambda one: one[2])
    return (top if isinstance(top, str) else top.id), where


def test_all_quiet_is_no_gap():
    assert first(QUIET | POSE) == ("no_gap", None)


def test_the_largest_channel_names_the_cause():
    alike = {name: 3.0 for name in QUIET if name.startswith("i")}
    assert first(QUIET | POSE | alike) == (ALL["i"], None)
    assert first(QUIET | POSE | alike | {"theta_rad": 4.0}) == (ALL["heading"], None)


def test_a_wheel_that_stands_out_is_named():
    assert first(QUIET | POSE | {"w2_rad_s": 3.0}) == (ONE["w"], 2)


def test_scores_are_over_the_largest_draw():
    assert scores({"x_m": 6.0, "y_m": 1.0}, [{"x_m": 1.0, "y_m": 2.0}, {"x_m": 3.0, "y_m": 1.0}]) == {"x_m": 2.0, "y_m": 0.5}
