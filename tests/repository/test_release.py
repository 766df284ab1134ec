"""What a release needs: one version everywhere, workflows that run, archives that are checked, and the paper."""

import importlib.util
import os
import re
import subprocess
from statistics import median

import pytest
import yaml

from tests.helpers.places import ROOT
from wingbeat import __version__

WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
PAPER = ROOT / "paper"


def load(path):
    """Return a program of the repository that no package holds, as a module."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


CHECK = load(ROOT / ".ci" / "check_version.py")
ARCHIVES = load(ROOT / ".ci" / "check_archives.py")
PACKAGE = '__version__ = "0.3.0"\n'
CITED = "cff-version: 1.2.0\nversion: 0.3.0\nreferences:\n  - version: 9\n"
DATED = CITED + "date-released: 2027-01-31\n"
NEXT, RELEASED = "# Log\n\n## Unreleased (0.3.0)\n", "# Log\n\n## 0.3.0 (2027-01-31)\n\n## 0.2.0 (2026-01-31)\n"


def test_package_citation_and_changelog_state_one_version():
    assert CHECK.faults_here() == []
    assert f'__version__ = "{__version__}"' in (ROOT / "src" / "wingbeat" / "_version.py").read_text()
    metadata = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert str(metadata["version"]) == __version__


@pytest.mark.parametrize(("citation", "changelog", "tag"), [(CITED, NEXT, None), (DATED, RELEASED, "0.3.0")])
def test_versions_that_agree_are_accepted(citation, changelog, tag):
    assert CHECK.faults(PACKAGE, citation, changelog, tag) == []


@pytest.mark.parametrize(
    ("package", "citation", "changelog", "tag", "words"),
    [
        (PACKAGE, CITED, NEXT.replace("0.3.0", "0.4.0"), None, "CHANGELOG.md begins with"),
        (PACKAGE, CITED.replace("\nversion: 0.3.0", ""), NEXT, None, "version must be 0.3.0; it is absent"),
        (PACKAGE, DATED, NEXT, None, "date-released must be absent"),
        (PACKAGE, CITED, RELEASED, None, "date-released must be 2027-01-31; it is absent"),
        (PACKAGE, DATED.replace("31", "30"), RELEASED, None, "date-released must be 2027-01-31"),
        (PACKAGE, DATED, RELEASED, "0.3.1", "the tag says 0.3.1"),
        (PACKAGE, CITED, NEXT, "0.3.0", "gives the version no date"),
        (PACKAGE, CITED, "# Log\n\n## News\n\n" + NEXT, None, "is neither"),
        ("", CITED, NEXT, None, "does not state one version"),
    ],
)
def test_versions_that_disagree_are_reported(package, citation, changelog, tag, words):
    found = CHECK.faults(package, citation, changelog, tag)
    assert len(found) == 1
    assert words in found[0]


def steps(workflow):
    return [step for job in workflow["jobs"].values() for step in job["steps"]]


def read(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def test_there_is_a_workflow_for_changes_and_one_for_releases():
    assert [path.stem for path in WORKFLOWS] == ["ci", "release"]


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_runs_what_maintainers_run_and_holds_no_secret(path):
    workflow, text = read(path), path.read_text(encoding="utf-8")
    commands = [step["run"].split()[0] for step in steps(workflow) if "run" in step]
    assert ".ci/run" in commands
    for command in commands:
        if command.startswith(".ci/"):
            assert os.access(ROOT / command, os.X_OK), command
    assert re.search(r"secrets\.|password|token:\s*\w{8}", text) is None
    # A job may write only what it says.
    assert workflow["permissions"] == {"contents": "read"}
    assert all("timeout-minutes" in job for name, job in workflow["jobs"].items() if name in ("check", "build"))


def test_the_release_is_checked_before_it_is_published():
    workflow = read(ROOT / ".github" / "workflows" / "release.yml")
    jobs = workflow["jobs"]
    assert workflow[True] == {"push": {"tags": ["v*"]}}  # YAML 1.1 reads the key "on" as true
    assert {"check", "build"} <= set(jobs["attach"]["needs"]) & set(jobs["publish"]["needs"])
    assert jobs["publish"]["permissions"] == {"id-token": "write"}
    assert any(".ci/check_version.py" in step.get("run", "") for step in jobs["check"]["steps"])
    assert any(".ci/try_release dist" in step.get("run", "") for step in jobs["build"]["steps"])


def test_ci_tries_every_supported_python():
    tried = read(ROOT / ".github" / "workflows" / "ci.yml")["jobs"]["check"]["strategy"]["matrix"]["python"]
    named = re.findall(r"Python :: (3\.\d+)", (ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    script = re.search(r'^pythons="(.*)"$', (ROOT / ".ci" / "try_release").read_text(encoding="utf-8"), re.M)
    assert script is not None
    assert tried == named == script[1].split()
    assert [name.split()[-1] for name in ARCHIVES.CLASSIFIERS] == named


def test_what_archives_need_is_there():
    assert [name for name in ARCHIVES.NEEDED if not (ROOT / "src" / name).is_file()] == []
    assert sorted(ARCHIVES.PACKAGES) == sorted(path.parent.name for path in (ROOT / "src").glob("*/__init__.py"))


def test_the_script_of_releases_is_sound():
    assert subprocess.run(["bash", "-n", ROOT / ".ci" / "try_release"], check=False).returncode == 0


# The sections that the Journal of Open Source Software asks for.
HEADINGS = ["Summary", "Statement of need", "State of the field", "Software design", "Research impact statement"]
HEADINGS += ["Acknowledgements", "References"]


def paper_parts():
    _, header, text = (PAPER / "paper.md").read_text(encoding="utf-8").split("---\n", 2)
    return yaml.safe_load(header), text


def test_the_paper_has_the_sections_and_length_of_joss():
    header, text = paper_parts()
    assert re.findall(r"^# (.*)$", text, re.M) == HEADINGS
    assert {"title", "tags", "authors", "affiliations", "date", "bibliography"} <= set(header)
    assert 750 <= len(text.split()) <= 1000
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))["authors"]
    assert [author["name"] for author in header["authors"]] == [author["name"] for author in cited]
    for picture in re.findall(r"\]\((\S+\.png)\)", text):
        assert (PAPER / picture).is_file(), picture


def test_every_citation_has_an_entry_and_every_entry_is_cited():
    _, text = paper_parts()
    groups = re.findall(r"\[(-?@[^\]]+)\]", text)
    cited = {key for group in groups for key in re.findall(r"@([\w-]+)", group)}
    entries = re.findall(r"^@\w+\{([\w-]+),", (PAPER / "paper.bib").read_text(encoding="utf-8"), re.M)
    assert len(entries) == len(set(entries)) > 5
    assert cited == set(entries)


def test_every_doi_of_the_paper_is_one_that_the_repository_uses():
    found = re.findall(r"^ *doi *= *\{(.*)\}", (PAPER / "paper.bib").read_text(encoding="utf-8"), re.M)
    assert len(found) >= 4
    folders = (ROOT / "docs", ROOT / "src")
    files = [file for folder in folders for ending in ("md", "py", "toml") for file in folder.rglob(f"*.{ending}")]
    used = "\n".join(file.read_text(encoding="utf-8") for file in files)
    assert [doi for doi in found if doi not in used] == []


def test_the_paper_states_the_numbers_of_the_evidence():
    figures = load(PAPER / "figures.py")
    shares = figures.shares()
    text = " ".join(paper_parts()[1].split())
    assert f"tested {len(shares)} claims" in text
    assert shares["hand-thrusts"] == 100.0
    assert f"less power than those of the fruit-fly wing holds in {shares['lower-power']:.0f} %" in text
    assert f"above 10 m/s holds in {shares['pigeon-agrees-usherwood']:.0f} %" in text
    assert f"coefficients of the fruit-fly wing in {shares['twice-the-frequency']:.0f} %" in text
    overview = (ROOT / "docs" / "evidence" / "whole_flights.md").read_text(encoding="utf-8")
    agree = re.search(r"\*\*(\d+ of \d+ comparisons) agree", overview)
    assert agree is not None
    assert f"{agree[1]} with measured flights agree" in text
    rates = [ratio for _, _, ratio in figures.ratios("metabolic_rate")]
    assert median(sum(one) / 2 for one in rates) == pytest.approx(0.5, abs=0.1)
    assert set(figures.NAMED) <= set(shares)
