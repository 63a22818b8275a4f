"""Fleets: the command's tables, whatever the sessions and the tables lie on."""

import json
import pickle
import shutil

import pyarrow.fs
import pyarrow.parquet
import pytest
from conftest import command

import omni_gap
from omni_gap import fleet

TABLES = ("sessions", "causes", "equations")


def tables(store):
    """The bytes of every table's file, by name."""
    paths = [path for table in TABLES for path in sorted((store / table).rglob("*.parquet"))]
    return {path.relative_to(store).as_posix(): path.read_bytes() for path in paths}


@pytest.fixture(scope="module")
def logs(session, tmp_path_factory):
    """Two robots with the same session, and a third with one that cannot be read."""
    logs = tmp_path_factory.mktemp("fleet") / "logs"
    for robot in ("r01", "r02"):
        shutil.copytree(session, logs / robot / "2026-11-03")
    broken = logs / "r03" / "2026-11-03"
    (broken / "runs").mkdir(parents=True)
    (broken / "runs/a.csv").write_text("t_s\n")
    (broken / "robot.toml").write_text("name = 7\n")
    return logs


@pytest.fixture(scope="module")
def season(logs):
    """The store that the command makes of them."""
    command("fleet", logs, "--out", logs.parent / "season")
    return logs.parent / "season"


@pytest.fixture
def elsewhere(tmp_path):
    """A folder that is reached through a filesystem of pyarrow."""
    return pyarrow.fs.SubTreeFileSystem(str(tmp_path), pyarrow.fs.LocalFileSystem()), tmp_path


def test_the_tables_are_those_of_the_command(logs, season, tmp_path):
    store = tmp_path / "season"
    seen = []
    tally = fleet.diagnose(logs, store, jobs=2, progress=lambda tally: seen.append(tally.done))
    assert (tally.sessions, tally.done, tally.kept, tally.failed) == (3, 3, 0, 1)
    assert seen == [1, 2, 3]
    assert tables(store) == tables(season)
    assert sorted(path.name for path in (store / "reports").iterdir()) == sorted(path.name for path in (season / "reports").iterdir())
    again = fleet.diagnose(logs, store)
    assert (again.done, again.kept) == (0, 3)


def test_what_they_tell_together_is_what_the_command_says(season):
    told = fleet.report(season)
    command("fleet", "report", season)
    assert told.to_json() == (season / "fleet.json").read_text(encoding="utf-8")
    assert told.to_html() == (season / "fleet.html").read_text(encoding="utf-8")
    assert "3 robots" in str(told)


def test_a_session_that_changed_is_answered_anew_and_the_others_are_not(logs, tmp_path):
    copy = shutil.copytree(logs, tmp_path / "logs")
    fleet.diagnose(copy, tmp_path / "season", reports=False)
    with (copy / "r02/2026-11-03/robot.toml").open("a", encoding="utf-8") as file:
        file.write("# looked at\n")
    tally = fleet.diagnose(copy, tmp_path / "season", reports=False)
    assert (tally.done, tally.kept) == (1, 2)
    assert not (tmp_path / "season/reports").exists()


def test_sessions_and_tables_may_lie_elsewhere(logs, elsewhere):
    filesystem, folder = elsewhere
    shutil.copytree(logs, folder / "logs")
    (folder / "logs/r01/.hidden/runs").mkdir(parents=True)
    (folder / "logs/r01/.hidden/robot.toml").write_text("")
    shutil.copytree(logs / "r01/2026-11-03", folder / "logs/r01/2026-11-03/runs/inner")
    found = fleet.find((filesystem, "logs"))
    assert [str(session.place).rpartition("/logs/")[2] for session in found] == [f"r0{robot}/2026-11-03" for robot in (1, 2, 3)]
    shutil.rmtree(folder / "logs/r01/2026-11-03/runs/inner")
    tally = fleet.diagnose((filesystem, "logs"), (filesystem, "season"))
    assert (tally.sessions, tally.done, tally.failed) == (3, 3, 1)
    assert fleet.diagnose((filesystem, "logs"), (filesystem, "season")).kept == 3
    rows = pyarrow.parquet.read_table(folder / "season/sessions").to_pylist()
    assert [row["verdict"] for row in sorted(rows, key=lambda row: row["session"])] == ["effect", "effect", None]
    assert {row["date"] for row in rows} == {"2026-11-03"}
    for row in rows[:2]:
        assert (folder / "season" / row["report"] / "report.html").is_file()
    assert str(fleet.report((filesystem, "season"))) == str(fleet.report(folder / "season"))
    left = [path for path in folder.rglob("*") if path.name.startswith(".omni-gap-")]
    assert not left


def test_a_place_that_cannot_be_reached_is_a_row_and_asked_again(logs, elsewhere, monkeypatch):
    filesystem, folder = elsewhere
    shutil.copytree(logs, folder / "logs")

    def lost(place, copy):
        raise OSError(f"{place}: the line is dead")

    with monkeypatch.context() as patched:
        patched.setattr(fleet._find, "_copy", lost)
        tally = fleet.diagnose((filesystem, "logs"), (filesystem, "season"))
        assert (tally.done, tally.failed) == (3, 3)
        rows = pyarrow.parquet.read_table(folder / "season/sessions").to_pylist()
        assert all("the line is dead" in row["reason"] for row in rows)
        assert {row["robot"] for row in rows} == {"r01", "r02", "r03"}
    tally = fleet.diagnose((filesystem, "logs"), (filesystem, "season"))
    assert (tally.done, tally.failed) == (3, 1)


def test_an_answer_can_be_made_anywhere_and_sent(logs, season, tmp_path):
    with fleet.Store(tmp_path / "season") as store:
        for session in reversed(fleet.find(logs)):
            sent = pickle.loads(pickle.dumps(session))
            found = fleet.answer(sent, store.key(session.name), season)
            store.put(pickle.loads(pickle.dumps(found)))
            assert fleet.answer(session, json.loads(json.dumps(found.row))["key"]) is None
    assert tables(tmp_path / "season") == tables(season)


def test_what_cannot_be_a_fleet_is_refused_in_one_message(logs, tmp_path, elsewhere):
    filesystem, _ = elsewhere
    refusals = [
        (lambda: fleet.find(tmp_path), "no session lies below it"),
        (lambda: fleet.find((filesystem, "nowhere")), "nowhere"),
        (lambda: fleet.find("moon://logs"), "moon://logs: no place that pyarrow can open"),
        (lambda: fleet.diagnose(logs, tmp_path / "season", jobs=0), "jobs: found 0, expected at least 1"),
        (lambda: fleet.report(tmp_path / "season"), "there are no sessions of a fleet"),
    ]
    for ask, expected in refusals:
        with pytest.raises(omni_gap.OmniGapError, match="^(?s:.)*" + expected):
            ask()


def test_one_program_writes_to_a_folder(tmp_path):
    with fleet.Store(tmp_path / "season"):
        with pytest.raises(omni_gap.OmniGapError, match="another omni-gap fleet is writing to it"):
            fleet.Store(tmp_path / "season")
    store = fleet.Store(tmp_path / "season")
    store.close()
    with pytest.raises(omni_gap.OmniGapError, match="this store is closed"):
        store.key("x")
