"""Check wheel and source archive of a folder: contents, metadata, and that the description renders.

`.ci/try_release` runs this with twine installed. Exit code 1 and a list of faults if something is wrong.
"""

import email
import subprocess
import sys
import tarfile
import zipfile
from email.message import Message
from pathlib import Path

MOST_BYTES = 3_000_000
"""Largest archive; the wheel of 0.1.0 has 1.6 MB. A third are wing motions that `wingbeat validate` reads."""

PACKAGES = ("wingbeat", "wingbeat_evidence", "wingbeat_explorer")
NEEDED = [
    *(f"{package}/py.typed" for package in PACKAGES),
    # What lists the public names.
    "wingbeat/__init__.pyi",
    "wingbeat_evidence/__init__.pyi",
    "wingbeat/_base/nomenclature.csv",
    "wingbeat/data/pigeon.toml",
    "wingbeat/viewer/viewer.js",
    "wingbeat_evidence/data/whole_flights/pigeon.toml",
    "wingbeat_explorer/app/page.css",
    "wingbeat_explorer/explorer.js",
]
CLASSIFIERS = [f"Programming Language :: Python :: {version}" for version in ("3.11", "3.12", "3.13")]


def wheel_faults(wheel: Path) -> list[str]:
    """Return what is wrong with the contents and the metadata of a wheel."""
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        info = next(name.split("/")[0] for name in names if name.endswith(".dist-info/METADATA"))
        metadata = email.message_from_bytes(archive.read(f"{info}/METADATA"))
    faults = [f"the wheel holds {name}" for name in names if name.split("/")[0] not in (*PACKAGES, info)]
    faults += [f"the wheel lacks {name}" for name in NEEDED if name not in names]
    if f"{info}/licenses/LICENSE" not in names:
        faults.append("the wheel lacks its license")
    return faults + metadata_faults(metadata, version=wheel.name.split("-")[1])


def metadata_faults(metadata: Message, version: str) -> list[str]:
    """Return what is wrong with the metadata."""
    wanted = {
        "Name": "wingbeat",
        "Version": version,
        "License-Expression": "BSD-3-Clause",
        "Requires-Python": ">=3.11",
        "Description-Content-Type": "text/markdown",
    }
    faults = [f"{key}: {metadata[key]}, not {value}" for key, value in wanted.items() if metadata[key] != value]
    classifiers = metadata.get_all("Classifier", [])
    faults += [f"no classifier {name}" for name in CLASSIFIERS if name not in classifiers]
    if any(name.startswith("License ::") for name in classifiers):
        faults.append("a classifier repeats the license")
    return faults


def source_faults(source: Path) -> list[str]:
    """Return what is wrong with the contents of a source archive."""
    with tarfile.open(source) as archive:
        names = [name.split("/", 1)[1] for name in archive.getnames() if "/" in name]
    allowed = (
        *(f"src/{package}/" for package in PACKAGES),
        ".gitignore",
        "CHANGELOG.md",
        "CITATION.cff",
        "LICENSE",
        "PKG-INFO",
        "README.md",
        "pyproject.toml",
    )
    faults = [f"the source archive holds {name}" for name in names if not name.startswith(allowed)]
    return faults + [
        f"the source archive lacks {name}"
        for name in ("LICENSE", "CITATION.cff", "pyproject.toml", *(f"src/{file}" for file in NEEDED))
        if name not in names
    ]


def main(folder: Path) -> int:
    """Check the two archives of a folder and print the faults."""
    (wheel,) = folder.glob("*.whl")
    (source,) = folder.glob("*.tar.gz")
    faults = [*wheel_faults(wheel), *source_faults(source)]
    for archive in (wheel, source):
        if archive.stat().st_size > MOST_BYTES:
            faults.append(f"{archive.name} has {archive.stat().st_size} bytes, more than {MOST_BYTES}")
    rendered = subprocess.run([sys.executable, "-m", "twine", "check", "--strict", wheel, source], check=False)
    if rendered.returncode:
        faults.append("twine refuses the archives")
    print("\n".join(faults) or f"good: contents and metadata of {wheel.name} and {source.name}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
