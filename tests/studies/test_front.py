"""The Pareto front of a study, against its definition; and what its library does with numbers of failed points."""

import itertools

import moocore
import numpy as np
import pandas as pd
import pytest

import wingbeat as wb
from wingbeat.studies.front import front_of, front_report

BEST = {"speed": "max", "electrical_power": "min", "payload": "max"}


def table(seed=0, count=60):
    """A grid of speeds and payloads with powers that are least in the middle, some of them without an orbit."""
    random = np.random.default_rng(seed)
    speed, payload = np.array(list(itertools.product(np.linspace(4, 10, count // 5), np.linspace(0, 0.1, 5)))).T
    power = 20 + (speed - 6) ** 2 + 150 * payload + random.uniform(0, 3, speed.size)
    status = np.where(random.random(speed.size) < 0.8, "converged", "infeasible")
    power = np.where(status == "converged", power, np.nan)
    columns = {"status": status, "speed": speed, "electrical_power": power, "payload": payload}
    return pd.DataFrame({"key": np.arange(speed.size), **columns})


def by_definition(frame):
    good = frame[frame["status"] == "converged"]
    cost = np.stack([-good["speed"], good["electrical_power"], -good["payload"]], axis=1)
    beaten = [any((other <= own).all() and (other < own).any() for other in cost) for own in cost]
    return set(good["key"][~np.array(beaten)])


@pytest.mark.parametrize("seed", range(5))
def test_no_other_point_beats_those_of_the_front(seed):
    frame = table(seed)
    front = front_of(frame, BEST)
    assert set(front["key"]) == by_definition(frame)
    assert 5 < len(front) < front.attrs["certified"] < len(frame)
    assert (np.diff(front["speed"]) <= 0).all()


def test_contributions_and_the_whole_share_are_volumes_of_the_box():
    """By counting cells of a fine grid of the box, which ends 10 % beyond the worst values."""
    frame = table()
    front = front_of(frame, BEST)
    good = frame[frame["status"] == "converged"]

    def scaled(rows):
        cost = np.stack([-rows["speed"], rows["electrical_power"], -rows["payload"]], axis=1)
        all_of = np.stack([-good["speed"], good["electrical_power"], -good["payload"]], axis=1)
        return (cost - all_of.min(axis=0)) / np.ptp(all_of, axis=0)

    centres = (np.arange(110) + 0.5) / 100
    cells = np.stack(np.meshgrid(centres, centres, centres, indexing="ij"), axis=-1).reshape(-1, 3)
    counts = sum((cells >= point).all(axis=1).astype(int) for point in scaled(front))
    assert front.attrs["hypervolume"] == pytest.approx((counts > 0).mean(), abs=0.01)
    for point, share in zip(scaled(front), front["contribution"], strict=True):
        alone = (cells >= point).all(axis=1) & (counts == 1)
        assert share == pytest.approx(alone.mean(), abs=2e-3)


def test_equal_designs_are_all_kept_and_rounding_beats_nobody():
    """The library drops the second of two equal points by default, and one that is worse in the last digit."""
    frame = table().iloc[[7, 7, 7]].assign(status="converged", electrical_power=[30.0, 30.0, 30.0 * (1 + 1e-12)])
    assert len(front_of(frame, BEST)) == 3
    assert moocore.is_nondominated(frame[["speed", "electrical_power"]].to_numpy()).sum() == 1


def test_the_library_lets_not_a_number_beat_every_number():
    """So a design without an orbit would empty the front; we had guessed that it would be left out, or refused."""
    points = np.array([[1.0, 2.0], [np.nan, 0.0], [2.0, 1.0], [3.0, 3.0]])
    assert moocore.is_nondominated(points).tolist() == [False, True, False, False]
    frame = pd.DataFrame(points, columns=["speed", "electrical_power"]).assign(status="converged")
    ours = front_of(frame, {"speed": "min", "electrical_power": "min"})
    assert ours["speed"].tolist() == [1.0, 2.0]


def test_the_whole_mass_can_be_wanted():
    frame = table().assign(**{"vehicle.body.mass": 0.2, "vehicle.wing.mass": np.linspace(0.02, 0.01, 60)})
    front = front_of(frame, {"mass": "min", "electrical_power": "min"})
    assert front["mass"].iloc[0] == pytest.approx(0.2 + 2 * front["vehicle.wing.mass"].min())
    lines = front_report(front, {"mass": "min", "electrical_power": "min"}, ["vehicle.wing.mass"])
    assert "least mass, least electrical power" in lines[0].text


def test_a_study_without_a_certified_point_has_an_empty_front():
    front = front_of(table().assign(status="infeasible"), BEST)
    assert (len(front), front.attrs["hypervolume"]) == (0, 0.0)


@pytest.mark.parametrize(
    ("best", "says"),
    [
        ({"speed": "max"}, "at least two"),
        ({"speed": "most", "payload": "max"}, "must be min or max"),
        ({"speed": "max", "electric_power": "min"}, "did you mean electrical_power"),
        ({"speed": "max", "status": "min"}, "no column of numbers"),
        ({"speed": "max", "mass": "min"}, "no column of numbers"),
        ("speed", "at least two"),
    ],
)
def test_what_is_no_choice_of_quantities_is_refused(best, says):
    with pytest.raises(wb.InvalidInputError, match=says):
        front_of(table(), best)
