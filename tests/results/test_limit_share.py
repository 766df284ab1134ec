"""What a limit has set is said to be set by the limit, also where there are random draws: it has no error bar."""

import types

import numpy as np
import pytest

from wingbeat.cli.filmed import spread_lines, spread_record
from wingbeat.records.shares import limit_share
from wingbeat.results.spread import Spread


@pytest.mark.parametrize(
    ("values", "held", "text"),
    [
        ([5.045] * 4, [1, 1, 1, 1], "set by the limit 5.045 Hz in 100 % of the samples"),
        ([5.045, 5.045000001, 30.0], [1, 1, 1], "set by the limits 5.045 and 30 Hz in 100 % of the samples"),
        (
            [5.045, 5.045, 5.3, 5.9],
            [1, 1, 0, 0],
            "set by the limit 5.045 Hz in 50 % of the samples, 5.30 to 5.90 ",
        ),
        ([5.0, 5.3, 5.9, 6.0], [1, 0, 0, 0], "5.5 +- 0.4 Hz, set by the limit 5 Hz in 25 % of the samples"),
        ([5.1, 5.3, 5.9, 6.0], [0, 0, 0, 0], "5.5 +- 0.4 Hz"),
        ([5.045] * 4, [0, 0, 0, 0], "5.045 Hz (no spread seen)"),
        ([5.045] * 399 + [5.1], [1] * 399 + [0], "set by the limit 5.045 Hz in 99 % of the samples, 5.1 Hz in the"),
    ],
)
def test_the_share_of_draws_at_a_limit_decides_what_is_printed(values, held, text):
    values, held = np.array(values), np.array(held, dtype=bool)
    error = 0.4 if np.ptp(values) > 0.1 else 9e-16
    value = 5.5 if error == 0.4 else 5.045
    shown = limit_share(values, held).shown(value, error, "Hz")
    assert shown.startswith(text)
    assert ("+-" in shown) is text.startswith("5.5")


def test_a_film_whose_draws_are_all_at_a_bound_has_no_error_bar_there():
    values = {name: np.array([9.0, 9.4, 9.9]) for name in ("mean_power", "mean_positive_power", "peak_power")}
    values |= {"wingbeat.pitch_mean": np.full(3, np.radians(40.0))}
    held = {name: np.zeros(3, dtype=bool) for name in values} | {"wingbeat.pitch_mean": np.ones(3, dtype=bool)}
    estimates = {name: float(column[1]) for name, column in values.items()}
    record = {name: value for name, value in estimates.items()} | {"wingbeat": {"pitch_mean": np.radians(40.0)}}
    orbit = types.SimpleNamespace(record=lambda: record, problem=types.SimpleNamespace(free=("pitch_mean",)))
    spread = Spread(values, estimates, 3, held)
    *lines, _ = spread_lines(spread, orbit)
    assert lines[-1] == "trimmed pitch mean: set by the limit 40 deg in 100 % of the samples"
    assert all(line.endswith(": 9.4 +- 0.4 W") for line in lines[:-1])
    assert spread_record(spread)["set_by_limit"] == {"wingbeat.pitch_mean": 1.0}
    assert Spread(values, estimates, 3).limited("wingbeat.pitch_mean").share == 0.0
