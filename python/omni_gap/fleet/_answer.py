"""The answer of one session."""

from __future__ import annotations

import json
import os
import tempfile
from dataclasses import dataclass
from typing import Any, Optional

from .. import _omni_gap
from ._find import FoundSession
from ._places import Place, PlaceLike, put


@dataclass(frozen=True)
class Answer:
    """The rows of a session: small, and can be pickled."""

    sessions: bytes
    """Its row of the table ``sessions``, as a Parquet file."""
    causes: bytes
    """Its rows of the table ``causes``."""
    equations: bytes
    """Its rows of the table ``equations``."""
    json: str
    """The same row as JSON."""

    @property
    def row(self) -> dict[str, Any]:
        """The same row: verdict, causes, gap, and, where there is no answer, the reason."""
        return json.loads(self.json)


def answer(session: FoundSession, held: Optional[str] = None, store: Optional[PlaceLike] = None) -> Optional[Answer]:
    """Diagnoses a session on one thread, without the interpreter's lock; nothing that it has wrong raises anything.

    Args:
        session: The session.
        held: The key of the answer that the store holds (:meth:`Store.key`): where the session is as it was then, None is returned.
        store: Where its report is put, below ``reports/``; nowhere unless said.
    """
    try:
        with session.here() as here:
            made = _made(here, held, None if store is None else Place.of(store))
    except OSError as why:
        made = _omni_gap.fleet_unreadable((session.name, session.place.path, session.root.path), str(why))
    if made is None:
        return None
    return Answer(*made.tables(), made.row())


def _made(here: tuple[str, str, str], held: Optional[str], store: Optional[Place]) -> Optional[_omni_gap.FleetAnswer]:
    if store is None or store.filesystem is None:
        return _omni_gap.fleet_answer(here, held, None if store is None else store.path)
    with tempfile.TemporaryDirectory(prefix="omni-gap-") as kept:
        made = _omni_gap.fleet_answer(here, held, kept)
        for folder, _, files in os.walk(kept):
            for name in files:
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    put(store / os.path.relpath(path, kept).replace(os.sep, "/"), file.read())
        return made
