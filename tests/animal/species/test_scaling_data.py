"""Scaling laws outside the data they were fitted to: they warn, and their bounds of frequency leave room."""

from typing import Any

import pytest

import wingbeat as wb
from wingbeat.animal.species import scaling
from wingbeat.animal.species.writing import species_text

SIZE = {"mass": 0.3, "wing_span": 0.62, "wing_area": 0.06}
MAKERS = {"bird": wb.bird, "bat": wb.bat, "robot": wb.robot}


@pytest.mark.parametrize("kind", MAKERS)
@pytest.mark.parametrize("mass", [0.001, 0.03, 1.0, 10.0, 30.0])
def test_bounds_of_frequency_leave_room_at_any_size(kind: str, mass: float) -> None:
    """Of derived animals that fly, least frequency was 0.98 to 1.74 times Pennycuick's law; a bat had a tenth."""
    span = 1.137 * mass**0.396
    size = {"mass": mass, "wing_span": span, "wing_area": span**2 / 7}
    usual = mass**0.375 * 9.81**0.5 * span ** (-23 / 24) * (span**2 / 7) ** (-1 / 3) * 1.225**-0.375
    low, high = MAKERS[kind](**size).bounds["frequency"]
    assert low <= usual / 8 * (1 + 1e-12)
    assert high >= 4 * usual * (1 - 1e-12)


def test_a_bat_of_ten_kilograms_flies_and_warns() -> None:
    """Its law gave a stock frequency of 0.058 Hz, bounds up to 0.23 Hz, and so no orbit."""
    heavy = wb.bat(mass=10.0, wing_span=3.0, wing_area=1.5)
    (told,) = [line for line in heavy.warnings if "outside the data" in line]
    assert "wingbeat.frequency (m = 10 kg, data 0.002 to 0.87 kg)" in told
    orbit = wb.solve_orbit(wb.OrbitProblem(heavy, speed=12.0), starts=1)
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    assert told in orbit.record()["warnings"]


def test_laws_outside_their_data_warn_and_say_so_in_the_file(tmp_path: Any) -> None:
    assert not any("outside the data" in line for line in wb.bird(**SIZE).warnings)
    for kind, size, numbers in (
        (
            "bird",
            {"mass": 30.0, "wing_span": 3.0, "wing_area": 1.5},
            ("body.pitch_inertia", "wing.mass (m = 30 kg"),
        ),
        ("robot", {"mass": 1e-4, "wing_span": 0.03, "wing_area": 1e-4}, ("wing.mass", "wingbeat.frequency")),
        ("bat", {"mass": 5e-4, "wing_span": 0.1, "wing_area": 1e-3}, ("wing.mass_exponent", "wingbeat.frequency")),
    ):
        animal = MAKERS[kind](**size)
        path = tmp_path / f"{kind}.toml"
        path.write_text(species_text(animal), encoding="utf-8")
        for each in (animal, wb.load_species(path)):
            (told,) = [line for line in each.warnings if "outside the data" in line]
            assert all(number in told for number in numbers), told
        assert "wingbeat.frequency" not in " ".join(MAKERS[kind](**size, frequency=5.0).warnings)


def test_every_law_names_its_data() -> None:
    laws = {name: law for name, law in vars(scaling).items() if isinstance(law, scaling.Law)}
    for name, law in laws.items():
        assert law.data.where.strip(), name
        symbols = {pair.split()[0] for pair in law.inputs}
        assert all(low < high for low, high in law.data.ranges.values()), name
        assert symbols & law.data.ranges.keys() or not law.data.ranges, name
