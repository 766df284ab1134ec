"""The committed bundles: small, current, and without addresses to ask."""

import gzip
import hashlib
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import wingbeat as wb
import wingbeat_explorer
from tests.helpers.browsers import NODE_MODULES
from wingbeat_explorer.folder import explorer_script

SOURCES = NODE_MODULES.parent
VIEWER = wb.viewer.bundle_path()
EXPLORER = Path(wingbeat_explorer.__file__).with_name("explorer.js")
BUNDLES = [VIEWER, EXPLORER]


@pytest.mark.parametrize("bundle", BUNDLES, ids=lambda path: path.stem)
def test_the_bundle_is_made_from_the_sources_beside_it(bundle):
    paths = (path for path in (SOURCES / "src").rglob("*") if path.is_file())
    names = ["build.mjs", "package.json", *sorted(path.relative_to(SOURCES).as_posix() for path in paths)]
    digest = hashlib.sha256()
    for name in names:
        digest.update(f"{name}\n".encode() + (SOURCES / name).read_bytes())
    first = bundle.read_text("utf-8").split("\n", 1)[0]
    assert first.endswith(f"sha256:{digest.hexdigest()}"), "run `npm ci && npm run build` in the folder viewer"


def test_the_same_sources_give_the_same_bundle(tmp_path):
    if shutil.which("node") is None or not (NODE_MODULES / "esbuild").exists():
        pytest.skip("needs node and the packages of viewer/package.json: npm ci in the folder viewer")
    subprocess.run(["node", "build.mjs", str(tmp_path)], cwd=SOURCES, check=True, timeout=120)
    assert all((tmp_path / path.name).read_bytes() == path.read_bytes() for path in BUNDLES)


def test_the_bundles_are_small():
    assert len(gzip.compress(explorer_script(), 9)) <= 230_000


def test_the_explorer_takes_what_the_viewer_holds_and_repeats_nothing_of_it():
    viewer, explorer = (bundle.read_text("utf-8").splitlines() for bundle in BUNDLES)
    assert EXPLORER.stat().st_size <= 80_000
    assert not {line for line in viewer if len(line) > 60} & set(explorer)  # shorter ones may be of style sheets
    assert explorer_script().decode().splitlines() == viewer[:-1] + explorer


def test_a_page_is_small(page_of_one):
    assert page_of_one.stat().st_size <= 1_600_000


def test_the_lock_file_pins_and_names_no_address():
    lock = (SOURCES / "package-lock.json").read_text()
    assert '"resolved"' not in lock
    assert re.search(r'"node_modules/three": \{\s+"version": "[\d.]+",\s+"integrity"', lock)
