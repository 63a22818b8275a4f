"""Each function beside its command: the same numbers to the last bit, and the same messages."""

import json
import tomllib

import numpy as np
import pytest
from conftest import EFFECTS, EXAMPLES, answer, columns, command

import omni_gap


def test_a_diagnosis_is_the_commands_byte_for_byte(demo, session):
    diagnosis = omni_gap.diagnose(session)
    written = (demo / "report" / "report.json").read_text(encoding="utf-8")
    assert diagnosis.to_json() == written
    assert diagnosis.to_dict() == json.loads(written)
    assert diagnosis.to_html() == (demo / "report" / "report.html").read_text(encoding="utf-8")
    assert diagnosis.corrected_robot == (demo / "report" / "corrected_robot.toml").read_text(encoding="utf-8")
    assert diagnosis.refitted_robot == (demo / "report" / "refitted_robot.toml").read_text(encoding="utf-8")
    assert (diagnosis.verdict, diagnosis.causes) == ("effect", ["dead_time"])
    assert diagnosis.findings[0]["cause"] == "dead_time"


def test_a_diagnosis_shows_itself(session):
    diagnosis = omni_gap.diagnose(session)
    said = command("diagnose", session, "--out", session.parent / "again")
    assert repr(diagnosis) == said.splitlines()[0]
    assert str(diagnosis).strip() == said.split("files ")[0].strip()
    frame = diagnosis._repr_html_()
    assert frame.startswith('<iframe srcdoc="&lt;!') and frame.count('"') == 6
    names = [set(panel["series"]) for panel in diagnosis.signals["panels"]]
    assert names and all(series == {"measured", "nominal", "corrected"} for series in names)


def test_the_files_that_are_written_are_the_commands(demo, session, tmp_path):
    omni_gap.diagnose(session).write(tmp_path / "deep" / "report")
    for file in (demo / "report").iterdir():
        assert (tmp_path / "deep" / "report" / file.name).read_bytes() == file.read_bytes(), file.name


def test_options_of_a_diagnosis_are_the_commands(session, robot, tmp_path):
    words = ["--without", "dead_time", "--horizon", "0.25", "--max-rows", "2000", "--out", tmp_path]
    alone = session / "runs" / "run00.csv"
    told = answer("diagnose", session, "--also", alone, *words)
    found = omni_gap.diagnose(session, also=[alone], without=["dead_time"], horizon_s=0.25, max_rows=2000)
    assert found.to_dict() == told
    logs = sorted(session.glob("runs/*.csv"))
    told = answer("diagnose", *logs, "--robot", robot, "--out", tmp_path)
    assert omni_gap.diagnose(logs, robot).to_dict() == told


@pytest.fixture(scope="module")
def experiments(robot, tmp_path_factory):
    """The paper's experiments, simulated."""
    folder = tmp_path_factory.mktemp("experiments")
    command("experiment", robot, "--out", folder / "scripts")
    (folder / "session" / "runs").mkdir(parents=True)
    (folder / "session" / "robot.toml").write_bytes(robot.read_bytes())
    for seed, script in enumerate(sorted((folder / "scripts" / "scripts").glob("*.csv"))):
        run = folder / "session" / "runs" / script.name
        command("simulate", robot, "--input", script, "--seed", seed, "--out", run)
    return folder / "session"


@pytest.mark.parametrize("experiment", ["all", "spin"])
def test_numbers_of_experiments_are_the_commands(experiments, tmp_path, experiment):
    told = answer("identify", experiments, "--out", tmp_path / "robot.toml", "--experiment", experiment)
    found = omni_gap.identify(experiments, experiment=experiment)
    assert found.to_dict() == told
    assert found.robot_text == (tmp_path / "robot.toml").read_text(encoding="utf-8")
    assert found._repr_html_().startswith("<pre>")


def test_identified_numbers_are_the_commands(session, tmp_path):
    told = answer("identify", session, "--out", tmp_path / "robot.toml")
    told.pop("file")
    found = omni_gap.identify(session)
    assert found.to_dict() == told
    assert found.robot_text == (tmp_path / "robot.toml").read_text(encoding="utf-8")
    assert tomllib.loads(found.robot_text)["name"] == "feup-4w"
    assert found._repr_html_().count("<tr>") == 1 + len(told["numbers"])
    assert repr(found).startswith("fit error ") and repr(found) in command(
        "identify", session, "--out", tmp_path / "robot.toml"
    )


def same_columns(found, path):
    written = columns(path)
    assert list(found) == list(written)
    for name, column in written.items():
        assert found[name].dtype == np.float64
        np.testing.assert_array_equal(found[name], column, err_msg=name)


def test_a_predicted_and_a_simulated_run_are_the_commands(session, robot, run, tmp_path):
    log = session / "runs" / "run00.csv"
    command("predict", robot, log, "--horizon", "0.4", "--out", tmp_path / "predicted.csv")
    same_columns(omni_gap.predict(robot, log, horizon_s=0.4), tmp_path / "predicted.csv")
    same_columns(omni_gap.predict(robot, run, horizon_s=0.4), tmp_path / "predicted.csv")
    command("simulate", robot, "--input", log, "--seed", "7", "--out", tmp_path / "simulated.csv")
    same_columns(omni_gap.simulate(robot, log, seed=7), tmp_path / "simulated.csv")
    simulated = omni_gap.simulate(robot, run, seed=7)
    same_columns(simulated, tmp_path / "simulated.csv")
    simulated.write(tmp_path / "written.csv")
    assert (tmp_path / "written.csv").read_bytes() == (tmp_path / "simulated.csv").read_bytes()
    assert not np.array_equal(omni_gap.simulate(robot, run, seed=8)["i0_A"], simulated["i0_A"])
    # what one function returns, another takes
    assert omni_gap.check(dict(simulated), robot).usable and omni_gap.check(simulated, robot).usable


def test_a_blank_column_is_predicted_from_memory_as_from_a_file(robot, run, tmp_path):
    rows = len(run["t_s"])
    blank = dict(run, **{f"i{wheel}_A": np.full(rows, np.nan) for wheel in range(4)})
    log = tmp_path / "run00.csv"
    lines = [",".join("" if np.isnan(x) else repr(float(x)) for x in row) for row in zip(*blank.values())]
    log.write_text("\n".join([",".join(blank), *lines]), encoding="utf-8")
    command("predict", robot, log, "--out", tmp_path / "predicted.csv")
    found = omni_gap.predict(robot, blank)
    same_columns(found, tmp_path / "predicted.csv")
    assert not np.isnan(found["i0_A"]).any()


def test_a_comparison_is_the_commands(session, robot, run, tmp_path):
    other = session.parent / "other"
    (other / "runs").mkdir(parents=True)
    changed = tmp_path / "robot.toml"
    changed.write_text(robot.read_text(encoding="utf-8") + "\n" + EFFECTS, encoding="utf-8")
    for log in sorted(session.glob("runs/*.csv")):
        command("simulate", changed, "--input", log, "--seed", "3", "--out", other / "runs" / log.name)
    (other / "robot.toml").write_bytes(robot.read_bytes())
    told = answer("compare", session, other, "--out", tmp_path / "compared")
    found = omni_gap.compare(session, other)
    assert found.to_dict() == told
    assert found.verdict == told["verdict"] == "different"
    found.write(tmp_path / "written")
    for name in ["compare.json", "compare.html"]:
        assert (tmp_path / "written" / name).read_bytes() == (tmp_path / "compared" / name).read_bytes()
    told = answer("compare", session, "--sim", other / "runs", "--robot", robot, "--out", tmp_path / "compared")
    assert omni_gap.compare(other / "runs", session, robot, simulator=True).to_dict() == told
    assert {"measured"} < set(found.signals["panels"][0]["series"])


def test_what_to_do_next_is_the_commands(session, tmp_path):
    told = answer("next", session, "--duration", "6", "--out", tmp_path)
    found = omni_gap.next(session, duration_s=6)
    assert found.to_dict() == told
    assert found.to_html() == (tmp_path / "next.html").read_text(encoding="utf-8")
    script = tmp_path / "next_experiment.csv"
    assert found.script == (script.read_text(encoding="utf-8") if script.exists() else None)


def test_a_self_test_is_the_commands(session, robot, tmp_path):
    few = ["--runs", "2", "--duration", "2", "--rate", "100", "--camera-rate", "30", "--sensors", "w,pose"]
    told = answer("selftest", robot, *few)
    of = {"runs": 2, "duration_s": 2, "rate_hz": 100, "camera_hz": 30, "sensors": ["w", "pose"]}
    found = omni_gap.selftest(robot, **of)
    assert found.to_dict() == told
    assert found.causes == told["causes"]
    log = session / "runs" / "run00.csv"
    told = answer("selftest", robot, "--script", log, "--out", tmp_path)
    found = omni_gap.selftest(robot, scripts=[log])
    assert found.to_dict() == told
    assert found.to_html() == (tmp_path / "selftest.html").read_text(encoding="utf-8")


def test_a_check_is_the_commands(session, robot, run):
    told = answer("check", session)
    found = omni_gap.check(session)
    assert found.to_dict() == told
    assert found.usable and found.faults == told["faults"]
    assert repr(found) in command("check", session)
    still = dict(run, w0_rad_s=np.full(len(run["t_s"]), 3.0))
    spoiled = omni_gap.check(still, robot)
    assert spoiled.faults and spoiled.faults[0]["run"] == "run00"
    assert omni_gap.diagnose(still, robot).to_dict()["faults"]


@pytest.mark.parametrize(
    ("words", "call"),
    [
        (["diagnose", "nowhere"], lambda: omni_gap.diagnose("nowhere")),
        (["diagnose", "x.csv", "--robot", "gone.toml"], lambda: omni_gap.diagnose("x.csv", "gone.toml")),
        (["identify", "SESSION", "--experiment", "1", "--out", "y.toml"],
         lambda: omni_gap.identify("SESSION", experiment="1")),
        (["compare", "nowhere", "neither"], lambda: omni_gap.compare("nowhere", "neither")),
        (["simulate", "gone.toml", "--input", "x.csv", "--noise", "false", "--out", "y.csv"],
         lambda: omni_gap.simulate("gone.toml", "x.csv", noise=False)),
    ],
)  # fmt: skip
def test_a_mistake_has_the_commands_message(words, call, session, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "SESSION").symlink_to(session, target_is_directory=True)
    told = command(*words, fails=True)
    with pytest.raises(omni_gap.OmniGapError) as caught:
        call()
    said = " ".join(told.split()).removeprefix("omni-gap: ")
    found = str(caught.value)
    # the command names its option, the function its argument
    assert found.replace('robot="robot.toml"', "--robot ROBOT.toml") == said


def test_what_is_no_cause_is_told_with_what_may_be_meant(session):
    with pytest.raises(omni_gap.OmniGapError, match="Did you mean `dead_time`"):
        omni_gap.diagnose(session, without=["deadtime"])


def test_a_file_of_the_examples_is_a_robot_as_a_dictionary(run):
    path = EXAMPLES / "feup-4w" / "robot.toml"
    given = tomllib.loads(path.read_text(encoding="utf-8"))
    found, expected = (omni_gap.simulate(robot, run, noise=False) for robot in (given, path))
    assert all(np.array_equal(found[name], expected[name], equal_nan=True) for name in expected)
