"""Files of measured flights: columns by forgiving names, units, errors; powers of two kinds are never mixed."""

import random
import re

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.places import ROOT

EXAMPLE = ROOT / "examples" / "pigeon_flights.csv"


def read(tmp_path, text):
    path = tmp_path / "mine.csv"
    path.write_text(text, encoding="utf-8")
    return wb.experiment.read_flights(path)


def refused(tmp_path, text):
    with pytest.raises(wb.InvalidInputError) as caught:
        read(tmp_path, text)
    return str(caught.value).splitlines()


def test_the_example_of_the_explorer_is_read():
    flights = wb.experiment.read_flights(EXAMPLE)
    assert flights.speed.tolist() == [4.46, 3.9]
    assert {*flights.values} == {"frequency", "mechanical_power"}
    assert flights.values["frequency"].tolist() == [8.02, 7.85]
    assert flights.errors["mechanical_power"].tolist() == pytest.approx([1.612, np.nan], nan_ok=True)
    assert flights.labels[0].startswith("3 loaded pigeons, mean and one standard deviation")
    assert flights.notes == (
        "column 'power [W]' is taken as mechanical power; call it metabolic rate if it is that",
    )


@pytest.mark.parametrize(
    ("header", "quantity"),
    [
        # As in tests/explorer/test_own_data.py.
        ("speed_m_s,frequency_hz", "frequency"),
        ("Airspeed (m/s),Wingbeat frequency [Hz]", "frequency"),
        ("flight speed [m/s],freq", "frequency"),
        ('"speed","frequency"', "frequency"),
        ("u,f", "frequency"),
        ("velocity [m s-1],wingbeat frequency [s^-1]", "frequency"),
        ("speed,aerodynamic power [W]", "mechanical_power"),
        ("speed,pectoralis power (W)", "mechanical_power"),
        ("speed,P_mech_W", "mechanical_power"),
        ("speed,metabolic power [W]", "metabolic_rate"),
        ("speed,P_met [W]", "metabolic_rate"),
        ("speed,metabolic rate [J/s]", "metabolic_rate"),
        ("speed,power input", "metabolic_rate"),
        ("speed,metabolic power of the flight muscle", "metabolic_rate"),
    ],
)
def test_headers_are_read_forgivingly(tmp_path, header, quantity):
    flights = read(tmp_path, f"{header}\n8,9.5\n10,NA\n12,9.25\n")
    assert flights.speed.tolist() == [8.0, 12.0]
    assert {name: values.tolist() for name, values in flights.values.items()} == {quantity: [9.5, 9.25]}
    assert flights.notes[-1] == "1 of 3 rows hold nothing to compare"
    units = {"speed": "m/s", "frequency": "Hz"}
    pairs = zip(header.split(","), ("speed", quantity), strict=True)
    cells = [f"{cell} ({units.get(what, 'W')})" for cell, what in pairs]
    bare = [cell.replace('"', "") for cell in cells if not re.search(r"[\])] \(|_(s|hz|W) \(", cell)]
    said = f"no unit is stated for {', '.join(bare)}; the numbers are taken in these units"
    assert flights.notes[:-1] == ((said,) if bare else ())


def test_every_column_that_is_not_read_is_named(tmp_path):
    """An error was left out without a word if the table has no column of its quantity."""
    flights = read(tmp_path, "speed [m/s],f [Hz],power sd [W],mechanical power sd [W],speed sd [m/s]\n8,9,1,1,1\n")
    assert flights.notes == (
        "column 'power sd [W]' is not read: its quantity has no column",
        "the column error of mechanical power is not read: its quantity has no column",
        "the column error of speed is not read: errors of speed are not used",
    )


def test_mechanical_and_metabolic_power_are_two_columns_with_their_own_errors(tmp_path):
    header = "speed,mechanical power,metabolic power,metabolic power sd,mechanical power se,label,mass [kg]"
    flights = read(tmp_path, f"{header}\n8,10,60,6,1,a,0.3\n12,14,,,,b,0.3\n")
    assert flights.values["mechanical_power"].tolist() == [10.0, 14.0]
    assert flights.values["metabolic_rate"].tolist() == pytest.approx([60.0, np.nan], nan_ok=True)
    assert flights.errors["mechanical_power"].tolist() == pytest.approx([1.0, np.nan], nan_ok=True)
    assert flights.errors["metabolic_rate"].tolist() == pytest.approx([6.0, np.nan], nan_ok=True)
    assert flights.labels == ("a", "b")
    assert flights.notes == (
        "column 'mass [kg]' is not read",
        "no unit is stated for speed (m/s), mechanical power (W), metabolic power (W); the numbers are taken in "
        "these units",
    )


def test_separators_and_decimal_commas_are_read_and_said(tmp_path):
    flights = read(tmp_path, "speed [m/s];f [Hz];label\n7,5;8,25;a\n12;9;b\n")
    assert (flights.speed.tolist(), flights.values["frequency"].tolist()) == ([7.5, 12.0], [8.25, 9.0])
    assert flights.labels == ("a", "b")
    assert flights.notes[0] == "read with semicolons between the columns and decimal commas"
    assert read(tmp_path, "u\tf\n8\t9.5\n").values["frequency"].tolist() == [9.5]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("speed [km/h],f\n30,8\n", "is not in m/s; divide by 3.6, and write [m/s]"),
        ("speed_km_h,f\n30,8\n", "is not in m/s; divide by 3.6, and write [m/s]"),
        ("speed,f [rpm]\n8,480\n", "is not in Hz; divide by 60, and write [Hz]"),
        (
            "speed,metabolic power [W/kg]\n8,40\n",
            "is not in W; multiply by the mass [kg], of the body or of",
        ),
        ("speed,power [mW]\n8,40\n", "is not in W; divide milliwatts by 1000"),
        ("speed,power,power sd,metabolic power,sd\n8,40,1,60,2\n", "'sd': may be the error of mechanical power or"),
        (
            "speed,mechanical power,metabolic power,power sd\n8,4,6,1\n",
            "'power sd': may be the error of mech",
        ),
        ("speed,metabolic mechanical power\n8,4\n", "names both kinds of power"),
        (
            "speed,power,total power\n8,4,6\n",
            "second column of mechanical power; keep one; is one of them the",
        ),
        ("speed,airspeed,f\n8,9,7\n", "is a second column of speed"),
        ("ground speed,f\n8,7\n", "has no column of airspeed"),
        ("speed,mass\n1,2\n", "has no column to compare with a curve; name one frequency [Hz]"),
        ("speed,f\n8,x\n", "row 2, column f = 'x': is not a number"),
        ("speed,f\n,8\n", "row 2, column speed = '': is empty"),
        ("speed,f\n8,-8\n", "row 2, column f = -8.0: must be >= 0; is the sign right?"),
        ("speed,f\n8,0\n", "must be > 0 Hz; leave the cell empty"),
        ("speed,f\n900,8\n", "must be at most 200 m/s; is it in km/h? divide by 3.6"),
        ("speed,f\n8,NA\n", "no row has a speed and a number to compare"),
        ("speed,f\n" + "8,9\n" * 5001, "has 5001 rows; at most 5000 are read"),
    ],
)
def test_what_cannot_be_compared_is_refused_with_the_fix(tmp_path, text, told):
    assert told in "\n".join(refused(tmp_path, text))


def test_all_faults_of_the_rows_are_reported_at_once(tmp_path):
    assert len(refused(tmp_path, "speed,f,power\n8,x,-1\n,7,\n300,1,1\n")) == 4


def test_a_fast_bird_is_asked_for_its_unit(tmp_path):
    (note,) = read(tmp_path, "speed [m/s],f [Hz]\n72,8\n").notes
    assert note == "the fastest speed, 72 m/s, is that of no level flight of an animal: is it in km/h?"


def test_mutilated_files_are_refused_or_read_with_nothing_else_than_they_hold(tmp_path):
    """No traceback; and a number that is read stands in the file."""
    draw, whole, read_ones = random.Random(56), EXAMPLE.read_text(encoding="utf-8"), 0
    for _ in range(300):
        text = whole
        for _ in range(draw.randint(1, 3)):
            at, length = draw.randrange(len(text)), draw.randint(1, 12)
            put = draw.choice(["", ",", ";", "\t", '"', "\n", "-", "e", "9", "NA", "\x00", "µ", text[at : at + 30]])
            text = text[:at] + put + text[at + draw.choice([0, length]) :]
        try:
            flights = read(tmp_path, text)
        except wb.WingbeatError:
            continue
        read_ones += 1
        for values in (flights.speed, *flights.values.values(), *flights.errors.values()):
            for value in values[np.isfinite(values)].tolist():
                cells = [cell for cell in text.replace("\n", ",").replace('"', "").split(",")]
                assert any(cell.strip() and _same(cell, value) for cell in cells), (text, value)
    assert read_ones > 30


def _same(cell, value):
    try:
        return float(cell) == value
    except ValueError:
        return False
