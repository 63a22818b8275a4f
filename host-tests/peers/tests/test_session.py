"""Sessions are read as they are, and refused with one clear message."""

import numpy as np
import pytest

from peers import command
from peers.mistakes import Mistake
from peers.report import Answer
from peers.session import Run, Session
from peers.tests.made import session, table


def test_blank_fields_are_missing_samples(tmp_path):
    table(tmp_path / "run.csv", {"t_s": [0.0, 0.1], "x_m": [np.nan, 2.0]})
    run = Run.read(tmp_path / "run.csv")
    assert np.isnan(run.columns["x_m"][0]) and run.columns["x_m"][1] == 2.0


def test_what_is_logged_is_told_by_group(tmp_path):
    read = Session.read(session(tmp_path / "s", runs=2))
    assert len(read.runs) == 2 and read.wheels == 4
    assert [group for group in ("u", "wset", "i", "w", "pose", "gyro", "vbat") if read.logs(group)] == ["u", "i", "w", "pose"]


def spoiled(folder, file, text):
    (folder / file).write_text(text, encoding="utf-8")
    return folder


@pytest.mark.parametrize(
    ("file", "text", "said"),
    [
        ("runs/run0.csv", "t_s,x_m\n0,1\n1,two\n", "line 3"),
        ("runs/run0.csv", "t_s,x_m\n0,1\n1\n", "line 3: 1 fields"),
        ("runs/run0.csv", "t_s,x_m\n1,1\n0,1\n", "t_s does not grow"),
        ("runs/run0.csv", "a,b\n1,1\n0,1\n", "t_s column"),
        ("runs/run0.rec", "", "*.csv only"),
        ("robot.toml", "[[wheel", "robot.toml"),
        ("robot.toml", "name = 'x'\n", "no [wheel]"),
        ("columns.toml", "", "no mappings"),
    ],
)
def test_a_spoiled_session_is_told_by_file_and_line(tmp_path, file, text, said):
    with pytest.raises(Mistake) as told:
        Session.read(spoiled(session(tmp_path / "s"), file, text))
    assert said in str(told.value) and str(tmp_path) in str(told.value)


def test_an_unreadable_session_ends_with_one_message_and_code_2(tmp_path, capsys):
    words = [str(tmp_path / "nowhere"), "--out", str(tmp_path / "out")]
    code = command.run("some", lambda *_: Answer([]), words=words)
    said = capsys.readouterr().err
    assert code == 2 and said.count("\n") == 1 and "nowhere" in said
    assert not (tmp_path / "out").exists()


def test_a_program_that_is_none_ends_with_code_2(tmp_path, capsys):
    words = [str(session(tmp_path / "s")), "--out", str(tmp_path / "out"), "--omni-gap", str(tmp_path / "none")]
    assert command.run("some", lambda *_: Answer([]), words=words) == 2
    assert "not a program" in capsys.readouterr().err
