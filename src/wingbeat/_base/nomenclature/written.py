"""The one writer of numbers with errors: digits follow the error."""

from __future__ import annotations

import math

# Certified orbits agree to this share of a number, so a smaller spread is rounding.
PRECISION = 1e-6
# Numbers outside this range of powers of ten are written with an exponent.
_LOWEST, _HIGHEST = -4, 6


def written(value: float, error: float | None = None, unit: str = "", digits: int = 4) -> str:
    """Return a number with its error, both to the same decimal, which the error decides.

    The error has two significant digits if they are 10 to 35, and otherwise one: section 5.3, Rounding, of the
    introduction to the Review of Particle Physics (Particle Data Group 2024, doi 10.1103/PhysRevD.110.030001). An
    error below `PRECISION` of the value is rounding, so it is not written.

    Parameters
    ----------
    value, error : in the same unit. Without an error the value has `digits` digits; an error of not-a-number is not
        known; an infinite error means that the value is not determined.
    unit : follows the number.
    digits : significant digits of a value without error.

    Raises
    ------
    ValueError : a negative error.

    >>> written(25.1234, 0.812, "W"), written(25.1234, 0.149), written(4.99999999999999645, 8.9e-16, "Hz")
    ('25.1 +- 0.8 W', '25.12 +- 0.15', '5 Hz (no spread seen)')
    >>> written(12345.6, 967.0), written(0.0000123, 0.0000004), written(25.1234, float("nan")), written(5.04499)
    ('12300 +- 1000', '(1.23 +- 0.04)e-05', '25.12 +- ?', '5.045')
    """
    after = f" {unit}" if unit and unit != "1" else ""
    if math.isnan(value):
        return "not known"
    if error is None or math.isinf(value):
        return f"{_significant(value, digits)}{after}"
    if error < 0:
        raise ValueError(f"an error is not negative: {error}")
    if math.isnan(error):
        return f"{_significant(value, digits)} +- ?{after}"
    if math.isinf(error):
        return "not determined"
    if error <= PRECISION * abs(value):
        return f"{_significant(value, digits)}{after} (no spread seen)"
    place = _last_place(error)
    shown, power = _together([value, error], place)
    both = " +- ".join(shown)
    return f"({both})e{power:+03d}{after}" if power else f"{both}{after}"


def written_range(low: float, high: float, unit: str = "", value: float | None = None) -> str:
    """Return an interval, with the value in it if there is one, all to the decimal that half its width decides.

    Parameters
    ----------
    low, high : ends of the interval; an infinite end is left out, and not-a-number is not known.
    unit : follows the numbers.
    value : a number in the interval.

    >>> written_range(7.2134, 9.4871, "m/s", 8.5132), written_range(0.0, math.inf, "W")
    ('8.5 m/s (7.2 to 9.5)', 'at least 0 W')
    >>> written_range(-math.inf, 4.04999), written_range(3.0, 3.0, "Hz")
    ('at most 4.05', '3 Hz')
    """
    after = f" {unit}" if unit and unit != "1" else ""
    half = 0.5 * (high - low)
    if math.isnan(half) or (math.isinf(low) and math.isinf(high)):
        return "not determined" if value is None else f"{_significant(value, 4)}{after} (not determined)"
    if math.isinf(high):
        ends = f"at least {_significant(low, 4)}"
    elif math.isinf(low):
        ends = f"at most {_significant(high, 4)}"
    elif half <= PRECISION * max(abs(low), abs(high)):
        return f"{_significant(0.5 * (low + high) if value is None else value, 4)}{after}"
    else:
        numbers = [low, high] if value is None else [value, low, high]
        shown, power = _together(numbers, _last_place(half))
        shown = [f"{text}e{power:+03d}" for text in shown] if power else shown
        ends = " to ".join(shown[-2:])
        if value is not None:
            return f"{shown[0]}{after} ({ends})"
    return f"{ends}{after}" if value is None else f"{_significant(value, 4)}{after} ({ends})"


def _last_place(error: float) -> int:
    """Return the power of ten of the last digit that an error has."""
    first = math.floor(math.log10(error))
    leading = round(error / 10.0 ** (first - 2)) if first > -300 else 100
    # One digit fewer from 355 on; from 950 on that digit rounds to 10, which has two digits again.
    return first - 1 if leading < 355 else first


def _together(numbers: list[float], place: int) -> tuple[list[str], int]:
    """Return numbers rounded at a power of ten, and the exponent that they share, 0 for none."""
    largest = max(abs(rounded_at(number, place)) for number in numbers)
    top = math.floor(math.log10(largest)) if largest else place
    power = 0 if top < _HIGHEST and place >= 2 * _LOWEST and top >= _LOWEST else top
    decimals = max(power - place, 0)
    scaled = [rounded_at(number, place) / 10.0**power for number in numbers]
    return [f"{number + 0.0:.{decimals}f}" for number in scaled], power


def rounded_at(number: float, place: int) -> float:
    """Return a number rounded at a power of ten.

    >>> rounded_at(12345.6, 2), rounded_at(0.0449, -3)
    (12300.0, 0.045)
    """
    return float(round(number, -place))


def _significant(number: float, digits: int) -> str:
    """Return a number with so many significant digits, without trailing zeros, and without exponent if short."""
    if not math.isfinite(number):
        return f"{number}"
    top = math.floor(math.log10(abs(number))) if number else 0
    if not _LOWEST <= top < _HIGHEST:
        return f"{number:.{digits}g}"
    rounded = rounded_at(number, top - digits + 1)
    return f"{rounded + 0.0:.10g}"
