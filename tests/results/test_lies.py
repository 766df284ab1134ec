"""Result files that lie: changed after they were written, or forged with a digest that fits. None is believed."""

import json
import shutil
import subprocess
import sys

import h5py
import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from wingbeat._base import FileError
from wingbeat.cli import main
from wingbeat.records import result_files as declared
from wingbeat.records.agreement import check_newton
from wingbeat.records.forms import inputs_hash
from wingbeat.records.result_files import digest, load_dataset, netcdf_bytes, save_result

CHANGED, SEED = 150, 54
MEASURED = """
import sys, time
from pathlib import Path
from wingbeat._base import FileError
from wingbeat.records.result_files import load_dataset
begun = time.perf_counter()
try:
    load_dataset(sys.argv[1])
except FileError as error:
    seconds = time.perf_counter() - begun
    # The peak of this process alone; that of `resource` begins with the peak of the process that started it.
    peak = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM"))
    print(seconds, int(peak.split()[1]) / 1024, error)
"""


@pytest.fixture(scope="module")
def saved(pigeon_orbit, tmp_path_factory):
    """Return the files of an orbit, a flight and a curve."""
    folder = tmp_path_factory.mktemp("saved")
    orbit, problem = pigeon_orbit.orbit, pigeon_orbit.problem
    results = {
        "orbit": orbit,
        "flight": wb.simulate(problem.model, orbit.wingbeat, orbit.initial_state, 1, 64, species=problem.species),
        "curve": wb.solve_curve(problem, [10.0, 11.0], starts=1),
    }
    for kind, result in results.items():
        result.save(folder / f"{kind}.nc")
    return {kind: folder / f"{kind}.nc" for kind in results}


@pytest.fixture(scope="module")
def good(saved):
    return {kind: load_dataset(path) for kind, path in saved.items()}


def change(path, random):
    """Change one thing in a result file, chosen at random, and say what."""
    with h5py.File(path, "r+") as file:
        arrays = [
            name for name, item in file.items() if item.dtype.kind in "fi" and item.size and "units" in item.attrs
        ]
        name = str(random.choice(arrays))
        item, act = file[name], int(random.integers(8))
        own = [name for name in file.attrs if not name.startswith("_")]
        if act == 0:
            values = item[...]
            place = tuple(int(random.integers(n)) for n in values.shape)
            values[place] = 1 if values[place] != values[place] else values[place] + 1
            item[...] = values
        elif act == 1:
            item[...] = item[...] * 2 + 1
        elif act == 2:
            item.attrs["units"] = np.bytes_("furlong")
        elif act == 3:
            del file[name]
        elif act == 4:
            item.attrs["add_offset"] = 1.0
        elif act == 5:
            file["extra"] = item[...]
        elif act == 6:
            other = str(random.choice([n for n in own if isinstance(file.attrs[n], bytes)]))
            text = bytearray(file.attrs[other])
            text[int(random.integers(len(text)))] ^= 1
            file.attrs[other], name = np.bytes_(bytes(text)), other
        else:
            other = str(random.choice(own))
            del file.attrs[other]
            name = other
        return act, name


@pytest.mark.slow
def test_no_changed_file_is_believed(saved, tmp_path):
    """Numbers, units, texts, whole arrays and attributes, added or taken away: each is noticed."""
    random, path = np.random.default_rng(SEED), tmp_path / "changed.nc"
    kinds = random.choice(["orbit", "flight", "curve"], CHANGED)
    for kind in kinds:
        shutil.copy(saved[str(kind)], path)
        what = change(path, random)
        with pytest.raises(FileError, match="cannot read"):
            pytest.fail(f"{kind}, {what} is believed: {load_dataset(path).attrs['wingbeat_kind']}")


def attributes(**changed):
    """Return a forger's act that replaces attributes; functions are given what the JSON text holds."""

    def act(dataset):
        new = {}
        for name, value in changed.items():
            old = dataset.attrs[name]
            whole = value(json.loads(old)) if callable(value) else value
            new[name] = whole if isinstance(old, str) and not callable(value) else json.dumps(whole)
            if not isinstance(old, str):
                new[name] = value
        if "inputs" in new:
            new["inputs_hash"] = inputs_hash(json.loads(new["inputs"]))
        return dataset.assign_attrs(new)

    return act


def series(**changed):
    """Return a forger's act that replaces series by functions of themselves."""
    return lambda dataset: dataset.assign({n: (dataset[n].dims, f(dataset[n].values)) for n, f in changed.items()})


def both(*acts):
    def act(dataset):
        for one in acts:
            dataset = one(dataset)
        return dataset

    return act


def halved(value):
    return value * 0.5


def unknown(values):
    return values * np.nan


def with_entry(**entry):
    return lambda known: known | entry


FORGED = {
    "orbit": {
        "half the power in the record": attributes(mean_power=20.0),
        "a lower peak": attributes(peak_power=1.0),
        "cheaper transport": attributes(cost_of_transport=0.1),
        "stable": attributes(stable=lambda _: True),
        "another species": attributes(species="eagle"),
        "another speed": attributes(speed=14.0),
        "another mass": attributes(vehicle=lambda v: v | {"body": v["body"] | {"mass": 0.2}}),
        "another mass in the inputs too": attributes(
            vehicle=lambda v: v | {"body": v["body"] | {"mass": 0.2}},
            inputs=lambda i: i | {"vehicle": i["vehicle"] | {"body": i["vehicle"]["body"] | {"mass": 0.2}}},
        ),
        "another air": attributes(
            air=with_entry(viscosity=2e-5), inputs=lambda i: i | {"air": i["air"] | {"viscosity": 2e-5}}
        ),
        "another frequency": attributes(wingbeat=with_entry(frequency=6.0)),
        "another amplitude": attributes(wingbeat=with_entry(flap_amplitude=0.6)),
        "another pitch": attributes(wingbeat=with_entry(pitch_amplitude=0.1)),
        "another state": attributes(initial_state=with_entry(u=9.0)),
        "a closure of zero": attributes(closure=lambda c: dict.fromkeys(c, 0.0)),
        "an infeasible one": attributes(status="infeasible"),
        "no warnings": attributes(
            warnings=lambda _: [], inputs=lambda i: i | {"species": i["species"] | {"warnings": ["tiny"]}}
        ),
        "all plausible": attributes(plausibility=lambda p: [one | {"within": True} for one in p]),
        "judged by other ranges": attributes(plausibility=lambda p: [one | {"high": None} for one in p]),
        "not judged": attributes(plausibility=lambda p: p[:2]),
        "half the power in the series": series(hinge_power=halved),
        "half of all powers": both(
            series(**{f"{name}_power": halved for name in ("hinge", "aerodynamic", "inertial", "body")}),
            series(flap_torque=halved, pitch_torque=halved),
        ),
        "another height": series(z=lambda z: z + np.sin(np.pi * np.linspace(0, 1, z.size)) ** 2),
        "another force": series(force_z=lambda f: f * 1.1),
        "another attitude": series(alpha=halved),
        "an active bound not listed": attributes(active_bounds=lambda _: []),
        "a bound that is not reached": attributes(active_bounds=lambda names: [*names, "pitch_mean"]),
        "a bound of something else": attributes(active_bounds=lambda names: [*names, "peak_power<=9"]),
        "beyond its bounds": attributes(inputs=lambda i: i | {"bounds": i["bounds"] | {"frequency": [1.0, 2.0]}}),
        "another span": series(span_ratio=halved),
        "no number at the end": series(
            alpha=lambda a: np.where(np.arange(len(a))[:, None] < len(a) - 1, a, np.nan)
        ),
        "inputs without bounds": attributes(inputs=lambda i: i | {"bounds": {}}),
    },
    "curve": {
        "another objective": series(objective_value=halved),
        "another amplitude": series(flap_amplitude=halved),
        "a closure that is no number": series(closure_z=unknown),
        "a pitch that is no number": series(pitch_mean=unknown),
        "an active bound not listed": series(active_bounds=lambda names: np.full(names.shape, "")),
        "a gap closed": series(status=lambda s: np.array(["infeasible", *s[1:]])),
        "cheaper transport": series(mean_positive_power=halved),
    },
    "flight": {
        "half the power": series(hinge_power=halved),
        "another wingbeat": attributes(wingbeat=with_entry(flap_mean=0.5)),
        "another fold": series(fold=lambda fold: fold + 0.1),
        "another pace": series(time=lambda time: time * 1.1),
        "no numbers": series(lift=unknown),
    },
}
CASES = [(kind, name) for kind, acts in FORGED.items() for name in acts]


@pytest.mark.parametrize(("kind", "name"), CASES, ids=[f"{kind}-{name}".replace(" ", "-") for kind, name in CASES])
def test_no_forged_file_is_believed(good, tmp_path, capsys, kind, name):
    """The forger computes the digest anew, so only the contradictions in the content give the file away."""
    path = tmp_path / "forged.nc"
    save_result(FORGED[kind][name](good[kind]), path)
    assert main(["show", str(path)]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.startswith(f"error: cannot read '{path}': it is damaged (")
    assert told.err.count("\n") == 1


def test_a_statement_is_what_follows_from_the_numbers(good, tmp_path):
    save_result(good["orbit"].assign_attrs(statement_of_plausibility="plausible: yes"), tmp_path / "o.nc")
    xr.testing.assert_identical(load_dataset(tmp_path / "o.nc"), good["orbit"])


def test_the_speeds_of_a_curve_are_what_follows_from_its_points(good, tmp_path):
    save_result(good["curve"].assign_attrs(characteristic_speeds="{}"), tmp_path / "c.nc")
    xr.testing.assert_identical(load_dataset(tmp_path / "c.nc"), good["curve"])


def test_the_digest_is_that_of_the_content_alone(good, tmp_path):
    """Other chunks, compression, order of bytes and kind of text leave it as it is, and so do other attributes."""
    orbit = good["orbit"]
    packed = {
        name: {"zlib": True, "chunksizes": v.shape} for name, v in orbit.variables.items() if v.dtype.kind == "f"
    }
    swapped = orbit.assign({"u": orbit["u"].astype(">f8")}).assign_attrs(history="copied")
    (tmp_path / "o.nc").write_bytes(netcdf_bytes(orbit))
    with xr.open_dataset(tmp_path / "o.nc", engine="h5netcdf") as plain:
        signed = swapped.assign_attrs({k: v for k, v in plain.attrs.items() if k.startswith("wingbeat_")})
    signed.to_netcdf(tmp_path / "copied.nc", engine="h5netcdf", encoding=packed)  # with texts of variable length
    xr.testing.assert_identical(load_dataset(tmp_path / "copied.nc"), orbit)
    assert digest(orbit, orbit.attrs) == signed.attrs["wingbeat_digest"]


def test_a_small_file_that_declares_gigabytes_is_refused_at_once(tmp_path):
    path = tmp_path / "declares.nc"
    with h5py.File(path, "w") as file:
        file.attrs["wingbeat_kind"] = np.bytes_("orbit")
        file.create_dataset("phase", (300_000_000,), "f8", chunks=(1_000_000,), compression="gzip", fillvalue=1.0)
    assert path.stat().st_size < 4000
    ended = subprocess.run([sys.executable, "-c", MEASURED, path], capture_output=True, text=True, check=True)
    seconds, megabytes, *words = ended.stdout.split(maxsplit=2)
    assert "it would take more than a hundred times its size when unpacked" in words[0]
    assert float(seconds) < 3
    assert float(megabytes) < 400


def test_a_chunk_that_unpacks_to_more_than_it_declares_is_refused(saved, tmp_path):
    import zlib

    path = tmp_path / "chunk.nc"
    shutil.copy(saved["orbit"], path)
    with h5py.File(path, "r+") as file:
        item = file.create_dataset("extra", (8,), "f8", chunks=(8,), compression="gzip")
        item.id.write_direct_chunk((0,), zlib.compress(bytes(1_000_000)))
    with pytest.raises(FileError, match="it would unpack to more than it declares, in '/extra'"):
        load_dataset(path)


def test_a_flight_of_many_beats_may_be_large():
    assert declared.MOST_DECLARED > 1000 * 128 * 8 * 360  # a thousand beats of 128 samples of 360 numbers


def test_a_file_of_an_older_version_says_so(good, tmp_path):
    good["orbit"].to_netcdf(tmp_path / "old.nc", engine="h5netcdf")
    with pytest.raises(FileError, match="it has no digest, so another program or an older version of wingbeat"):
        load_dataset(tmp_path / "old.nc")


@pytest.mark.parametrize("kind", ["orbit", "flight", "curve"])
def test_another_kind_is_named_before_anything_else_is_read(saved, kind):
    other = "curve" if kind != "curve" else "flight"
    with pytest.raises(
        FileError, match=f"as an? {other}: it holds another kind of result, '{kind}'; give a file that"
    ):
        load_dataset(saved[kind], other)


def test_a_wing_that_does_not_pitch_is_no_damage(pigeon_orbit):
    """A live starling's file was once refused: its pitch amplitude was 3e-19, at the bound of 0."""
    dataset, species = pigeon_orbit.orbit.dataset, pigeon_orbit.problem.species
    series = {str(name): np.array(variable.values) for name, variable in dataset.variables.items()}
    check_newton(series, species)
    series["wing_pitch"] = np.full_like(series["wing_pitch"], 0.347)
    series["wing_pitch_rate"] = 2e-17 * np.cos(2 * np.pi * series["phase"])
    check_newton(series, species)
    series["wing_pitch_rate"] = 1e-3 * np.cos(2 * np.pi * series["phase"])
    with pytest.raises(ValueError, match="wing_pitch is not the integral"):
        check_newton(series, species)
