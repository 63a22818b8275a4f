"""What callers give, put into the order in which the compiled part takes it: robots, recordings, mappings, sessions."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _omni_gap
from ._omni_gap import OmniGapError

if TYPE_CHECKING:
    from typing_extensions import TypeGuard

PathLike = Union[str, "os.PathLike[str]"]
#: A robot file: its path, or a dictionary in its form.
RobotLike = Union[PathLike, Mapping[str, Any]]
#: A recording: the path of a run log, or named columns in memory.
RunLike = Any
#: A session: its folder; recordings, or a list or a dictionary of them by name.
SessionLike = Any

# What numpy calls the kinds of numbers: floats, whole ones, without a sign, truth values.
NUMBERS = "fiub"
NANOSECONDS = 1_000_000_000


def is_path(given: Any) -> TypeGuard[PathLike]:
    """Whether something names a file or folder."""
    return isinstance(given, (str, os.PathLike))


def robot(given: RobotLike, effects: Optional[Mapping[str, Any]] = None) -> _omni_gap.Robot:
    """A robot file, or a dictionary in its form; ``effects`` take the place of its effects of those names."""
    added = None if effects is None else as_json(effects, "effects")
    if is_path(given):
        return _omni_gap.Robot.load(os.fspath(given), added)
    if isinstance(given, Mapping):
        return _omni_gap.Robot.of_json(as_json(given, "robot"), added)
    raise OmniGapError(
        f"robot: found {kind(given)}, expected a path or a dictionary. "
        "Name the robot file, or give a dictionary in its form, as tomllib.load makes one"
    )


def mapping(given: Any) -> Optional[_omni_gap.Mapping]:
    """A mapping from another log layout: the path of a ``columns.toml``, or a dictionary in its form."""
    if given is None:
        return None
    if is_path(given):
        return {"path": os.fspath(given), "json": None}
    if isinstance(given, Mapping):
        return {"path": None, "json": as_json(given, "columns")}
    raise OmniGapError(f"columns: found {kind(given)}, expected a path or a dictionary. Name a columns.toml")


def as_json(given: Mapping[str, Any], what: str) -> str:
    """A dictionary as JSON, with numbers of numpy in it."""

    def plain(value: Any) -> Any:
        if isinstance(value, (np.generic, np.ndarray)):
            return value.tolist()
        if isinstance(value, Mapping):
            return dict(value)
        raise TypeError(f"{kind(value)} is neither number, text, list nor dictionary")

    try:
        return json.dumps(given, default=plain, allow_nan=False)
    except (TypeError, ValueError) as why:
        raise OmniGapError(f"{what}: {why}. Give numbers that are finite, texts, lists and dictionaries") from None


def table(given: Any, name: str) -> _omni_gap.Table:
    """A recording in memory; it is called ``name``."""
    made = _omni_gap.Table(name)
    if type(given).__module__.split(".")[0] == "pandas" and hasattr(given, "columns"):
        add_pandas(made, given)
    elif isinstance(given, Mapping):
        for column, values in given.items():
            add(made, str(column), values, name)
    elif isinstance(given, np.ndarray) and given.dtype.names:
        for column in given.dtype.names:
            add(made, column, given[column], name)
    elif hasattr(given, "__arrow_c_stream__"):
        made.add_arrow(given)
    else:
        raise OmniGapError(
            f"{name}: found {kind(given)}, expected a recording: a path, a dictionary of arrays, a frame of pandas or polars, "
            "a structured array, or a table of Arrow. Give one of these, with the columns of a run log"
        )
    return made


def add_pandas(made: _omni_gap.Table, frame: Any) -> None:
    """Adds the columns of a frame of pandas, and its index where that is the clock."""
    if frame.index.name == "t_s" and "t_s" not in frame.columns:
        add(made, "t_s", frame.index.to_numpy(), "")
    for at, column in enumerate(frame.columns):
        series = frame.iloc[:, at]
        if getattr(series.dtype, "kind", "O") in NUMBERS:
            # numbers of pandas' own kinds have holes of their own
            made.add(str(column), doubles(series.to_numpy(dtype="float64", na_value=np.nan)))
        elif getattr(series.dtype, "kind", "O") == "M":
            add(made, str(column), series.to_numpy(dtype="datetime64[ns]"), "")
        else:
            made.add_other(str(column), f"values of type {series.dtype}")


def add(made: _omni_gap.Table, column: str, values: Any, name: str) -> None:
    """Adds a column of numbers; what holds none is left out, and refused where it is asked for."""
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan)
    array = np.asarray(values)
    if array.ndim != 1:
        raise OmniGapError(
            f"{name}: column `{column}`: found an array of shape {array.shape}, expected one dimension. "
            "Give each wheel and each axis a column of its own"
        )
    if array.dtype.kind in NUMBERS:
        made.add(column, doubles(array))
    elif array.dtype.kind == "M":
        ticks = array.astype("datetime64[ns]").view(np.int64)
        whole, part = np.divmod(ticks, NANOSECONDS)
        seconds = whole.astype(np.float64) + part.astype(np.float64) / NANOSECONDS
        made.add(column, doubles(np.where(np.isnat(array), np.nan, seconds)))
    else:
        made.add_other(column, f"values of type {array.dtype}")


def doubles(array: np.ndarray) -> bytes:
    """An array's numbers as doubles, as bytes in the machine's order."""
    return array.astype(np.float64, copy=False).tobytes()


def recordings(given: SessionLike) -> list[tuple[Optional[str], Any]]:
    """The recordings of a session with their names; a path has none."""
    if is_path(given):
        return [(None, given)]
    if isinstance(given, Mapping) and given and all(is_recording(run) for run in given.values()):
        return [(None if is_path(run) else str(name), run) for name, run in given.items()]
    if isinstance(given, Sequence) and not is_recording(given):
        return [(None if is_path(run) else f"run{at:02}", run) for at, run in enumerate(given)]
    return [("run00", given)]


def is_recording(given: Any) -> bool:
    """Whether something may be a recording by itself, and is no column of one."""
    structured = isinstance(given, np.ndarray) and given.dtype.names
    frame = hasattr(given, "__arrow_c_stream__") and (hasattr(given, "columns") or hasattr(given, "schema"))
    return is_path(given) or isinstance(given, Mapping) or bool(structured) or frame or hasattr(given, "iloc") and hasattr(
        given, "columns"
    )


def session(
    given: SessionLike, of: Optional[RobotLike], columns: Any = None, name: Optional[str] = None
) -> _omni_gap.Session:
    """A session: a folder, or recordings and the robot ``of`` which they are."""
    if of is None and is_path(given) and (columns is None or is_path(columns)):
        loaded = _omni_gap.Session.load(os.fspath(given), None if columns is None else os.fspath(columns))
        return loaded if name is None else loaded.renamed(name)
    if of is None:
        raise OmniGapError(
            "robot: none was given, and only a session folder has one of its own. "
            'Name the robot file of these recordings: robot="robot.toml"'
        )
    made = _omni_gap.Session(robot(of), name)
    add_runs(made, given, columns)
    return made


def add_runs(made: _omni_gap.Session, given: SessionLike, columns: Any) -> None:
    """Adds recordings to a session, paths before those in memory."""
    runs = recordings(given)
    paths = [os.fspath(run) for name, run in runs if name is None]
    tables = [table(run, name) for name, run in runs if name is not None]
    if not runs:
        raise OmniGapError("session: there is no recording in it. Give at least one")
    if paths:
        made.add_files(paths, mapping(columns))
    if tables:
        made.add_tables(tables, mapping(columns))


def beside(given: Iterable[SessionLike], of: RobotLike, columns: Any) -> list[_omni_gap.Session]:
    """Further sessions of the same robot: session folders, run logs or folders of them, or recordings in memory."""
    if is_path(given) or isinstance(given, Mapping) or is_recording(given):
        given = [given]
    made = []
    for at, more in enumerate(given):
        if is_path(more):
            name = os.path.basename(os.path.realpath(more))
            one = _omni_gap.Session(robot(of), name)
            one.add_any(os.fspath(more), path_of(columns))
        else:
            one = _omni_gap.Session(robot(of), f"also{at:02}")
            add_runs(one, more, columns)
        made.append(one)
    return made


def path_of(columns: Any) -> Optional[str]:
    """The path of a mapping; one that is a dictionary goes with recordings in memory."""
    if columns is None or is_path(columns):
        return None if columns is None else os.fspath(columns)
    raise OmniGapError("columns: found a dictionary for recordings in files. Name a columns.toml")


def run(given: RunLike, of: _omni_gap.Robot, columns: Any = None) -> _omni_gap.Run:
    """One recording of a robot."""
    if is_path(given):
        return _omni_gap.Run.open(os.fspath(given), of, mapping(columns))
    return _omni_gap.Run.of_table(table(given, "run00"), of, mapping(columns))


def kind(given: Any) -> str:
    """What something is, for messages."""
    return f"a value of type {type(given).__name__}"
