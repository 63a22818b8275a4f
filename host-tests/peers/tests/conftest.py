"""What tests of the program's command line need: the program, or a reason to leave them out."""

import os
from pathlib import Path

import pytest

from peers.tool import BUILT, Tool


@pytest.fixture
def tool():
    """The program of this tree, or the one that OMNI_GAP names."""
    program = Path(os.environ.get("OMNI_GAP", BUILT))
    if not program.is_file():
        pytest.skip(f"{program} is not built")
    with Tool.found(program) as found:
        yield found
