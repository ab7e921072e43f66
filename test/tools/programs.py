# SPDX-License-Identifier: BSD-3-Clause
"""Runs the programs as their users do. Their folder is the test's first argument."""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = pathlib.Path(sys.argv.pop(1))
TOPIC = "/camera/image_raw"


def run(program, *arguments, **options):
    """The ended process, with what it printed as text. Names in it may be no UTF-8."""
    return subprocess.run([PROGRAMS / program, *map(str, arguments)], text=True, errors="replace",
                          capture_output=True, **options)


def points_in(folder):
    """The points of a sequence's init.yaml as --points takes them."""
    for line in (folder / "init.yaml").read_text().splitlines():
        if line.startswith("points:"):
            return "".join(c for c in line[len("points:"):] if c not in "[] ")
    raise ValueError(f"{folder}/init.yaml has no points")


def summary_in(folder):
    return json.loads((folder / "summary.json").read_text())


def without_times(path):
    """The rows of a CSV file, without the column time_ms."""
    with open(path, newline="") as file:
        return [{key: value for key, value in row.items() if key != "time_ms"}
                for row in csv.DictReader(file)]


class ProgramTest(unittest.TestCase):
    """With a folder to write into, and rendered sequences."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="chain_tracker_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)

    @classmethod
    def render(cls, name, scene="bottle", frames=20, *options):
        """A small sequence folder."""
        folder = cls.folder / name
        ended = run("synthesize", "--scene", scene, "--frames", frames, "--width", 320, "--height",
                    240, "--out", folder, *options)
        assert ended.returncode == 0, ended.stderr
        return folder

    def evaluate(self, *arguments, code=0):
        """Runs `evaluate`, checks its exit code, returns what it said on standard error."""
        ended = run("evaluate", *arguments)
        self.assertEqual(ended.returncode, code, ended.stderr)
        return ended.stderr
