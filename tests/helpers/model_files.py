"""Model files of coefficients that somebody spoilt."""

import pytest

from wingbeat._base import InvalidInputError
from wingbeat.aero import load_coefficients


def assert_refused(model, change, told):
    """Check that a file is refused with all these words after a `change`: old and new text, with a bar between."""
    old, new = change.split("|")
    text = model.read_text()
    assert old in text
    model.write_text(text.replace(old, new))
    with pytest.raises(InvalidInputError) as caught:
        load_coefficients(model)
    for words in told:
        assert words in str(caught.value)
