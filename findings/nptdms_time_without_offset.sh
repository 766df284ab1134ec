#!/usr/bin/env bash
# One would guess: a TDMS channel with wf_increment has a time track; wf_start_offset, if missing, is 0.
# What happens: npTDMS raises KeyError "Object does not have time properties available" although wf_increment and
# wf_start_time are there, and as_dataframe(time_index=True) fails likewise. The data themselves are read.
# Where it bites: records of LabVIEW SignalExpress 2011, which writes wf_increment without wf_start_offset (npTDMS'
# own test file Digital_Input.tdms is one). A reader that catches the error takes such a record for one without clock.
set -euo pipefail
command -v python3 >/dev/null || { echo "install python3 and python3-venv"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv || { echo "install python3-venv"; exit 77; }
venv/bin/pip install --quiet nptdms==1.13.0 numpy==2.3.5 pandas==2.3.3
venv/bin/python - <<'PYTHON'
import numpy as np
import nptdms

print("nptdms", nptdms.__version__)
start = np.datetime64("2012-07-09T23:58:24")
for name, given in {"with": {"wf_start_offset": 0.0}, "without": {}}.items():
    with nptdms.TdmsWriter(f"{name}.tdms") as writer:
        properties = {"wf_increment": 0.0005, "wf_start_time": start, "wf_samples": 4, **given}
        writer.write_segment([nptdms.ChannelObject("Loads", "Fz", np.arange(4.0), properties)])
own = nptdms.TdmsFile.read("with.tdms")["Loads"]["Fz"]
bare = nptdms.TdmsFile.read("without.tdms")["Loads"]["Fz"]
print("with wf_start_offset:   ", own.time_track().tolist())
assert np.allclose(own.time_track(), [0, 0.0005, 0.001, 0.0015])
assert bare[:].tolist() == [0.0, 1.0, 2.0, 3.0]
for what in (bare.time_track, lambda: bare.as_dataframe(time_index=True)):
    try:
        what()
    except KeyError as error:
        print("without wf_start_offset:", repr(error))
    else:
        raise SystemExit("the behaviour has changed")
PYTHON
