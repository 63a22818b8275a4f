"""Recordings in memory: each kind gives the bits of the files with the same numbers, and what cannot be used one message."""

import json

import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest

import omni_gap


@pytest.fixture(scope="module")
def expected(session):
    """The diagnosis of the files, but for the recordings' names and hashes."""
    told = omni_gap.diagnose(session).to_dict()
    told["inputs"] = told["inputs"][:1]
    return told


def polars_of(run):
    """A frame of polars, NaN as null."""
    return pl.DataFrame({name: pl.Series(column).fill_nan(None) for name, column in run.items()})


KINDS = {
    "arrays": dict,
    "lists": lambda run: {name: list(column) for name, column in run.items()},
    "pandas": pd.DataFrame,
    "pandas with holes of its own": lambda run: pd.DataFrame(run).convert_dtypes(dtype_backend="numpy_nullable"),
    "pandas over arrow": lambda run: pd.DataFrame(run).convert_dtypes(dtype_backend="pyarrow"),
    "pandas with the clock as index": lambda run: pd.DataFrame(run).set_index("t_s"),
    "polars": polars_of,
    "arrow": lambda run: pa.table({name: pa.array(column, from_pandas=True) for name, column in run.items()}),
    "arrow in pieces": lambda run: pa.Table.from_batches(pa.table(dict(run)).to_batches(max_chunksize=77)),
    "structured": lambda run: np.rec.fromarrays(list(run.values()), names=list(run)),
}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_table_gives_the_bits_of_the_files(runs, robot, expected, kind):
    in_memory = {name: KINDS[kind](run) for name, run in runs.items()}
    assert omni_gap.diagnose(in_memory, robot, name="session").to_dict() == expected


def test_a_list_of_recordings_is_numbered(runs, robot, expected):
    assert omni_gap.diagnose(list(runs.values()), robot, name="session").to_dict() == expected


def test_paths_and_memory_go_together(session, runs, robot, expected):
    paths = [session / "runs" / "run00.csv", session / "runs" / "run01.csv"]
    mixed = [*paths, *list(runs.values())[2:]]
    found = omni_gap.diagnose(mixed, robot, name="session").to_dict()
    assert [given["file"] for given in found["inputs"][1:]] == [str(path) for path in paths]
    assert found["which"] == expected["which"]


def test_single_precision_and_whole_numbers_are_what_they_say(run, robot):
    coarse = {name: column.astype(np.float32) for name, column in run.items() if name != "t_s"}
    clock = np.arange(len(run["t_s"]), dtype=np.int64)
    exact = {"t_s": clock.astype(np.float64), **{name: column.astype(np.float64) for name, column in coarse.items()}}
    narrow = {"t_s": clock, **coarse}
    arrow = pa.table(narrow)
    found = [omni_gap.simulate(robot, given, noise=False) for given in (exact, narrow, arrow)]
    for name, column in found[0].items():
        np.testing.assert_array_equal(found[1][name], column)
        np.testing.assert_array_equal(found[2][name], column)


@pytest.mark.parametrize("unit", ["s", "ms", "us", "ns"])
def test_instants_are_seconds_since_1970(run, robot, unit):
    first = 1_700_000_000
    rows = len(run["t_s"])
    ticks = np.arange(rows) * {"s": 1, "ms": 5, "us": 5_000, "ns": 5_000_000}[unit]
    scale = {"s": 1, "ms": 10**3, "us": 10**6, "ns": 10**9}[unit]
    instants = (ticks + first * scale).astype(f"datetime64[{unit}]")
    for given in [dict(run, t_s=instants), pd.DataFrame(dict(run, t_s=instants)), pa.table(dict(run, t_s=instants))]:
        clock = omni_gap.simulate(robot, given, noise=False)["t_s"]
        np.testing.assert_allclose(clock - first, ticks / scale, rtol=0, atol=3e-7)


def test_arrow_comes_through_its_capsule_and_by_no_other_way(run, robot):
    """Whatever hands out a stream of Arrow is a recording: no method of any library is called that would copy it."""

    class Stream:
        asked = 0

        def __arrow_c_stream__(self, requested_schema=None):
            self.asked += 1
            return pa.table(dict(run)).__arrow_c_stream__(requested_schema)

    stream = Stream()
    found = omni_gap.simulate(robot, stream, noise=False)
    assert stream.asked == 1
    expected = omni_gap.simulate(robot, run, noise=False)
    assert all(np.array_equal(found[name], expected[name], equal_nan=True) for name in expected)


def test_a_mapping_of_another_layout_may_be_a_dictionary(run, robot):
    foreign = {("ms" if name == "t_s" else name): column * (1e3 if name == "t_s" else 1) for name, column in run.items()}
    names = {name: {"from": name} for name in run if name != "t_s"}
    mapping = {"columns": {"t_s": {"from": "ms", "unit": "ms"}, **names}}
    found = omni_gap.simulate(robot, foreign, noise=False, columns=mapping)
    expected = omni_gap.simulate(robot, run, noise=False)
    np.testing.assert_allclose(found["t_s"], expected["t_s"], rtol=1e-12)


def refused(call):
    with pytest.raises(omni_gap.OmniGapError) as caught:
        call()
    assert isinstance(caught.value, ValueError)
    return str(caught.value)


def test_bad_input_is_one_message_with_what_where_and_how_to_mend_it(run, robot):
    def told(given, **more):
        return refused(lambda: omni_gap.diagnose(given, robot, **more))

    missing = {name: column for name, column in run.items() if name != "u1_V"}
    assert told(missing) == (
        "run00: column `u1_V`: the column is missing: 3 of 4 wheels have one. Add the column, or map it in columns.toml"
    )
    short = dict(run, u1_V=run["u1_V"][:-1])
    rows = len(run["t_s"])
    expected = f"run00: column `u1_V`: found {rows - 1} rows, expected {rows}, as many as `t_s` has. "
    assert told(short).startswith(expected)
    text = dict(run, u1_V=np.array(["6 V"] * rows, dtype=object))
    assert told(text).startswith("run00: column `u1_V`: it holds values of type object, expected numbers. ")
    assert told(pd.DataFrame(text)).startswith("run00: column `u1_V`: it holds values of type ")
    assert told(pl.DataFrame(dict(run, u1_V=["6 V"] * rows))).startswith("run00: column `u1_V`: it holds Utf8View, expected")
    infinite = dict(run, u1_V=np.where(np.arange(rows) == 3, np.inf, run["u1_V"]))
    assert told(infinite).startswith("run00: column `u1_V`: row 4: found `inf`, expected a finite number. ")
    back = dict(run, t_s=run["t_s"][::-1])
    assert told(back).startswith("run00: column `t_s`: row 2: found ")
    wide = dict(run, u1_V=np.zeros((rows, 4)))
    assert told(wide).startswith(f"run00: column `u1_V`: found an array of shape ({rows}, 4), expected one dimension. ")
    assert "expected a recording" in told([3.0])
    assert told([]) == "session: there is no recording in it. Give at least one"
    assert "robot: none was given" in refused(lambda: omni_gap.diagnose(run))
    assert told(run, horizon_s=0).startswith("horizon_s: found 0, expected")


def test_what_is_not_asked_for_is_left_out_with_a_notice(run, robot):
    noted = dict(run, remark=["fine"] * len(run["t_s"]))
    notices = omni_gap.check(noted, robot).to_dict()["notices"]
    assert any("columns left out: `remark`" in notice for notice in notices)


def test_a_robot_that_is_no_robot_is_told(run):
    assert refused(lambda: omni_gap.diagnose(run, {"name": "x"})).startswith("robot")
    assert "expected a path or a dictionary" in refused(lambda: omni_gap.diagnose(run, 3))
    assert "no form in TOML" in refused(lambda: omni_gap.diagnose(run, {"name": None}))
    assert "is neither number" in refused(lambda: omni_gap.diagnose(run, {"name": object()}))


def test_an_answer_is_the_callers_to_change(session):
    diagnosis = omni_gap.diagnose(session)
    diagnosis.to_dict()["verdict"] = "no_gap"
    diagnosis.findings.clear()
    assert diagnosis.verdict == "effect" and diagnosis.findings
    assert json.loads(diagnosis.to_json()) == diagnosis.to_dict()
