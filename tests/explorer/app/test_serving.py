"""What the explorer's server answers without a browser, and the command without what it needs."""

import http.client
import time

from tests.explorer.app.program import PATIENCE, Program
from wingbeat.cli import main


def test_files_for_nobody_are_not_taken(served):
    host, port = served.address.removeprefix("http://").split(":")
    for method, path, headers, status in (
        ("POST", "/wingbeat/upload/nobody", {}, 404),
        ("GET", "/wingbeat/downloads/nothing", {}, 404),
        ("GET", "/wingbeat/downloads/..%2F..%2Fpage.py", {}, 404),
        ("GET", "/", {"host": "elsewhere.example"}, 400),
    ):
        line = http.client.HTTPConnection(host, int(port), timeout=60)
        line.request(method, path, headers=headers)
        answer = line.getresponse()
        assert (path, answer.status) == (path, status)
        assert status == 400 or "default-src 'self'" in answer.headers["content-security-policy"]
        line.close()


def test_an_address_cannot_choose_what_a_file_holds(served):
    host, port = served.address.removeprefix("http://").split(":")
    for path in ("page.js", "page.css", "explorer.js", "first.json"):
        answers = []
        for query in ("", "?kind=text/html&content=%3Cscript%3E"):
            line = http.client.HTTPConnection(host, int(port), timeout=60)
            line.request("GET", f"/wingbeat/{path}{query}")
            answer = line.getresponse()
            answers.append((answer.status, answer.headers["content-type"], answer.read()))
            line.close()
        assert answers[0][0] == 200
        assert answers[1] == answers[0]


def test_pages_that_are_only_fetched_are_few(served, monkeypatch):
    from nicegui import Client

    program, pages = Program.__new__(Program), served.house.pages
    program.port = int(served.address.rpartition(":")[2])
    monkeypatch.setattr("wingbeat_explorer.app.pages.MOST_WAITING", 4)
    client, session = program.open_page()
    with program.connect(client):  # a visitor, who stays whatever others fetch
        until = time.monotonic() + PATIENCE
        while pages[session].waits:
            assert time.monotonic() < until
            time.sleep(0.02)
        fetched = [program.open_page()[1] for _ in range(7)]
        assert [name for name, page in pages.items() if page.waits] == fetched[-4:]
        assert pages[session].is_open
        # NiceGUI, too, has forgotten them.
        assert len(Client.instances) <= len(pages) + 1


def test_without_the_extra_the_command_says_how_to_get_it(monkeypatch, capsys):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert main(["app", "--no-open"]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert "pip install '.[app]'" in lines[0]
