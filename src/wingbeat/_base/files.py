"""Reads files after checking their kind and size, and writes files completely or not at all."""

from __future__ import annotations

import json
import os
import stat
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from wingbeat._base.errors import FileError, control_in
from wingbeat._leftovers import Leftover

# tomllib's time and memory grow with the square of a dotted key's length: a.a.a... of 200 kB fills the memory of a
# machine.
MAX_LINE = 4096
# The first bytes of files that are taken for texts by mistake, and what they are.
_BINARY = {
    b"\x89HDF": "a NetCDF-4 or HDF5 file, such as a saved result (`wingbeat show` prints those)",
    b"CDF": "a NetCDF-3 file",
    b"MATLAB 5.0": "a MATLAB file",
    b"PK": "a spreadsheet (.xlsx, .ods) or another packed file",
    b"\xd0\xcf\x11\xe0": "an old spreadsheet (.xls)",
    b"\x1f\x8b": "packed with gzip",
    b"%PDF": "a PDF",
    b"\x89PNG": "a picture",
    b"SQLite format 3": "a database, such as the store of a study",
    b"PAR1": "a Parquet file",
}
# What a polar may be called; a name with one of these endings is a path.
POLAR_SUFFIXES = (".csv", ".txt", ".dat", ".pol", ".plr", ".polar", ".tsv", ".drg", ".lft")
# What to do about a control character, which would change what a terminal shows.
_PLAIN = "write plain text"
# Characters of a path in a message.
_SHOWN = 300


def read_text(path: str | os.PathLike[str], *, limit: int = 1 << 20) -> str:
    """Return the text of a UTF-8 file of at most `limit` bytes without control characters, or raise `FileError`."""
    try:
        # A pipe would wait for ever and a device may have no end, so the kind is looked at first.
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise FileError(f"cannot read {_shown(path)}: it is not a file; give the path of a text file")
        with open(path, "rb") as file:
            content = file.read(limit + 1)
    except (OSError, ValueError) as error:
        raise FileError(f"cannot read {_shown(path)}: {_reason(error)}; {_way_out(error)}") from None
    if len(content) > limit:
        raise FileError(f"cannot read {_shown(path)}: it has more than {limit} bytes; is it the right file?")
    try:
        text = content.decode("utf-8-sig")  # Windows editors put a byte-order mark in front
    except UnicodeDecodeError as error:
        why = f"byte {error.start} is not UTF-8 text; save the file as UTF-8 text"
        kinds = [kind for start, kind in _BINARY.items() if content.startswith(start)]
        why = f"it is {kinds[0]}, not a text file" if kinds else why
        raise FileError(f"cannot read {_shown(path)}: {why}") from None
    if (control := control_in(text.replace("\r", "\n"))) is not None:
        where = f"line {text[: text.index(control)].count(chr(10)) + 1}"
        raise FileError(f"cannot read {_shown(path)}: {where} holds the control character {control!r}; {_PLAIN}")
    return text


def toml_tables(text: str, label: str) -> dict[str, Any]:
    """Return the tables of a TOML text; raise `FileError` if it is none, or would take too long to read."""
    longest = max(map(len, text.split("\n")))
    if longest > MAX_LINE:
        why = f"a line has {longest} characters, more than {MAX_LINE}; break it up"
        raise FileError(f"cannot read {label!r}: {why}")
    try:
        tables = tomllib.loads(text)
        # TOML writes them as escapes too, so the check of `read_text` does not see them.
        if (control := control_in(tables)) is not None:
            raise FileError(f"cannot read {label!r}: a text holds the control character {control!r}; {_PLAIN}")
        return tables
    except RecursionError:
        raise FileError(f"cannot read {label!r}: it is nested too deeply; is it the right file?") from None
    except ValueError as error:  # of TOML itself, or a number or date that Python cannot hold
        reason = " ".join(str(error).split())[:200]
        raise FileError(f"cannot read {label!r} as TOML: {reason}; correct the file there") from None


def quoted(text: str) -> str:
    """Return a TOML string, written as JSON: their escapes agree once unprintable characters are removed."""
    return json.dumps("".join(sign for sign in text if sign.isprintable()), ensure_ascii=False)


def make_folder(path: str | os.PathLike[str]) -> None:
    """Make a folder and its parents if they are missing; raise `FileError` if that fails."""
    try:
        Path(path).mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        raise FileError(f"cannot make the folder {_shown(path)}: {_reason(error)}; choose another") from None


@contextmanager
def writing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a temporary path beside `path` to write to; it is renamed to `path` only if the block succeeds.

    The temporary path has the same suffix, because writers choose their format by it. After an error or an
    interrupt the temporary file is deleted, and a file already at `path` is not changed. It raises `FileError` if
    the folder is missing or cannot be written, `path` is a folder or a device, or the disk is full.
    """
    beside: Path | None = None
    try:
        # A link stays a link: the file that it points to is replaced.
        target = Path(os.path.realpath(path))
        if target.exists() and not target.is_file():
            kind = "a folder" if target.is_dir() else "not a plain file"
            raise FileError(f"cannot write {_shown(path)}: it is {kind}; give the path of a file")
        candidate = target.with_name(f".{os.urandom(6).hex()}.part{target.suffix}")
        with Leftover(candidate.unlink):
            # Created here and not by the writer: a folder without permission is refused before hours of work.
            os.close(os.open(candidate, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
            beside = candidate
            yield beside
            if target.exists():
                os.chmod(beside, stat.S_IMODE(target.stat().st_mode))
            os.replace(beside, target)
            beside = None
    except (OSError, ValueError) as error:
        if isinstance(error, ValueError) and beside is not None:
            raise  # a fault of the block's own, not of the path
        raise FileError(f"cannot write {_shown(path)}: {_reason(error)}; {_way_out(error)}") from error
    finally:
        if beside is not None:
            with suppress(OSError):
                beside.unlink()


def write_atomically(path: str | os.PathLike[str], content: str | bytes) -> None:
    """Write text (as UTF-8) or bytes to `path`, completely or not at all; raise `FileError` as `writing` does."""
    data = content.encode() if isinstance(content, str) else content
    with writing(path) as beside, open(beside, "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())  # or a power cut could leave the new name on an empty file


def _shown(path: Any) -> str:
    text = repr(os.fspath(path))
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN // 2]}...{text[-_SHOWN // 2 :]}"


def _reason(error: OSError | ValueError) -> str:
    """Return the system's reason without the path, which the message already contains."""
    text = (error.strerror if isinstance(error, OSError) else None) or str(error) or type(error).__name__
    return text[:1].lower() + text[1:]


def _way_out(error: OSError | ValueError) -> str:
    match error:
        case FileNotFoundError() | NotADirectoryError():
            return "check the path and that its folder exists"
        case PermissionError():
            return "choose another folder or change the permissions"
    return "choose another path"
