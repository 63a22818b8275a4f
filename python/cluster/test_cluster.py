"""Sessions elsewhere, on clusters: the tables of one machine."""

import re
from pathlib import Path

import duckdb
import fsspec
import pandas
import pytest
from bucket import bucket, download, upload
from nodes import cluster, kill_after_a_third
from stage import stage, tables

import omni_gap.fleet.ray
from omni_gap import fleet

BOOK = Path(__file__).parents[2] / "book/src/fleet.md"


@pytest.fixture(scope="module")
def logs(tmp_path_factory):
    logs = tmp_path_factory.mktemp("fleet") / "logs"
    stage(logs, 24)
    return logs


@pytest.fixture(scope="module")
def season(logs):
    """The tables that one machine makes of them, without reports."""
    store = logs.parent / "season"
    fleet.diagnose(logs, store, reports=False)
    return tables(store)


def test_a_node_that_dies_in_the_middle_loses_nothing(logs, season, tmp_path):
    with cluster(nodes=3) as (made, nodes):
        kill, killed = kill_after_a_third(made, nodes[1])
        tally = omni_gap.fleet.ray.diagnose(logs, tmp_path / "season", reports=False, progress=kill)
        assert killed and killed[0] < tally.sessions
        assert (tally.done, tally.kept, tally.failed) == (24, 0, 0)
        again = omni_gap.fleet.ray.diagnose(logs, tmp_path / "season", reports=False)
        assert (again.done, again.kept) == (0, 24)
    assert tables(tmp_path / "season") == season


def test_an_object_store_has_the_tables_and_reports_of_one_machine(logs, tmp_path):
    with bucket(5574) as s3:
        upload(logs, s3, "robots/logs")
        assert fleet.diagnose((s3, "robots/logs"), (s3, "robots/here")).done == 24
        assert fleet.diagnose((s3, "robots/logs"), (s3, "robots/here")).kept == 24
        with cluster(nodes=2):
            omni_gap.fleet.ray.diagnose((s3, "robots/logs"), (s3, "robots/on-ray"))
        for store in ("here", "on-ray"):
            download(s3, f"robots/{store}", tmp_path / store)
        assert str(fleet.report((s3, "robots/here"))) == str(fleet.report(tmp_path / "here"))
    assert tables(tmp_path / "here") == tables(tmp_path / "on-ray")
    names = {row["session"] for row in fleet.report(tmp_path / "here").to_dict()["sessions"]}
    assert "s3://robots/logs/r000/2026-11-01" in names
    reports = list((tmp_path / "here/reports").glob("*/report.html"))
    assert len(reports) == 24


def test_a_filesystem_of_fsspec_is_taken_too(logs):
    memory = fsspec.filesystem("memory")
    memory.put(str(logs / "r000"), "/logs/r000", recursive=True)
    tally = fleet.diagnose((memory, "/logs"), (memory, "/season"), reports=False)
    assert tally.done == 20
    assert fleet.report((memory, "/season")).to_dict()["sessions"][0]["session"] == "memory:///logs/r000/2026-11-01"


def test_other_programs_read_the_tables_as_one(logs, season, tmp_path, monkeypatch):
    fleet.diagnose(logs, tmp_path / "season", reports=False)
    monkeypatch.chdir(tmp_path)
    query = re.search(r"```sql\n(.*?)```", BOOK.read_text(encoding="utf-8"), re.DOTALL)[1]
    found = duckdb.sql(query).fetchall()
    sessions = pandas.read_parquet("season/sessions")
    assert set(sessions["robot"]) == {"r000", "r001"} and len(sessions) == 24
    named = sessions[sessions["verdict"] == "effect"].groupby("robot", observed=True)["gap"].agg(["size", "mean"])
    assert {robot: (size, pytest.approx(mean)) for robot, size, mean in found} == {
        robot: (row["size"], row["mean"]) for robot, row in named.iterrows()
    }
    assert found, "some session has an effect"


def test_dask_does_it_by_the_lines_of_the_book(logs, season, tmp_path, monkeypatch):
    lines = re.search(r"```python\n(from dask.*?)```", BOOK.read_text(encoding="utf-8"), re.DOTALL)[1]
    monkeypatch.chdir(logs.parent)
    lines = lines.replace('"scheduler:8786"', "processes=False, dashboard_address=None").replace('"season"', repr(str(tmp_path / "season")))
    exec(compile(lines.replace('"logs"', repr(str(logs))), str(BOOK), "exec"), {})
    assert tables(tmp_path / "season") == season
