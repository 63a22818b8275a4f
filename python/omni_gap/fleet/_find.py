"""Sessions below a folder, and copies of those that lie elsewhere."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Union

from .. import _omni_gap
from .._omni_gap import OmniGapError
from ._places import Place, PlaceLike, files_below

FILES = ("robot.toml", "columns.toml", "session.toml")
FOLDERS = ("runs", "heldout")


@dataclass(frozen=True)
class FoundSession:
    """A session below a folder."""

    name: str
    """What the tables call it."""
    place: Place
    """Its folder."""
    root: Place
    """The folder below which it was found."""

    @contextmanager
    def here(self) -> Iterator[tuple[str, str, str]]:
        """Its name, its folder and the root, on this machine: as they are, or copied for as long as the context lasts."""
        if self.place.filesystem is None:
            yield self.name, self.place.path, self.root.path
            return
        with tempfile.TemporaryDirectory(prefix="omni-gap-") as root:
            folder = os.path.join(root, *PurePosixPath(self.place.path).relative_to(self.root.path).parts)
            _copy(self.place, folder)
            yield self.name, folder, root


def find(source: Union[PlaceLike, Iterable[PlaceLike]]) -> list[FoundSession]:
    """All sessions below a folder, or below several: every folder with ``robot.toml`` and ``runs/``, in the order of their names.

    Raises:
        OmniGapError: Where a folder is none or cannot be read, or no session lies below any of them.
    """
    places = [Place.of(source)] if isinstance(source, (str, os.PathLike, tuple, Place)) else [Place.of(one) for one in source]
    here = [place.path for place in places if place.filesystem is None]
    found = {}
    for name, folder, root in _omni_gap.fleet_find(here) if here else []:
        found[name] = FoundSession(name, Place(None, folder), Place(None, root))
    for there in (place for place in places if place.filesystem is not None):
        for session_place in _sessions(_files(there), there):
            found[str(session_place)] = FoundSession(str(session_place), session_place, there)
    if not found:
        raise OmniGapError(f"{', '.join(map(str, places))}: no session lies below it: no folder has a robot.toml and runs/")
    return [found[name] for name in sorted(found)]


def _files(root: Place) -> list[str]:
    try:
        return [info.path for info in files_below(root)]
    except OSError as why:
        raise OmniGapError(f"{root}: cannot be listed: {why}") from why


def _sessions(files: list[str], root: Place) -> list[Place]:
    """The outermost folders that have both, hidden ones left out."""
    within = [PurePosixPath(path).relative_to(root.path) for path in files]
    shown = [path for path in within if not _is_hidden(path)]
    with_robot = {path.parent for path in shown if path.name == "robot.toml"}
    with_runs = {path.parents[at + 1] for path in shown for at, parent in enumerate(path.parents) if parent.name == "runs"}
    both = with_robot & with_runs
    outermost = [folder for folder in both if not both.intersection(folder.parents)]
    return [root / str(folder) if folder.parts else root for folder in outermost]


def _is_hidden(path: PurePosixPath) -> bool:
    return any(part.startswith(".") for part in path.parts)


def _copy(place: Place, folder: str) -> None:
    """Copies what a session is read from, with the times at which it was written."""
    filesystem = place.filesystem
    infos = [info for info in filesystem.get_file_info([(place / name).path for name in FILES]) if info.is_file]
    for name in FOLDERS:
        infos += files_below(place / name, may_be_missing=True)
    os.makedirs(os.path.join(folder, "runs"))
    for info in infos:
        within = PurePosixPath(info.path).relative_to(place.path)
        if _is_hidden(within):
            continue
        copy = os.path.join(folder, *within.parts)
        os.makedirs(os.path.dirname(copy), exist_ok=True)
        with filesystem.open_input_stream(info.path, compression=None) as original, open(copy, "wb") as written:
            shutil.copyfileobj(original, written, 1 << 20)
        if info.mtime_ns is not None:
            os.utime(copy, ns=(info.mtime_ns, info.mtime_ns))
