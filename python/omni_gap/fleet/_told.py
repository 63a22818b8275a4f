"""What many robots tell together."""

from __future__ import annotations

from .. import _omni_gap
from .._results import Page
from ._places import Place, PlaceLike
from ._store import target


class FleetReport(Page):
    """What the robots of a store tell together: the page in a notebook, the words when printed, ``fleet.json`` by ``to_dict()``."""


def report(store: PlaceLike) -> FleetReport:
    """Shared causes with their probabilities, robots that stand out from their kind, and what changed when.

    Raises:
        OmniGapError: Where the store cannot be read, or holds no session.
    """
    return FleetReport(_omni_gap.fleet_told(target(Place.of(store))))
