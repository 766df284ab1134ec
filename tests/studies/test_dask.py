"""Studies on Dask: the same answers, and nothing lost whoever dies."""

import os
import pickle
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import time

import dask
import distributed
import pytest

import wingbeat as wb
from tests.helpers.places import ROOT
from tests.helpers.study_standin import CRASHES, HANGS, KILLS_PARENT, RAISES
from wingbeat._base import NUMERICAL_VERSION
from wingbeat.studies import dask_engine
from wingbeat.studies.dask_engine import Order, solve_batch

pytestmark = pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="looks for processes in /proc")
GRID = [1 + 0.25 * i for i in range(100)]
RUN = "import sys; from distributed.cli import {0}; sys.argv[0] = '{0}'; {0}.main()"


class Cluster:
    """A scheduler and workers on this host's loopback, each a process of its own, all with a study's mark."""

    def __init__(self, study, seconds=0.02, log="", protocol="tcp", **settings):
        self.environment = os.environ | {
            "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path]),
            "STUDY_MARK": study.mark,
            "STANDIN_SECONDS": str(seconds),
            "STANDIN_LOG": str(log),
            **settings,
        }
        self.study = study
        self.workers = []
        words = ("--host", "127.0.0.1", "--port", "0", "--protocol", protocol, "--no-dashboard", "--no-show")
        self.scheduler = self.start("dask_scheduler", *words, stderr=subprocess.PIPE, text=True)
        for line in self.scheduler.stderr:
            if found := re.search(r"Scheduler at:\s+(\w+://\S+)", line):
                self.address = found[1]
                break

    def start(self, what, *words, environment=None, **popen):
        words = [sys.executable, "-c", RUN.format(what), *words]
        return subprocess.Popen(words, env=self.environment | (environment or {}), **popen)

    def add_worker(self, *words, **environment):
        words = (self.address, "--nthreads", "1", "--no-dashboard", "--host", "127.0.0.1", *words)
        worker = self.start("dask_worker", *words, environment=environment, stderr=subprocess.DEVNULL)
        self.workers.append(worker)
        return worker

    def solvers(self):
        """Return the processes that solve, whoever started them."""
        found = []
        for process in self.study.processes():
            with open(f"/proc/{process}/cmdline", "rb") as file:
                if b"wingbeat._workers.process" in file.read():
                    found.append(process)
        return found

    def close(self):
        for process in (self.scheduler, *self.workers):
            process.kill()
        for process in (self.scheduler, *self.workers):
            process.wait()
        self.scheduler.stderr.close()


@pytest.fixture
def cluster():
    """Return a maker of clusters that are closed in the end, which leaves no process behind."""
    made = []

    def make(study, **settings):
        made.append(Cluster(study, **settings))
        return made[-1]

    yield make
    for one in made:
        one.close()
        one.study.wait_gone()


def wait_for(what, seconds=40):
    until = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < until
        time.sleep(0.02)


def undisturbed(cheap, speeds):
    study = cheap(speeds, "undisturbed")
    assert study.run("run", study.file, "-j", 1, "--allow-failures")[0] == 0
    return study.points()


@pytest.mark.slow
def test_killed_workers_and_a_killed_driver_lose_nothing(cheap, cluster, tmp_path):
    study, log = cheap(GRID), tmp_path / "log"
    machines = cluster(study, log=log)
    other = tmp_path / "jax-0.0.1.dist-info"
    other.mkdir()
    (other / "METADATA").write_text("Metadata-Version: 2.1\nName: jax\nVersion: 0.0.1\n")
    machines.add_worker("--no-nanny")
    machines.add_worker("--no-nanny")
    machines.add_worker("--no-nanny", PYTHONPATH=f"{tmp_path}{os.pathsep}{machines.environment['PYTHONPATH']}")
    with distributed.Client(machines.address, set_as_default=False) as client:
        client.wait_for_workers(3, timeout=40)  # or the two that fit are done before the third joins
    driver = study.start("run", study.file, "--dask", machines.address)
    wait_for(lambda: len(study.points()) > 5)
    machines.workers[0].kill()
    wait_for(lambda: len(study.points()) > 25)
    os.kill(machines.solvers()[0], signal.SIGKILL)
    wait_for(lambda: len(study.points()) > 45)
    driver.kill()
    _, err = driver.communicate()
    assert "jax 0.0.1, not " in err
    assert "results then agree only within the tolerance of the certificates" in err
    time.sleep(0.3)  # what was in flight is given up
    kept, before = study.points(), log.read_text().split()
    assert len(kept) < len(GRID)
    driver = study.start("run", study.file, "--dask", machines.address)
    out, err = driver.communicate(timeout=60)
    assert driver.returncode == 0, err
    assert f"converged {len(GRID)}" in " ".join(out.split())
    assert study.points() == undisturbed(cheap, GRID)
    assert not set(log.read_text().split()[len(before) :]) & set(kept)
    # The driver's leave is its processes', too: those of the cluster alone are left.
    assert machines.solvers() == []
    assert len(study.processes()) == 3


@pytest.mark.slow
def test_a_point_that_takes_its_dask_worker_along_fails_alone(cheap, cluster):
    # Without retries of Dask's own, so that whatever shares a worker with that point is lost with it.
    study = cheap([KILLS_PARENT, *GRID[:10]])
    machines = cluster(study, DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES="0")
    machines.add_worker()
    driver = study.start("run", study.file, "--dask", machines.address)
    out, err = driver.communicate(timeout=100)
    assert driver.returncode == 3, err
    assert "converged 10 crashed 1" in " ".join(out.split())
    assert "crashed: speed = 94: the Dask workers that ran this batch died" in out
    assert "Traceback" not in err


@pytest.mark.slow
def test_a_scheduler_that_dies_is_told_and_the_study_goes_on_elsewhere(cheap, cluster):
    study = cheap(GRID)
    machines = cluster(study)
    driver = study.start("run", study.file, "--dask", machines.address)
    # Without workers it waits; one that comes later is set to work.
    assert "the Dask scheduler has no workers; waiting until one joins it" in driver.stderr.readline()
    machines.add_worker("--no-nanny")
    wait_for(lambda: len(study.points()) > 5)
    machines.scheduler.kill()
    _, err = driver.communicate(timeout=60)
    assert driver.returncode == 2, err
    assert f"the Dask scheduler at {machines.address} is gone" in err
    assert "stored results remain: start the scheduler again and run the study again" in err
    assert "Traceback" not in err
    assert 5 < len(study.points()) < len(GRID)
    assert study.run()[0] == 0
    assert study.points() == undisturbed(cheap, GRID)


@pytest.mark.slow
def test_dask_of_this_machine_through_the_program(cheap):
    speeds = [CRASHES, HANGS, RAISES, *GRID[:40]]
    study = cheap(speeds)
    driver = study.start("run", study.file, "--dask", "local:2", "--timeout", 1)
    out, err = driver.communicate(timeout=60)
    assert driver.returncode == 3, err
    assert "with 2 processes" in err
    assert "Traceback" not in err
    assert "converged 40 error 1 crashed 1 timeout 1" in " ".join(out.split())
    assert "crashed: speed = 90: its process ended with SIGKILL" in out
    assert "timeout: speed = 91: no result within 1 s" in out
    study.wait_gone()
    kept = study.points()
    study.write(GRID[:40])
    assert {key: row for key, row in kept.items() if row[0] == "converged"} == undisturbed(cheap, GRID[:40])


@pytest.mark.slow
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGKILL, -9)])
def test_a_driver_with_its_own_cluster_leaves_no_process(cheap, number, code):
    study = cheap(GRID)
    driver = study.start("run", study.file, "--dask", "local:2", seconds=0.05)
    wait_for(lambda: len(study.points()) > 3)
    driver.send_signal(number)
    driver.communicate(timeout=30)
    assert driver.returncode == code
    study.wait_gone()
    assert 3 < len(study.points()) < len(GRID)


@pytest.mark.slow
def test_records_are_those_of_local_processes_to_the_bit(tmp_path):
    form = {"species": "pigeon", "starts": 1, "vary": {"speed": {"grid": [9.0, 11.0]}}}
    found = []
    for name, how in (("local", {"processes": 1}), ("dask", {"dask": "local:1"})):
        study = wb.plan_study(form, store=tmp_path / f"{name}.study.sqlite")
        assert study.run(**how).counts == {"converged": 2}
        connection = sqlite3.connect(study.store)
        question = "SELECT key, status, record, certificate, error FROM points ORDER BY key"
        found.append(connection.execute(question).fetchall())
        connection.close()
    assert found[0] == found[1]


def test_a_cluster_of_somebody_else_is_used_and_left_as_it_is(cheap):
    study = cheap(GRID[:5])
    words = {"dashboard_address": "127.0.0.1:0", "worker_dashboard_address": "127.0.0.1:0"}
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=False, **words) as theirs:
        assert wb.plan_study(study.file).run(dask=theirs).counts == {"converged": 5}
        with distributed.Client(theirs, set_as_default=False) as client:
            assert client.submit(abs, -1).result() == 1
    assert study.points() == undisturbed(cheap, GRID[:5])


def test_what_cannot_be_used_is_explained(cheap, monkeypatch):
    study = cheap(GRID[:2])
    monkeypatch.setattr(dask_engine, "_CONNECT", 0.5)
    code, _, err = study.run("run", study.file, "--dask", "tcp://127.0.0.1:9")
    assert code == 2
    assert "no Dask scheduler answers at tcp://127.0.0.1:9; check the address" in err
    begun = time.monotonic()
    code, _, err = study.run("run", study.file, "--dask", "tls://127.0.0.1:9")
    assert code == 2
    assert "tls://127.0.0.1:9 needs certificates, and Dask has none here; set DASK_DISTRIBUTED__COMM__" in err
    files = dict.fromkeys(("ca-file", "client.cert", "client.key"), "missing.pem")
    with dask.config.set({f"distributed.comm.tls.{name}": file for name, file in files.items()}):
        code, _, err = study.run("run", study.file, "--dask", "tls://127.0.0.1:9")
    assert (code, "cannot read the certificates for tls://127.0.0.1:9: no such file" in err) == (2, True), err
    assert time.monotonic() - begun < 15  # Dask's client would wait for 20 s
    for wrong in ("127.0.0.1:9", "local:0", "local:", "http://127.0.0.1:9"):
        code, _, err = study.run("run", study.file, "--dask", wrong)
        assert (code, "names no Dask cluster; give tcp://HOST:PORT" in err) == (2, True), err
    code, _, err = study.run("run", study.file, "--dask", "local:1", "-j", 1)
    assert (code, "cannot be combined with a Dask cluster" in err) == (2, True), err
    monkeypatch.setitem(sys.modules, "distributed", None)
    code, _, err = study.run("run", study.file, "--dask", "local:1")
    assert (code, "pip install '.[cluster]'" in err) == (2, True), err
    assert study.points() == {}


@pytest.mark.skipif(shutil.which("openssl") is None, reason="needs the program openssl")
def test_a_cluster_with_the_certificates_of_the_guide(cheap, cluster, tmp_path):
    page = (ROOT / "docs/guide/clusters.md").read_text()
    (block,) = re.findall(r"```bash\n(TLS=.*?)```", page, re.DOTALL)
    words = ["bash", "-ec", block + "\nenv -0"]
    told = subprocess.check_output(words, env=os.environ | {"HOME": str(tmp_path)}, stderr=subprocess.DEVNULL)
    settings = dict(line.split("=", 1) for line in told.decode().split("\0") if line.startswith("DASK_"))
    study = cheap(GRID[:5])
    machines = cluster(study, seconds=0.0, protocol="tls", **settings)
    machines.add_worker("--no-nanny")
    assert machines.address.startswith("tls://")
    code, _, err = study.run("run", study.file, "--dask", machines.address)
    assert (code, "needs certificates, and Dask has none here" in err) == (2, True), err
    driver = study.start("run", study.file, "--dask", machines.address, env=settings)
    _, err = driver.communicate(timeout=60)
    assert driver.returncode == 0, err
    assert len(study.points()) == 5


def test_workers_with_other_numbers_are_refused(cheap, monkeypatch):
    study = cheap(GRID[:2])
    _, versions_of_packages = dask_engine.greet()
    monkeypatch.setattr(dask_engine, "greet", lambda: (NUMERICAL_VERSION - 1, versions_of_packages))
    code, _, err = study.run("run", study.file, "--dask", "local:1")
    assert code == 2
    versions = f"version {NUMERICAL_VERSION - 1}, but this process has version {NUMERICAL_VERSION}"
    assert f"has a wingbeat of numerical {versions}" in err
    # One that joined in between refuses by itself.
    order = Order(1, [], "tests.helpers.study_standin:solve", 1.0, "someone", NUMERICAL_VERSION + 1)
    with pytest.raises(wb.ClusterError, match="install the same wingbeat there"):
        solve_batch(pickle.dumps(order))
