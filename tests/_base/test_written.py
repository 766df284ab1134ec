"""Numbers with errors: the printed digits follow the error, and read back to what was meant."""

import math
import re

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from wingbeat._base import PRECISION, written, written_range

SIZES = st.floats(-9.0, 9.0).map(lambda power: 10.0**power)
VALUES = st.builds(lambda size, sign: sign * size, SIZES, st.sampled_from([-1.0, 0.0, 1.0]))


def parts(text):
    """Return a printed value and its error as numbers, and the size of the last digit of each as printed."""
    found = re.fullmatch(r"\(?(-?[\d.]+)(?: \+- ([\d.]+))?\)?(?:e([+-]\d+))?", text)
    assert found, text
    factor = 10.0 ** int(found[3] or 0)
    numbers = [number for number in found.groups()[:2] if number is not None]
    places = [factor * 10.0 ** -len(number.partition(".")[2]) for number in numbers]
    return [factor * float(number) for number in numbers], places, numbers


@settings(max_examples=400, deadline=None)
@given(VALUES, SIZES)
def test_value_and_error_read_back_and_share_their_last_decimal(value, error):
    assume(error > 1.001 * PRECISION * abs(value))
    (shown, bar), (place, other), (_, digits) = parts(written(value, error))
    assert place == other
    significant = digits.replace(".", "").lstrip("0")
    kept = significant if "." in digits else significant.rstrip("0")  # zeros of a whole number only hold its place
    last = place * 10.0 ** (len(significant) - len(kept))
    assert abs(shown - value) <= 0.5001 * last
    assert abs(bar - error) <= 0.5001 * last
    assert 1 <= len(kept) <= 2
    assert len(kept) == 1 or int(kept) <= 35
    assert abs(bar - error) <= 0.15 * error  # one digit is at least 4 of them, or two


@settings(max_examples=200, deadline=None)
@given(VALUES)
def test_a_value_without_error_has_four_digits(value):
    text = written(value)
    assert float(text) == pytest.approx(value, rel=0.6e-3)
    assert len(re.sub(r"e.*|[-.]", "", text).strip("0")) <= 4


@settings(max_examples=200, deadline=None)
@given(VALUES, SIZES, st.floats(0.0, 1.0))
def test_an_interval_reads_back_within_a_part_of_its_width(low, width, share):
    assume(width > 10 * PRECISION * (abs(low) + width))
    value = low + share * width
    text = written_range(low, low + width, "m/s", value)
    shown, first, last = re.fullmatch(r"(\S+) m/s \((\S+) to (\S+)\)", text).groups()
    for printed, meant in ((shown, value), (first, low), (last, low + width)):
        assert abs(float(printed) - meant) <= 0.15 * 0.5 * width


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (4.99999999999999645, 8.9e-16, "5 Hz (no spread seen)"),
        (5.044987, 0.0, "5.045 Hz (no spread seen)"),
        (0.0, 0.0, "0 Hz (no spread seen)"),
        (5.0, 3e-4, "5.00000 +- 0.00030 Hz"),
        (1.1, 16.2, "1 +- 16 Hz"),
        (-0.001, 0.3, "0.00 +- 0.30 Hz"),
        (9.4876, 0.0994, "9.49 +- 0.10 Hz"),
        (9.4876, 0.0354, "9.488 +- 0.035 Hz"),
        (9.4876, 0.0356, "9.49 +- 0.04 Hz"),
        (12345.6, 967.0, "12300 +- 1000 Hz"),
        (math.nan, 0.1, "not known"),
        (3.0, math.nan, "3 +- ? Hz"),
        (3.0, math.inf, "not determined"),
        (9.48761, None, "9.488 Hz"),
        (123456.0, None, "123500 Hz"),
    ],
)
def test_numbers_that_once_went_wrong(value, error, text):
    assert written(value, error, "Hz") == text


def test_one_sided_and_empty_intervals():
    assert written_range(-math.inf, 4.04, "m/s") == "at most 4.04 m/s"
    assert written_range(4.04, math.inf, "m/s") == "at least 4.04 m/s"
    assert written_range(math.nan, 4.0, "m/s") == "not determined"
    assert written_range(math.nan, math.nan, value=4.0) == "4 (not determined)"
    assert written_range(4.0, 4.0 + 1e-9, "m/s", 4.0) == "4 m/s"
    with pytest.raises(ValueError, match="negative"):
        written(1.0, -0.1)
