"""The answer of one session."""

from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Optional

from .. import _omni_gap
from ._find import FoundSession
from ._places import Place, PlaceLike, put


class Answer:
    """The rows of a session: small, and can be pickled."""

    def __init__(self, made: _omni_gap.FleetAnswer) -> None:
        self._made = made

    @staticmethod
    def of_tables(sessions: bytes, causes: bytes, equations: bytes) -> Answer:
        """The answer whose :meth:`tables` these are.

        Raises:
            OmniGapError: Where they are not those of one session.
        """
        return Answer(_omni_gap.FleetAnswer.of(sessions, causes, equations))

    def tables(self) -> tuple[bytes, bytes, bytes]:
        """Its rows of the tables ``sessions``, ``causes`` and ``equations``, each as a Parquet file."""
        sessions, causes, equations = self._made.tables()
        return sessions, causes, equations

    @property
    def row(self) -> dict[str, Any]:
        """Its row of the table ``sessions``: verdict, causes, gap, and, where there is no answer, the reason."""
        return json.loads(self._made.row())

    def __reduce__(self) -> tuple[Any, ...]:
        return Answer.of_tables, self.tables()


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
    return None if made is None else Answer(made)


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
