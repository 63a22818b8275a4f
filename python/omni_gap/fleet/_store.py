"""The tables of a fleet."""

from __future__ import annotations

import posixpath
from types import TracebackType
from typing import Optional

from .. import _omni_gap
from ._answer import Answer
from ._places import Place, PlaceLike, files_below, put


class Store:
    """The tables of a fleet, to write to as the only one::

        with Store("season") as store:
            for session in find("logs"):
                found = answer(session, store.key(session.name))
                if found is not None:
                    store.put(found)

    A file of a table is whole or as it was, whenever this ends. In a folder of this machine a second writer is refused; elsewhere
    nothing can tell, so let one program write.

    Args:
        place: A folder, a URI, or a filesystem and a path in it; made if need be.

    Raises:
        OmniGapError: Where somebody else writes to it, or it cannot be read or made.
    """

    def __init__(self, place: PlaceLike) -> None:
        self._store = _omni_gap.FleetStore(target(Place.of(place)))

    def key(self, session: str) -> Optional[str]:
        """The key of the answer that it holds of a session: the hash of all that this answer rests on."""
        return self._store.key(session)

    def put(self, answer: Answer) -> None:
        """Takes an answer up, in place of what it holds of the same session; it is written a few seconds later."""
        self._store.put(answer._made)

    def close(self) -> None:
        """Writes what waits, and lets others write."""
        self._store.close()

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self, kind: Optional[type[BaseException]], why: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()


def target(place: Place) -> object:
    """What the compiled part writes to and reads from."""
    return place.path if place.filesystem is None else _Files(place)


class _Files:
    """Files by name below a place elsewhere."""

    def __init__(self, root: Place) -> None:
        self._root = root
        self._filesystem = root.filesystem

    def _path(self, name: str) -> str:
        return (self._root / name).path

    def place(self, name: str) -> str:
        return str(self._root / name) if name else str(self._root)

    def files(self, folder: str) -> list[str]:
        infos = files_below(self._root / folder, may_be_missing=True)
        return sorted(posixpath.relpath(info.path, self._root.path) for info in infos)

    def read(self, name: str) -> Optional[bytes]:
        try:
            with self._filesystem.open_input_stream(self._path(name), compression=None) as file:
                return file.read()
        except FileNotFoundError:
            return None

    def write(self, name: str, content: bytes) -> None:
        put(self._root / name, content)

    def remove(self, name: str) -> None:
        from pyarrow.fs import FileType

        path = self._path(name)
        kind = self._filesystem.get_file_info(path).type
        if kind == FileType.File:
            self._filesystem.delete_file(path)
        elif kind == FileType.Directory:
            self._filesystem.delete_dir(path)
