#!/usr/bin/env python3
"""Check that package, CITATION.cff and CHANGELOG.md state one version, and one date once it is released.

    .ci/check_version.py [VERSION]

With VERSION, such as 0.1.0, this version must be the package's, and the changelog must give it a date. Exit code 1
and a list of faults if something is wrong. Needs Python alone, and no package.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
HEADING = re.compile(
    r"^## (?:Unreleased \((?P<next>[^)]+)\)|(?P<version>\d\S*) \((?P<date>\d{4}-\d\d-\d\d)\))$", re.M
)
"""``## Unreleased (0.2.0)`` while a version is being made, and ``## 0.2.0 (2027-01-31)`` once it is released."""


def faults(version_file: str, citation: str, changelog: str, tag: str | None = None) -> list[str]:
    """Return where the three files disagree.

    Parameters
    ----------
    version_file, citation, changelog : texts of ``_version.py``, ``CITATION.cff`` and ``CHANGELOG.md``.
    tag : the version that is being released; None between releases.
    """
    package = re.findall(r'^__version__ = "([^"]+)"$', version_file, re.M)
    if len(package) != 1:
        return ["_version.py does not state one version"]
    newest = HEADING.search(changelog)
    first = re.search(r"^## .*$", changelog, re.M)
    if newest is None or first is None or newest.start() != first.start():
        return ["the first section of CHANGELOG.md is neither '## Unreleased (VERSION)' nor '## VERSION (DATE)'"]
    wrong = []
    if (newest["version"] or newest["next"]) != package[0]:
        wrong.append(f"CHANGELOG.md begins with {newest[0]!r}, but the package has version {package[0]}")
    # A key of the file itself stands at the start of its line; those of the references are indented.
    for key, value in (("version", package[0]), ("date-released", newest["date"])):
        stated = re.findall(rf"^{key}: *[\"']?([^\"'\n]*?)[\"']?$", citation, re.M)
        if stated != ([] if value is None else [value]):
            wanted = value or "absent, because this version is not released"
            wrong.append(f"CITATION.cff: {key} must be {wanted}; it is {' and '.join(stated) or 'absent'}")
    if tag is not None and tag != package[0]:
        wrong.append(f"the tag says {tag}, but the package has version {package[0]}")
    if tag is not None and newest["date"] is None:
        wrong.append("the changelog gives the version no date: write '## VERSION (DATE)', and date-released")
    return wrong


def faults_here(tag: str | None = None) -> list[str]:
    """Return where the files of this repository disagree."""
    files = (ROOT / "src" / "wingbeat" / "_version.py", ROOT / "CITATION.cff", ROOT / "CHANGELOG.md")
    return faults(*(file.read_text(encoding="utf-8") for file in files), tag)


if __name__ == "__main__":
    found = faults_here(sys.argv[1] if len(sys.argv) > 1 else None)
    print("\n".join(found) or "good: package, CITATION.cff and CHANGELOG.md agree")
    sys.exit(1 if found else 0)
