"""Files that LabVIEW itself wrote, as npTDMS ships them with its tests."""

from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from wingbeat._base import FaultList
from wingbeat.experiment.instrument_files import open_recording

nptdms = pytest.importorskip("nptdms")
FOLDER = Path(nptdms.__file__).parent / "test" / "data"
pytestmark = pytest.mark.skipif(
    not (FOLDER / "raw1.tdms").exists(), reason="npTDMS was installed without its tests"
)


def read(name, columns):
    recording, faults = open_recording(FOLDER / name), FaultList()
    numbers, clock = recording.numbers(faults, columns), recording.clock(faults, columns)
    faults.raise_if_any()
    assert clock is not None
    return recording, numbers, clock


@pytest.mark.parametrize(
    ("name", "channels", "unit", "samples", "step"),
    [
        ("raw1.tdms", 7, "Volts", 2000, 2e-5),
        ("big_endian.tdms", 2, None, 3500, 1e-3),  # wf_samples says 500, the size of one of seven blocks
        ("raw_timestamps.tdms", 1, None, 128, 1e-3),
    ],
)
def test_channels_of_labview_have_their_length_unit_and_clock(name, channels, unit, samples, step):
    recording, numbers, clock = read(name, list(range(channels)))
    assert (len(recording.names), recording.units[0]) == (channels, unit)
    assert numbers.shape == (samples, channels)
    assert np.diff(clock) == pytest.approx(step, rel=1e-6)


def test_signal_express_writes_thinned_copies_of_a_channel_under_its_name():
    """LabVIEW SignalExpress 2011: three groups hold one channel at 2000, 40 and 0.8 samples a second."""
    recording, numbers, clock = read("Digital_Input.tdms", [0])
    assert numbers.shape == (20000, 1)
    assert np.diff(clock) == pytest.approx(5e-4, rel=1e-6)
    assert [name.split(" - ")[2].split("/")[0] for name in recording.names] == [
        "All Data", "Decimated Data_Level1", "Decimated Data_Level2",
    ]  # fmt: skip
    with pytest.raises(wb.InvalidInputError, match="are the numbers of samples of the channels"):
        read("Digital_Input.tdms", [0, 1])
