"""Folders here and elsewhere."""

from __future__ import annotations

import os
import posixpath
from dataclasses import dataclass
from typing import Any, Union

from .._omni_gap import OmniGapError

PlaceLike = Union[str, "os.PathLike[str]", tuple[Any, str], "Place"]
"""A folder: a path, a URI, or a pair of a filesystem (of pyarrow or fsspec) and a path in it."""


@dataclass(frozen=True)
class Place:
    """A folder."""

    filesystem: Any
    """A filesystem of pyarrow; None where it is this machine's own."""
    path: str
    """Its path there."""

    @staticmethod
    def of(place: PlaceLike) -> Place:
        """The folder that is meant.

        Raises:
            OmniGapError: Where a URI cannot be understood, or pyarrow is missing.
        """
        if isinstance(place, Place):
            return place
        if isinstance(place, tuple):
            filesystem, path = place
            return Place(_of_pyarrow(filesystem), path.rstrip("/"))
        text = os.fspath(place)
        if "://" not in text:
            return Place(None, text)
        pyarrow_fs = _pyarrow_fs(text)
        try:
            filesystem, path = pyarrow_fs.FileSystem.from_uri(text)
        except Exception as why:
            raise OmniGapError(f"{text.split('?')[0]}: no place that pyarrow can open: {why}") from why
        return Place(filesystem, path.rstrip("/"))

    def __truediv__(self, name: str) -> Place:
        """What lies in it."""
        join = os.path.join if self.filesystem is None else posixpath.join
        return Place(self.filesystem, join(self.path, name))

    def __str__(self) -> str:
        """Its name, without anything secret that its URI may have had."""
        if self.filesystem is None:
            return self.path
        return f"{self.filesystem.type_name.rpartition('+')[2]}://{self.path}"  # one of fsspec is "py::fsspec+memory"


def files_below(place: Place, *, may_be_missing: bool = False) -> list[Any]:
    """What pyarrow tells of every file below a folder elsewhere."""
    pyarrow_fs = _pyarrow_fs(str(place))
    selector = pyarrow_fs.FileSelector(place.path, recursive=True, allow_not_found=may_be_missing)
    return [info for info in place.filesystem.get_file_info(selector) if info.is_file]


OBJECT_STORES = ("s3", "gcs", "abfs")
"""Where a file that is being written is not there before it is whole, and folders are parts of names."""


def put(place: Place, content: bytes) -> None:
    """Puts bytes in place of a file elsewhere: whoever reads finds all of them, or what was there before."""
    filesystem = place.filesystem
    if filesystem.type_name in OBJECT_STORES:
        with filesystem.open_output_stream(place.path, compression=None) as file:
            file.write(content)
        return
    folder, name = posixpath.split(place.path)
    filesystem.create_dir(folder, recursive=True)
    unfinished = posixpath.join(folder, f".omni-gap-{name}")
    with filesystem.open_output_stream(unfinished, compression=None) as file:
        file.write(content)
    filesystem.move(unfinished, place.path)


def _of_pyarrow(filesystem: Any) -> Any:
    pyarrow_fs = _pyarrow_fs("a filesystem")
    if isinstance(filesystem, pyarrow_fs.FileSystem):
        return filesystem
    return pyarrow_fs.PyFileSystem(pyarrow_fs.FSSpecHandler(filesystem))


def _pyarrow_fs(place: str) -> Any:
    try:
        import pyarrow.fs
    except ImportError as why:
        raise OmniGapError(f"{place}: places other than folders of this machine need pyarrow: pip install omni-gap[fleet]") from why
    return pyarrow.fs
