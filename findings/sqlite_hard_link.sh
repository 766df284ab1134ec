#!/usr/bin/env bash
# One would guess: a database may be opened by any of its names, since all hard links are the same file.
# What happens: SQLite follows symbolic links, but keeps a write-ahead log for each hard link. Through the second
# name, a database in use cannot even be read: "disk I/O error", as if the disk were broken.
# Where it bites: backups and caches that save space by hard links (cp -al, rsync --link-dest).
set -euo pipefail
command -v python3 >/dev/null || { echo "install python3"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >links.py <<'PY'
import os
import sqlite3
import sys

print(f"SQLite {sqlite3.sqlite_version}, Python {sys.version.split()[0]}")
own = sqlite3.connect("a.db", isolation_level=None)
own.execute("PRAGMA journal_mode = WAL")
own.execute("CREATE TABLE rows (who TEXT)")
own.execute("PRAGMA wal_checkpoint(TRUNCATE)")
own.execute("INSERT INTO rows VALUES ('own')")
os.symlink("a.db", "symbolic.db")
os.link("a.db", "hard.db")


def read(name):
    try:
        return str(sqlite3.connect(name).execute("SELECT who FROM rows").fetchall())
    except sqlite3.Error as error:
        return f"{type(error).__name__}: {error}"


symbolic, hard = read("symbolic.db"), read("hard.db")
print("through a symbolic link:", symbolic)
print("through a hard link:    ", hard)
sys.exit(0 if symbolic == "[('own',)]" and hard != symbolic else "the behaviour has changed")
PY
python3 links.py
