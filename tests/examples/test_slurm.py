"""examples/sweep-slurm.sbatch and sweep-array.sbatch under a Slurm of its own on this machine: controller, node and authentication.

Needs root and Debian's slurmctld, slurmd, slurm-client and munge, but no systemd; skipped otherwise.  Environment:
FESTOON is the program, SOURCE_DIR the source tree.

labels: long"""

import os
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

import events
from sweep_tools import FESTOON, Case, festoon

SCRIPT = os.path.join(os.environ["SOURCE_DIR"], "examples", "sweep-slurm.sbatch")
NEEDED = ("slurmctld", "slurmd", "srun", "sbatch", "scancel", "munged")
CONFIGURATION = """
ClusterName=festoon
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
SlurmctldPort={controller_port}
SlurmdPort={node_port}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
NodeName=here NodeHostname={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=here Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as trial:
        trial.bind(("127.0.0.1", 0))
        return trial.getsockname()[1]


class Slurm(Case):
    def setUp(self):
        super().setUp()
        os.chmod(self.directory, 0o755)
        for name in ("state", "spool"):
            os.mkdir(self.path(name))
        with open(self.path("munge.key"), "wb") as key:
            key.write(os.urandom(1024))
        os.chmod(self.path("munge.key"), 0o600)
        with open(self.path("slurm.conf"), "w", encoding="ascii") as out:
            out.write(CONFIGURATION.format(host=socket.gethostname().split(".")[0], folder=self.directory,
                                           controller_port=free_port(), node_port=free_port()))
        self.environment = dict(os.environ, SLURM_CONF=self.path("slurm.conf"), FESTOON=FESTOON,
                                DATABASE="")
        for name in ("slurmd", "slurmctld", "munge"):  # ended in this order, the last one first
            self.addCleanup(self.end, self.path(name + ".pid"))
        self.run_tool("munged", "--force", *[f"--{what}={self.path('munge.' + ending)}" for what, ending in (
            ("key-file", "key"), ("socket", "socket"), ("pid-file", "pid"), ("log-file", "log"), ("seed-file", "seed"))])
        self.run_tool("slurmctld", "-i")
        self.run_tool("slurmd", "-N", "here")
        self.wait_until(lambda: "idle" in self.run_tool("sinfo", "-h", "-o", "%t"), events.HANG)

    def end(self, pid_file):
        try:
            with open(pid_file, encoding="ascii") as file:
                pid = int(file.read())
            os.kill(pid, signal.SIGTERM)
            self.wait_until(lambda: not os.path.exists(f"/proc/{pid}"), 30)
        except (OSError, ValueError):
            pass

    def run_tool(self, *words):
        done = subprocess.run(words, env=self.environment, cwd=self.directory, stdin=subprocess.DEVNULL, timeout=events.HANG,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 0, (words, done.stderr))
        return done.stdout.decode()

    def wait_until(self, condition, seconds):
        limit = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), limit, "waited in vain")
            time.sleep(0.1)

    def submit(self, count):
        return self.run_tool("sbatch", "--parsable", SCRIPT, str(count)).strip()

    def wait_for_jobs(self, seconds=events.HANG):
        self.wait_until(lambda: not self.run_tool("squeue", "-h").strip(), seconds)

    def content(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def test_a_cancelled_job_goes_on(self):
        def blow(size):
            points = size * size
            self.environment["DATABASE"] = path = self.path(f"{size}.db")
            job = self.submit(size)
            self.wait_until(lambda: events.rows(path) > 0 or not self.run_tool("squeue", "-h").strip(), events.HANG)
            self.run_tool("scancel", job)
            self.wait_for_jobs()
            first = events.rows(path)
            self.assertGreater(first, 0, self.content(f"festoon-sweep-{job}.log"))
            if first == points:
                return False  # the job was over before
            job = self.submit(size)
            self.wait_for_jobs()
            self.assertIn(f"all {points} points, {points - first} of them new", self.content(f"festoon-sweep-{job}.log"))
            self.good("sweep", "--set", "run.periods=200", "--set", "run.discard=100", "--over",
                      f"drive.frequency=1Hz:40Hz:{size}", "--over", f"model.kappa=0.1:3:{size}", "-o",
                      self.path(f"alone{size}.db"))
            self.assertEqual(self.rows(f"{size}.db"), self.rows(f"alone{size}.db"))
            return True
        events.struck(blow, 16, factor=2)


    def test_a_job_array(self):
        script, words = SCRIPT.replace("-slurm", "-array"), ["3", "4"]
        self.run_tool("sbatch", "--array=1-3", script, *words)
        self.wait_for_jobs()
        names = [self.path(f"sweep-array-{i}.db") for i in (1, 2, 3)]
        self.assertIn("all 16 points", self.good("merge", *names, "-o", self.path("all.db")))
        self.run_tool("sbatch", "--array=2", script, *words)  # again, alone
        self.wait_for_jobs()
        logs = [self.content(name) for name in os.listdir(self.directory) if name.startswith("festoon-shards-")]
        self.assertEqual(sum("of shard 2/3, 0 of them new" in log for log in logs), 1, logs)


if __name__ == "__main__":
    missing = [name for name in NEEDED if not shutil.which(name)]
    if os.getuid() != 0 or missing or "mpi yes" not in festoon("--version")[1]:
        print(f"skipped: needs root and MPI, and misses {', '.join(missing) or 'no program'} "
              "(slurmctld, slurmd, slurm-client, munge)")
        sys.exit(77)
    unittest.main()
