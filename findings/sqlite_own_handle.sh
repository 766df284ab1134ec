#!/usr/bin/env bash
# One would guess: a program that has an SQLite database open may also read the file, for example to check its header.
# What happens: closing that handle drops all POSIX locks of the process on the file, SQLite's own too. The next
# process that opens and closes the database takes the log for one that nobody uses, and deletes it. The first
# process goes on writing to the deleted log: SQLite reports no error, and rows of one of the two are lost.
# Where it bites: a checksum or a file-type check in a process that also writes the database.
# It needs Python 3 with its sqlite3 module, and a local file system of Linux.
set -euo pipefail
command -v python3 >/dev/null || { echo "install python3"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >look.py <<'PY'
import sqlite3
import sys

other = sqlite3.connect(sys.argv[1])
other.execute("SELECT COUNT(*) FROM rows").fetchall()
if len(sys.argv) > 2:
    other.execute("INSERT INTO rows VALUES ('other')")
    other.commit()
other.close()
PY
cat >own_handle.py <<'PY'
import sqlite3
import subprocess
import sys

print(f"SQLite {sqlite3.sqlite_version}, Python {sys.version.split()[0]}")


def rows(name, reads):
    """Return the rows that are left after two processes have written one each, and this one has read the file."""
    own = sqlite3.connect(name, isolation_level=None)
    own.execute("PRAGMA journal_mode = WAL")
    own.execute("CREATE TABLE rows (who TEXT)")
    if reads:
        open(name, "rb").close()
    subprocess.run([sys.executable, "look.py", name], check=True)
    own.execute("INSERT INTO rows VALUES ('own')")
    subprocess.run([sys.executable, "look.py", name, "write"], check=True)
    own.execute("INSERT INTO rows VALUES ('own')")
    own.close()
    with sqlite3.connect(name) as again:
        return [who for (who,) in again.execute("SELECT who FROM rows")]


plain, read = rows("plain.db", False), rows("read.db", True)
print("without reading the file:", plain)
print("after reading the file:  ", read)
sys.exit(0 if plain == ["own", "other", "own"] and len(read) < 3 else "the behaviour has changed")
PY
python3 own_handle.py
