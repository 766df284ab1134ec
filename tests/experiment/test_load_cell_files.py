"""Files that instruments write: LabVIEW's .lvm and .tdms, logs of ATI sensors; channels, units, signs and zeros.

No LabVIEW runs here: the .lvm files follow NI 4139 and files that LabVIEW wrote, published with lvm_read. The .tdms
files are written by npTDMS, the log of a Net F/T as ATI's demo writes it (its Java source is public).
"""

import re
from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.cli.app import main
from wingbeat.experiment import LoadCellSetup, read_run, reduce_run

PLATE = {"speed": 0.4, "density": 998.0, "viscosity": 1e-6, "chord": 0.076, "span": 0.456}
NAMES = {"normal": "Fz", "tangential": "Fx", "moment": "Ty", "alpha": "Angle"}
SETUP = LoadCellSetup(NAMES, PLATE)
COUNT, STEP = 600, 0.05


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def signals(scale=1.0, zero=0.0, seed=0):
    """Return the loads of a plate at 20 degrees, with six decimals, as in a file."""
    noise = np.random.default_rng(seed).normal(size=(3, COUNT)) * [[0.01], [0.01], [0.001]]
    means = np.array([[2.9], [0.27], [0.04]]) * scale + np.array([[1.0], [0.5], [0.05]]) * zero
    return np.round(dict(zip(("Fz", "Fx", "Ty"), means + noise, strict=True)) and means + noise, 6)


def lvm(
    loads,
    *,
    x="One",
    decimal=".",
    separator="\t",
    packet=COUNT,
    headings=False,
    x_start=0.0,
    anew=False,
    head_decimal=True,
    comment="",
    units="",
    special=False,
    version="2",
):
    """Return an .lvm file with the channels Fz, Fx, Ty and Angle, as LabVIEW's Write To Measurement File does."""
    names = ["Fz", "Fx", "Ty", "Angle"]

    def number(value, form="%.6f"):
        return (form % value).replace(".", decimal)

    def row(key, values):
        gap = [separator if x == "Multi" else ""] * len(values)
        return key + "".join(
            separator + (g if i else "") + str(v) for i, (v, g) in enumerate(zip(values, gap, strict=True))
        )

    lines = [
        "LabVIEW Measurement" + separator,
        f"Writer_Version{separator}{version}",
        f"Reader_Version{separator}1",
    ]
    lines += [f"Separator{separator}{'Tab' if separator == chr(9) else 'Comma'}"]
    lines += [f"Decimal_Separator{separator}{decimal}"] if head_decimal else []
    lines += [f"Multi_Headings{separator}{'Yes' if headings else 'No'}", f"X_Columns{separator}{x}"]
    lines += [f"Time_Pref{separator}Absolute", f"Date{separator}2024/05/02", f"Time{separator}10:11:12,5"]
    lines += ["***End_of_Header***" + separator, separator]
    for k, first in enumerate(range(0, COUNT, packet)):
        size = min(packet, COUNT - first)
        if k == 0 or headings:
            if special:
                lines += ["***Start_Special***", f"binary{separator}7", "1 2 3", "***End_Special***"]
            clock = f"10:11:{12 + first * STEP:09.6f}".replace(".", decimal)
            lines += [f"Channels{separator}4", row("Samples", [size] * 4), row("Date", ["2024/05/02"] * 4)]
            lines += [row("Time", [clock] * 4)]
            lines += [row("Y_Unit_Label", units.split(";"))] if units else []
            lines += [row("X_Dimension", ["Time"] * 4), row("X0", [number(0.0, "%.16E")] * 4)]
            lines += [row("Delta_X", [number(STEP)] * 4), "***End_of_Header***" + separator * 4]
            head = ["X_Value", *names] if x != "Multi" else [cell for name in names for cell in ("X_Value", name)]
            lines.append(separator.join([*head, "Comment"]))
        for i in range(first, first + size):
            at = number(x_start + STEP * (i - first if anew else i))
            cells = [number(value) for value in (*loads[:, i], 20.0)]
            if x == "Multi":
                cells = [cell for value in cells for cell in (at, value)]
            else:
                cells = ["" if x == "No" else at, *cells]
            lines.append(separator.join(cells) + (separator + comment if comment and i % 7 == 0 else ""))
        lines += [separator] if headings else []
    return "\r\n".join(lines) + "\r\n"


FORMS = {
    "as the default": {},
    "with decimal commas": {"decimal": ","},
    "one x for each channel": {"x": "Multi"},
    "without x": {"x": "No"},
    "without x, in packets under one header": {"x": "No", "packet": 100},
    "separated by commas": {"separator": ","},
    "with comments": {"comment": "lost communication"},
    "a special block, which no reader needs": {"special": True},
    "x goes on through packets with a header each": {"packet": 150, "headings": True},
    "x begins anew in packets with a header each": {"packet": 150, "headings": True, "anew": True},
    "x begins anew in packets under one header": {"packet": 150, "anew": True},
    "absolute times": {"x_start": 3.8e9},
    "version 0.92, which names no decimal separator": {"head_decimal": False, "version": "0.92"},
    "version 0.92 with commas": {"head_decimal": False, "version": "0.92", "decimal": ","},
    "units": {"units": "Newtons;N;N-m;deg"},
}


@pytest.mark.parametrize("form", FORMS)
def test_every_form_of_lvm_gives_the_same_run(form):
    loads = signals()
    Path("run.lvm").write_text(lvm(loads, **FORMS[form]), newline="")
    run = read_run("run.lvm", SETUP)
    np.testing.assert_allclose(run.time, STEP * np.arange(COUNT), atol=2e-6)
    np.testing.assert_array_equal([run.normal_force, run.tangential_force, run.moment], loads)
    assert np.all(np.asarray(run.alpha_deg) == 20.0)
    said = " ".join(run.notes)
    assert ("no unit is stated for Fz (N), Fx (N), Ty (N m), Angle (deg)" in said) == (form != "units")
    assert ("joined as if no time passed" in said) == ("under one header" in form)
    assert ("clocks were added" in said) == ("anew" in form and "header each" in form)
    assert ("names no Decimal_Separator" in said) == (form == "version 0.92 with commas")
    assert ("counted from the first sample" in said) == (form == "absolute times")


def test_units_are_converted_where_the_file_or_the_mapping_states_them():
    loads = signals()
    pounds = loads / np.array([[4.4482216152605], [4.4482216152605], [4.4482216152605 * 0.0254]])
    Path("run.lvm").write_text(lvm(pounds, units="lbf;lbf;lbf-in;deg"))
    run = read_run("run.lvm", SETUP)
    np.testing.assert_allclose(run.normal_force, loads[0], atol=3e-6)
    np.testing.assert_allclose(run.moment, loads[2], atol=3e-6)
    assert "converted Fz from lbf to N, Fx from lbf to N, Ty from lbf-in to N m" in " ".join(run.notes)
    Path("run.lvm").write_text(lvm(loads * [[1], [1], [1000]]))
    run = read_run("run.lvm", LoadCellSetup(NAMES | {"moment": "-Ty [N mm]", "tangential": "-Fx"}, PLATE))
    np.testing.assert_allclose(run.moment, -loads[2], atol=1e-9)
    np.testing.assert_array_equal(run.tangential_force, -loads[1])


def test_times_without_x_values_have_the_unit_of_x():
    """Without x-values X0 and Delta_X give the times; they have the unit X_Unit_Label, and X0 may be absolute."""
    text = lvm(signals(), x="No")

    def read(unit, start, step):
        found = re.sub(r"Delta_X[^\r]*", f"X_Unit_Label{4 * (chr(9) + unit)}\r\nDelta_X{4 * (chr(9) + step)}", text)
        Path("run.lvm").write_text(re.sub(r"X0[^\r]*", f"X0{4 * (chr(9) + start)}", found), newline="")
        return read_run("run.lvm", SETUP)

    np.testing.assert_allclose(read("ms", "100", "50").time, 0.1 + STEP * np.arange(COUNT), rtol=1e-12)
    run = read("s", "", "0.05")
    np.testing.assert_allclose(run.time, STEP * np.arange(COUNT), rtol=1e-12)
    assert "absolute" not in " ".join(run.notes)
    run = read("", "3.8e9", "0.05")
    np.testing.assert_allclose(run.time, STEP * np.arange(COUNT), rtol=1e-12)
    assert "its times are absolute; they are counted from the first sample here" in " ".join(run.notes)
    with pytest.raises(wb.InvalidInputError, match="X_Unit_Label = 'h': is no unit of time that is read"):
        read("h", "0", "50")


def test_a_unit_in_a_channels_own_name_is_read():
    """Channels are often called "Ty [N mm]"; taken as N m, the moment would be a thousand times too large."""
    loads = signals()
    text = (
        lvm(loads * [[1], [1], [1000]]).replace("\tTy\t", "\tTy [N mm]\t").replace("\tAngle\t", "\tAngle [deg]\t")
    )
    Path("run.lvm").write_text(text, newline="")
    for name in ("Ty", "Ty [N mm]"):
        run = read_run("run.lvm", LoadCellSetup(NAMES | {"moment": name}, PLATE))
        np.testing.assert_allclose(run.moment, loads[2], rtol=1e-12)
        assert "converted Ty [N mm] from N mm to N m" in " ".join(run.notes)
        assert "no unit is stated for Fz (N), Fx (N);" in " ".join(run.notes)
    Path("run.lvm").write_text(text.replace("\tFz\t", "\tFz (Filtered)\t"), newline="")  # as LabVIEW's filter does
    run = read_run("run.lvm", LoadCellSetup(NAMES, PLATE))
    assert "no unit is stated for Fz (Filtered) (N), Fx (N);" in " ".join(run.notes)
    head = "Fx,Fy,Fz,Tx,Ty,Tz,Time [ms]\n"
    rows = [f"{x!r},0,{z!r},0,{m!r},0,{50 * i}" for i, (z, x, m) in enumerate(loads.T.tolist())]
    Path("run.csv").write_text(head + "\n".join(rows))
    setup = LoadCellSetup({k: v for k, v in NAMES.items() if k != "alpha"}, PLATE, alpha_deg=20.0)
    np.testing.assert_allclose(read_run("run.csv", setup).time, STEP * np.arange(COUNT), rtol=1e-12)


@pytest.mark.parametrize(
    ("form", "names", "said"),
    [
        ({"units": "Volts;Volts;Volts;deg"}, {}, "is an electric signal; apply the load cell's calibration first"),
        ({"units": "kg;kg;N-m;deg"}, {}, "is a mass; is it the weight of one? Then the unit is kgf or gf"),
        (
            {"units": "N-m;N;N-m;deg"},
            {},
            "is a unit of moment, not of force; state the unit of its numbers, such as Fz",
        ),
        ({"units": "N;N;lbf;deg"}, {}, "= 'lbf': is a unit of force, not of moment; state the unit of its"),
        ({}, {"moment": "Ty [mN]"}, "= 'mN': is a unit of force, not of moment; state the unit of its numbers"),
        (
            {"units": "N;N;N-m;deg", "moment": "Ty [N mm]"},
            {},
            "= 'N-m and N mm': are two units of one channel; say",
        ),
        ({}, {"normal": "Fq"}, "normal_force = 'Fq': is no channel of the file; it has Fz, Fx, Ty, Angle"),
        ({}, {"normal": "Fx"}, "name one channel twice"),
        ({"decimal": ",", "separator": ","}, {}, "is the decimal separator too; save the file with tabs"),
    ],
)
def test_what_cannot_be_right_is_refused(form, names, said):
    moment = form.get("moment", "Ty")
    text = lvm(signals(), **{key: value for key, value in form.items() if key != "moment"})
    Path("run.lvm").write_text(text.replace("\tTy\t", f"\t{moment}\t"))
    with pytest.raises(wb.InvalidInputError, match=r"\A") as caught:
        read_run("run.lvm", LoadCellSetup(NAMES | names, PLATE))
    assert said in str(caught.value)


def test_a_file_says_its_channels_where_no_mapping_is_given(capsys):
    Path("run.lvm").write_text(lvm(signals()))
    assert main(["reduce", "run.lvm", "-o", "c.csv"]) == 2
    said = capsys.readouterr().err
    assert (
        "'Fz, Fx, Ty, Angle': are the channels of a measurement file of LabVIEW (.lvm), which does not say" in said
    )
    assert "--channels normal=NAME,tangential=NAME,moment=NAME, with -NAME for a reversed sign" in said
    assert "give --set speed=.. density=.. viscosity=.. chord=.. span=.. in m/s, kg/m3" in said


def test_a_file_that_is_cut_short_says_so():
    text = lvm(signals(), packet=COUNT)
    Path("run.lvm").write_text("\n".join(text.splitlines()[:400]))
    assert "its head promises 600 samples, but" in " ".join(read_run("run.lvm", SETUP).notes)


def test_lvm_names_in_the_code_page_of_windows_are_read():
    text = lvm(signals(), units="N;N;N-m;°")
    Path("run.lvm").write_bytes(text.encode("cp1252"))
    assert "code page of western Windows" in " ".join(read_run("run.lvm", SETUP).notes)


NET_FT = """Start Time: 5/2/24 10:11 AM
RDT Sample Rate: 20
"PLEASE NOTE: The sample rate is read from the Net F/T when the program starts."
Force Units: N
Counts per Unit Force: 1000000.0
Torque Units: N-mm
Counts per Unit Torque: 1000.0
Status (hex), RDT Sequence, F/T Sequence, Fx, Fy, Fz, Tx, Ty, Tz, Time
"""


def net_ft(loads, *, status="0x0", lost=()):
    rows = [
        f'"{status}","{7 + i}","{9 + 5 * i}","{loads[1, i]!r}","0.01","{loads[0, i]!r}","0.0",'
        f'"{1000 * loads[2, i]!r}","0.0","May 2, 2024 10:11:{12 + i // 20:02d} AM"'
        for i in range(COUNT)
        if i not in lost
    ]
    return NET_FT + "\n".join(rows) + "\n"


def test_the_net_ft_demo_of_ati_has_units_and_sequence_numbers():
    """Its head states counts per unit, but its numbers are divided by them already; its clock has whole seconds."""
    loads = signals()
    setup = LoadCellSetup({k: v for k, v in NAMES.items() if k != "alpha"}, PLATE, alpha_deg=20.0)
    Path("run.csv").write_text(net_ft(loads.astype(object), lost={300}))
    run = read_run("run.csv", setup)
    kept = np.arange(COUNT) != 300
    np.testing.assert_allclose(run.time, STEP * np.arange(COUNT)[kept], atol=1e-12)
    np.testing.assert_array_equal(run.normal_force, loads[0, kept])
    np.testing.assert_allclose(run.moment, loads[2, kept], rtol=1e-12)
    said = " ".join(run.notes)
    assert "converted Ty from N-mm to N m" in said
    assert "the times are RDT Sequence / 20 Hz" in said
    assert "ATI's is about the sensor's origin" in said
    Path("run.csv").write_text(net_ft(loads.astype(object), status="0x80010000"))
    assert "status is not 0 in 600 of 600 samples; was it saturated?" in " ".join(read_run("run.csv", setup).notes)
    Path("run.csv").write_text(net_ft(loads.astype(object)).replace("Rate: 20", "Rate: 7000"))
    with pytest.raises(wb.InvalidInputError, match="is longer than the record"):
        reduce_run(read_run("run.csv", setup))
    assert "these times last 0.08557 s, but its clock shows 29 s" in " ".join(read_run("run.csv", setup).notes)
    Path("run.csv").write_text(net_ft(np.round(1e6 * loads).astype(int).astype(object)))
    with pytest.raises(wb.InvalidInputError, match=r"which may be counts; 1e\+06 counts are one unit"):
        read_run("run.csv", setup)


def test_the_moment_is_moved_to_mid_chord():
    """A sensor 20 mm behind mid-chord reads M + 0.02 F_N."""
    loads = signals()
    loads[2] += 0.02 * loads[0]
    Path("run.csv").write_text(net_ft(loads.astype(object)))
    setup = LoadCellSetup({k: v for k, v in NAMES.items() if k != "alpha"}, PLATE | {"moment_axis": 0.02}, 20.0)
    np.testing.assert_allclose(read_run("run.csv", setup).moment, signals()[2], atol=1e-9)
    about = "ATI's is about the sensor's origin"
    constants = PLATE | {"sample_rate": 20.0}
    unstated = read_run("run.csv", LoadCellSetup(setup.channels, constants, 20.0))
    assert about in " ".join(unstated.notes)
    centred = read_run("run.csv", LoadCellSetup(setup.channels, constants | {"moment_axis": 0.0}, 20.0))
    assert about not in " ".join(centred.notes)  # who states 0 has answered
    np.testing.assert_array_equal(centred.moment, unstated.moment)


def test_a_clock_as_text_gives_no_times_and_the_option_that_does():
    """Without the rate of the RDT, the clock of ATI's demo, "May 2, 2024 10:11:12 AM", tells no times."""
    setup = LoadCellSetup({k: v for k, v in NAMES.items() if k != "alpha"}, PLATE, alpha_deg=20.0)
    Path("run.csv").write_text(net_ft(signals().astype(object)).replace("RDT Sample Rate: 20\n", ""))
    with pytest.raises(wb.InvalidInputError) as caught:
        read_run("run.csv", setup)
    (fault,) = map(str, caught.value.faults)
    assert "does not say when they were measured; name the channel, time=NAME, or give --set sample_rate" in fault


def tdms(path, loads, units=("N", "N", "N-mm"), rows=COUNT, **properties):
    nptdms = pytest.importorskip("nptdms")
    given = {"wf_increment": STEP} | properties
    root = nptdms.RootObject({"speed": 0.4, "density": 998.0, "Operator": "lab"})
    series = dict(zip(("Fz", "Fx", "Ty"), loads * [[1], [1], [1000]], strict=True))
    with nptdms.TdmsWriter(path) as writer:
        channels = [
            nptdms.ChannelObject("Loads", name, values[:rows], given | {"unit_string": unit})
            for (name, values), unit in zip(series.items(), units, strict=True)
        ]
        writer.write_segment([root, *channels])


def test_tdms_is_read_with_its_clock_units_and_properties():
    """SignalExpress writes wf_increment without wf_start_offset, of which npTDMS 1.13 makes no time; it means 0."""
    loads, constants = signals(), {name: PLATE[name] for name in ("viscosity", "chord", "span")}
    setup = LoadCellSetup({k: v for k, v in NAMES.items() if k != "alpha"}, constants, 20.0)
    tdms("run.tdms", loads)
    run = read_run("run.tdms", setup)
    np.testing.assert_allclose(run.time, STEP * np.arange(COUNT), atol=1e-12)
    np.testing.assert_allclose(run.moment, loads[2], rtol=1e-12)
    assert run.speed == 0.4
    assert "speed = 0.4, density = 998 by the file's properties" in " ".join(run.notes)
    tdms("run.tdms", loads, wf_start_offset=3.0)
    assert read_run("run.tdms", setup).time[0] == 3.0
    torn = np.where(np.arange(COUNT) == COUNT - 1, 1e200, loads)  # as bytes that are lost or added make them
    tdms("run.tdms", torn)
    with pytest.raises(wb.InvalidInputError, match=r"channel Fz\[599\] = 1e\+200: is larger than any measurement"):
        read_run("run.tdms", setup)
    tdms("run.tdms", signals(), wf_start_offset=3.0)
    content = Path("run.tdms").read_bytes()
    Path("run.tdms").write_bytes(content[: len(content) // 2])
    with pytest.raises(
        wb.InvalidInputError, match="numbers of samples of the channels; was the recording interrupt"
    ):
        read_run("run.tdms", setup)
    Path("run.tdms").write_bytes(b"TDSh" + content[4:])
    with pytest.raises(wb.InvalidInputError, match="is the index of a TDMS file"):
        read_run("run.tdms", setup)
    tdms("run.tdms", loads, units=("Volts",) * 3)
    with pytest.raises(wb.InvalidInputError, match="electric signal"):
        read_run("run.tdms", setup)
