"""``wingbeat simulate`` through moving air: `--gust` and `--turbulence`."""

import json
import math

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from wingbeat.cli import main


@pytest.fixture(scope="module")
def orbit_file(pigeon_orbit, tmp_path_factory):
    path = tmp_path_factory.mktemp("winds") / "orbit.nc"
    pigeon_orbit.orbit.save(path)
    return str(path)


def flown(capsys, *asked):
    code = main(["simulate", *asked, "--beats", "2", "--json"])
    return code, json.loads(capsys.readouterr().out)["beats"][-1]


@pytest.mark.slow
def test_gust_and_turbulence_are_those_of_the_library(orbit_file, pigeon_orbit, capsys, tmp_path):
    file = str(tmp_path / "flight.nc")
    asked = ["--gust", "w=2", "start=0.05", "duration=0.1", "--turbulence", "moderate", "--wind-seed", "5"]
    code, last = flown(capsys, "--from", orbit_file, *asked, "-o", file)
    assert code == 0
    start = wb.State(*pigeon_orbit.start)
    gust = wb.winds.CosineGust(w=2.0, start=0.05, duration=0.1)
    turbulence = wb.winds.DrydenTurbulence(math.hypot(start.u, start.w), "moderate", seed=5)
    with xr.open_dataset(file, engine="h5netcdf") as saved:
        times = saved["time"].values
        for i, name in enumerate(("air_u", "air_w")):
            assert np.allclose(saved[name], gust(times)[i] + turbulence(times)[i], rtol=0, atol=1e-12)
        assert float(saved["w"][-1]) == last["w"]
    still = flown(capsys, "--from", orbit_file)[1]
    assert abs(last["w"] - still["w"]) > 0.05


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (["--gust", "w"], "must be NAME=VALUE with a number"),
        (["--gust", "w=2", "w=3"], "is given twice"),
        (["--gust", "v=2"], "use one of u, w, start, duration"),
        (["--gust", "w=nan"], "gust.w"),
        (["--gust", "w=2", "duration=0"], "gust.duration"),
        (["--turbulence", "wild"], "use one of light, moderate, severe"),
        (["--turbulence", "light", "--wind-seed", "-1"], "turbulence.seed"),
        (["--turbulence", "light", "--u", "0"], "turbulence.airspeed"),
    ],
)
def test_bad_winds_get_their_sentence(asked, said, capsys):
    assert main(["simulate", "pigeon", *asked]) == 2
    assert said in capsys.readouterr().err
