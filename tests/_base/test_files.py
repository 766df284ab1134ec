"""Files are read with care, and written whole or not at all."""

import os
from pathlib import Path

import pytest

from wingbeat._base import FileError, read_text, write_atomically, writing


def test_writing_replaces_and_keeps_permissions(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    write_atomically(path, "one")
    path.chmod(0o640)
    write_atomically(path, b"two")
    assert path.read_text() == "two"
    assert path.stat().st_mode & 0o777 == 0o640
    assert os.listdir(tmp_path) == ["a.toml"]


def test_a_link_is_written_through(tmp_path: Path) -> None:
    (tmp_path / "real.txt").write_text("old")
    (tmp_path / "link.txt").symlink_to(tmp_path / "real.txt")
    write_atomically(tmp_path / "link.txt", "new")
    assert (tmp_path / "link.txt").is_symlink()
    assert (tmp_path / "real.txt").read_text() == "new"


@pytest.mark.parametrize("error", [KeyboardInterrupt, RuntimeError, ValueError])
def test_an_interrupt_leaves_the_old_file_and_nothing_else(tmp_path: Path, error: type[BaseException]) -> None:
    path = tmp_path / "a.txt"
    path.write_text("old")

    def write_half() -> None:
        with writing(path) as beside:
            assert beside.suffix == ".txt"
            beside.write_text("half")
            raise error

    with pytest.raises(error):
        write_half()
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["a.txt"]


def test_a_full_disk_is_told_with_the_path(tmp_path: Path) -> None:
    def write_too_much() -> None:
        with writing(tmp_path / "a.txt"):
            raise OSError(28, "No space left on device")

    with pytest.raises(FileError, match=r"a\.txt.*no space left on device"):
        write_too_much()
    assert os.listdir(tmp_path) == []


def test_places_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for path in (tmp_path, tmp_path / "none" / "a", tmp_path / "file" / "a", "/dev/null", "a\0b", "x" * 5000):
        with pytest.raises(FileError, match="cannot write"):
            write_atomically(path, "text")


def test_text_is_read_up_to_its_limit(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("12345")
    assert read_text(path, limit=5) == "12345"
    with pytest.raises(FileError, match="more than 4 bytes"):
        read_text(path, limit=4)


@pytest.mark.parametrize(
    ("start", "words"),
    [
        (b"\x89HDF\r\n\x1a\n", "a NetCDF-4 or HDF5 file, such as a saved result"),
        (b"MATLAB 5.0 MAT-file\xff", "a MATLAB file"),
        (b"PK\x03\x04\xff", r"a spreadsheet \(.xlsx, .ods\)"),
        (b"SQLite format 3\x00\xff", "a database, such as the store of a study"),
    ],
)
def test_a_file_that_is_no_text_is_named(tmp_path: Path, start: bytes, words: str) -> None:
    (tmp_path / "given.toml").write_bytes(start + b"\x00\xff" * 40)
    with pytest.raises(FileError, match=f"cannot read .*given.toml': it is {words}.*, not a text file"):
        read_text(tmp_path / "given.toml")
