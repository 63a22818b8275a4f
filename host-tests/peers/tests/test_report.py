"""Reports keep the contract's form whatever a contestant weighs."""

import json

import pytest

from peers.report import Answer, check, report, write
from peers.session import Session
from peers.tests.made import FOUR, cause, session


@pytest.fixture
def read(tmp_path):
    return Session.read(session(tmp_path / "s"))


@pytest.mark.parametrize(
    ("which", "verdict", "causes"),
    [
        ([(cause("a"), None, 3.0), (cause("b", "body"), None, 1.0)], "effect", ["a"]),
        ([(cause("mass", "body", "parameter"), None, 3.0)], "parameter", ["mass"]),
        ([("unknown", None, 0.2), (cause("a"), 1, 0.1)], "unknown", []),
        ([("no_gap", None, 1.0)], "no_gap", []),
    ],
)
def test_weights_become_a_report(read, which, verdict, causes):
    made = report(read, "some", Answer(which), 0.1)
    assert check(made) == [] and made["verdict"] == verdict and made["causes"] == causes
    assert sum(one["probability"] for one in made["which"]) == pytest.approx(1, abs=1e-12)


def test_stages_share_as_the_causes_in_them(read):
    made = report(read, "some", Answer([(cause("a"), None, 3.0), (cause("b", "body"), None, 1.0)]), 0.1)
    assert {one["stage"]: one["share"] for one in made["where"]} == {"electrical": 0.75, "body": 0.25}


def test_the_check_tells_what_is_wrong(read):
    good = report(read, "some", Answer([(cause("a"), None, 1.0)]), 0.1)
    for change, said in [
        ({"verdict": "maybe"}, "verdict"),
        ({"causes": []}, "causes"),
        ({"which": good["which"][:1]}, "lacks"),
        ({"where": []}, "shares"),
        ({"schema": 2}, "schema"),
    ]:
        assert any(said in fault for fault in check(good | change)), change
    assert check({}) != []


def test_files_are_left_and_an_old_model_is_not(read, tmp_path):
    write(tmp_path / "out", read, "some", Answer([(cause("a"), None, 1.0)], robot=FOUR), 0.1)
    assert json.loads((tmp_path / "out" / "report.json").read_text())["causes"] == ["a"]
    assert (tmp_path / "out" / "corrected_robot.toml").exists()
    write(tmp_path / "out", read, "some", Answer([("no_gap", None, 1.0)], robot=FOUR), 0.1)
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["report.json"]
