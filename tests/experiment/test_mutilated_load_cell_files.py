"""Damaged files of instruments: each is refused in words, or gives the right loads, or says what it lacks."""

import re
from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from tests.experiment.test_load_cell_files import FORMS, NAMES, PLATE, lvm, net_ft, signals, tdms
from wingbeat.experiment import LoadCellSetup, read_run, reduce_run

SETUP = LoadCellSetup({k: v for k, v in NAMES.items() if k != "alpha"}, PLATE, 20.0)


def damaged(random, content):
    """Return the bytes of a file after one or two accidents: cuts, losses, repeats, wrong bytes, other programs."""
    for _ in range(random.integers(1, 3)):
        lines = content.split(b"\n")
        k, much = int(random.integers(len(lines))), int(random.integers(1, 60))
        at = int(random.integers(len(content)))
        match random.integers(12):
            case 0:
                content = content[:at]
            case 1:
                content = content[:at] + content[at + much :]
            case 2:
                content = b"\n".join(lines[:k] + lines[k + much :])
            case 3:
                content = b"\n".join(lines[:k] + lines[k : k + much] * 2 + lines[k + much :])
            case 4:
                content = content[:at] + random.bytes(much) + content[at:]
            case 5:
                content = content.replace(b".", b",")
            case 6:
                content = content.replace(b"\t", b" " if random.random() < 0.5 else b";")
            case 7:
                content = b"\n".join(random.permutation(np.array(lines, dtype=object)).tolist())
            case 8:
                k = int(random.integers(min(len(lines), 26)))
                content = b"\n".join(lines[:k] + lines[k + 1 :])
            case 9:
                cells = re.split(rb"([\t,])", lines[k])
                del cells[int(random.integers(len(cells)))]
                lines[k] = b"".join(cells)
                content = b"\n".join(lines)
            case 10:
                content = re.sub(rb"(?m)^(\S+?)[\t,]", rb"\1", content) if random.random() < 0.5 else content[at:]
            case 11:
                for place in random.integers(len(content), size=3):
                    content = content[:place] + bytes([random.integers(256)]) + content[place + 1 :]
        content = content or b"\n"
    return content


# Notes that name what the accidents do: a number beside one of them is not wrong in silence.
NAMED = (
    "spikes, the largest",
    "is the file cut short",
    "was the recording interrupted",
)


def outcome(path, truth, usual):
    """Return what became of a file: refused, right, said; or a sentence that says what is wrong."""
    try:
        run = read_run(path, SETUP)
        means = reduce_run(run, min(20.0, 0.9 * run.duration))
    except (wb.InvalidInputError, wb.FileError) as error:
        lines = str(error).splitlines()
        return "refused" if all(lines) and len(lines) < 14 else f"{len(lines)} lines: {error}"
    found = np.array([*means.mean[:3], means.normal])
    if np.abs(found / truth - 1).max() < 0.01 and abs(np.median(np.diff(run.time)) - 0.05) < 1e-4:
        return "right"
    new = [note for note in means.notes if re.sub(r"[\d.]+", "", note) not in usual]
    if any(words in note for note in new for words in NAMED):
        return "said"
    return f"{found} instead of {truth} in silence; new notes: {new}"


@pytest.mark.slow
def test_300_damaged_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    random, loads, counts = np.random.default_rng(56), signals(), {}
    force = 0.5 * 998.0 * 0.4**2 * 0.076 * 0.456
    c_n, c_t, c_m = loads[:, -400:].mean(axis=1) / [force, force, force * 0.076]
    cos, sin = np.cos(np.radians(20.0)), np.sin(np.radians(20.0))
    truth = np.array([c_n * cos - c_t * sin, c_n * sin + c_t * cos, c_m, c_n])
    forms = [*FORMS.values(), *[{"units": "N;N;N-m;deg"}] * 3]
    whole = [("run.lvm", lvm(loads, **form).encode()) for form in forms]
    whole += [("run.csv", net_ft(loads.astype(object)).encode())] * 5
    tdms("run.tdms", loads)
    whole += [("run.tdms", Path("run.tdms").read_bytes())] * 5
    wrong = []
    for case in range(300):
        name, content = whole[case % len(whole)]
        Path(name).write_bytes(content)
        usual = {re.sub(r"[\d.]+", "", note) for note in reduce_run(read_run(name, SETUP)).notes}
        content = damaged(random, content)
        Path(name).write_bytes(content)
        result = outcome(name, truth, usual)
        counts[result[:7]] = counts.get(result[:7], 0) + 1
        if result not in ("refused", "right", "said"):
            wrong.append(f"{case} {name}: {result}")
    assert not wrong, "\n".join(wrong)
    assert counts["refused"] > 100
    assert counts["right"] > 20
