"""Who may come in, asked of the real program: no other origin, no other name, no message that makes no sense."""

import json
import re
import threading
from pathlib import Path

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from tests.explorer.app.program import PATIENCE, Program
from wingbeat_explorer.app.door import is_loopback


@pytest.fixture(scope="module")
def program(tmp_path_factory, explorers):
    program = Program(explorers, tmp_path_factory.mktemp("program"))
    yield program
    program.end()


@pytest.fixture
def own_log(program):
    """See in the end that nothing was written to the log but sentences, and that the server lives."""
    before = len(program.log.read_text())
    yield
    assert program.request("/wingbeat/page.js")[0] == 200
    written = program.log.read_text()[before:]
    assert "Traceback" not in written, written
    assert all(len(line) < 400 for line in written.splitlines())


pytestmark = pytest.mark.usefixtures("own_log")


@pytest.mark.slow
@pytest.mark.parametrize("origin", ["http://evil.example", "http://127.0.0.1:1", "null", "http://["])
def test_a_page_of_another_origin_cannot_drive_the_explorer(program, origin):
    client, _ = program.open_page()
    with pytest.raises(InvalidStatus) as refused, program.connect(client, origin=origin):
        pass
    assert refused.value.response.status_code == 403
    assert "The explorer accepts nothing from pages of another origin" in program.log.read_text()


def test_the_pages_own_origin_is_taken(program):
    client, _ = program.open_page()
    with program.connect(client, origin=f"http://127.0.0.1:{program.port}") as page:
        assert page.close_code is None


@pytest.mark.parametrize("origin", ["http://evil.example", "null"])
def test_a_page_of_another_origin_cannot_upload(program, origin):
    client, session = program.open_page()
    with program.connect(client):
        upload = f"/wingbeat/upload/{session}?name=x.toml"
        status, text = program.request(upload, "POST", b"x = 1", Origin=origin)
        assert (status, "another origin" in text) == (403, True)
        own = f"http://127.0.0.1:{program.port}"
        assert program.request(upload, "POST", b"x = 1", Origin=own)[0] == 204


def test_under_another_name_nothing_is_answered(program):
    """A page elsewhere may give this machine a name of its own; it is of the same origin then."""
    client, session = program.open_page()
    name = f"evil.example:{program.port}"
    for path, method in (("/", "GET"), (f"/wingbeat/upload/{session}", "POST")):
        status, text = program.request(path, method, Host=name, Origin=f"http://{name}")
        assert (status, "does not answer under the name 'evil.example" in text) == (400, True)
    with pytest.raises(InvalidStatus), program.connect(client, host="evil.example", origin=f"http://{name}"):
        pass


def test_a_public_server_does_not_answer_under_other_names_either(tmp_path, explorers):
    program = Program(explorers, tmp_path, "--host", "0.0.0.0")
    try:
        assert program.request("/wingbeat/page.js", Host="evil.example")[0] == 400
        assert program.request("/wingbeat/page.js", Host=f"192.0.2.7:{program.port}")[0] == 200
        assert program.host == "127.0.0.1"
        assert "every address of this machine" in program.log.read_text()
        assert "there are no passwords" in program.log.read_text()
    finally:
        program.end()


@pytest.mark.parametrize("words", [["--host", " "], []], ids=["blank", "none given"])
def test_an_empty_host_is_this_machine_alone_until_it_is_interrupted(tmp_path, explorers, words):
    program = Program(explorers, tmp_path, *words)
    try:
        assert re.fullmatch(r"wingbeat explorer: http://127\.0\.0\.1:\d+ \(Ctrl-C ends it\)\n", program.line)
        sockets = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
        listening = {
            own for _, own, _, state, *_ in sockets if own.endswith(f":{program.port:04X}") and state == "0A"
        }
        assert listening == {f"0100007F:{program.port:04X}"}
        assert program.log.read_text() == ""
        assert program.interrupt()[0] == 130
    finally:
        program.end()


def test_what_is_loopback():
    assert [is_loopback(host) for host in ("127.0.0.2", "::1", "LocalHost", "::", "10.0.0.1", "", "a.b")] == [
        *(True, True, True),
        *(False, False, False, False),
    ]


def told(name, **what):
    return "42" + json.dumps([name, what])


MESSAGES = {
    "nothing": "",
    "bytes": b"\x00\x01",
    "no type": "x",
    "an unknown type": "9",
    "an empty message": "4",
    "an upgrade": "2probe",
    "an empty event": "42",
    "no JSON": "42[",
    "deep JSON": "42" + "[" * 100_000 + "]" * 100_000,
    "no list": "42{}",
    "no name": "42[]",
    "no argument": '42["event"]',
    "a number": '42["event",5]',
    "an attachment": '451-["event",{"_placeholder":true,"num":0}]',
    "an event that is none": '42["disconnect",{}]',
    "no client": told("event"),
    "no handshake": told("handshake"),
    "no text in a log": told("log", client_id="CLIENT", level="x"),
    "an acknowledgement of nothing": told("ack", client_id="CLIENT"),
    "no listener": told("event", client_id="CLIENT", id=4, listener_id="x", args=[]),
    "no element": told("event", client_id="CLIENT", id={}, listener_id="x", args=[]),
    "an argument that is no JSON": told("event", client_id="CLIENT", id=4, listener_id="x", args=["{"]),
}


@pytest.mark.slow
@pytest.mark.parametrize("message", MESSAGES.values(), ids=MESSAGES)
def test_a_message_that_makes_no_sense_closes_its_socket_with_a_sentence(program, message):
    client, _ = program.open_page()
    with program.connect(client) as page:
        page.send(message.replace("CLIENT", client) if isinstance(message, str) else message)
        with pytest.raises(ConnectionClosed) as closed:
            list(iter(lambda: page.recv(PATIENCE), None))  # until it is closed
    assert (closed.value.rcvd.code, closed.value.rcvd.reason) == (
        1008,
        "The message was not understood; load the page again.",
    )


@pytest.mark.parametrize(
    ("path", "status"),
    [
        (f"/?species={70_000 * 'a'}", 200),
        (f"/{70_000 * 'a'}", 414),
        ("/%00", 400),
        ("/wingbeat/downloads/%00", 400),
        ("/wingbeat/upload/%00", 400),
        ("/_nicegui_ws/socket.io/?EIO=4&transport=polling", 400),
        ("/nothing", 404),
    ],
)
def test_an_address_that_makes_no_sense_is_answered_in_words(program, path, status):
    answer = program.request(path)
    assert answer[0] == status
    assert answer[1].strip()


@pytest.mark.slow
def test_a_long_link_says_so(visit):
    page = visit(f"species={70_000 * 'a'}")
    page.locator(".trouble", has_text="must be at most 24000").wait_for()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a%00b.toml", b"", "holds nothing"),
        ("x" * 70_000 + ".toml", b"", "more than 1048576"),
        ("x.toml", b'name = "' + b"x" * 70_000 + b'"', "x.toml"),
        ("x.toml", b"a = " + b"9" * 70_000, "x.toml"),
        ("x.json", b'{"wingbeat_explorer": 1, "state": {"speed": ' + b"9" * 70_000 + b"}}", "as JSON"),
        ("x.json", b'{"wingbeat_explorer": 1, "state": {"species_file": "\\ud800"}}', "is not understood"),
        ("x.json", b'{"wingbeat_explorer": 1, "state": {"species": "a\\u0000"}}', "is not understood"),
    ],
)
def test_an_upload_that_makes_no_sense_is_refused_in_words(program, name, content, words):
    client, session = program.open_page()
    with program.connect(client) as page:
        status, text = program.request(f"/wingbeat/upload/{session}?name={name}", "POST", content)
        if len(name) > 60_000:  # the whole head of the request is longer than any server takes
            assert status in (204, 400, 414)
            return
        assert (status, text) == (204, "")
        heard = ""
        while words not in heard:
            heard += page.recv(PATIENCE)


def test_a_page_that_is_only_fetched_starts_no_solve(served, monkeypatch):
    asked, once = [], threading.Event()
    submit, earlier = served.house.pool.submit, set(served.house.pages)

    def note(session, what, tell, background=False):
        if session not in earlier:  # pages of other tests live on for a while
            asked.append(what["do"])
            once.set()
        return submit(session, what, tell, background)

    monkeypatch.setattr(served.house.pool, "submit", note)
    program = Program.__new__(Program)
    program.port = int(served.address.rpartition(":")[2])
    client, session = program.open_page()
    assert program.request(f"/wingbeat/upload/{session}?name=x", "POST", b"x = 1")[0] == 404
    assert asked == []  # a page is built before it is answered, and what it asks for is asked then
    with program.connect(client):
        assert once.wait(PATIENCE)
    assert asked[0] == "orbit"
