"""What the tests of species files share."""

from collections.abc import Callable
from pathlib import Path

import pytest

from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.species import Species


@pytest.fixture
def load(tmp_path: Path) -> Callable[[str], Species]:
    """Load a species from a TOML text."""

    def load_text(text: str) -> Species:
        path = tmp_path / "own.toml"
        path.write_text(text, encoding="utf-8")
        return load_species(path)

    return load_text
