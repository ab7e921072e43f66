# SPDX-License-Identifier: BSD-3-Clause
"""The launch files: what they make of their arguments. Nothing is started."""
import os
import subprocess
import unittest

from programs import ProgramTest

OF_CONFIG = {"points": "1,2,3,4", "default_model": "bottle", "default_id": "hand",
             "image_transport": "compressed", "history": "3"}


def roslaunch(*arguments):
    return subprocess.run(["roslaunch", *map(str, arguments)], text=True, check=True,
                          stdout=subprocess.PIPE).stdout


def tracker_parameters(*arguments):
    """The private parameters of the tracker, as text."""
    prefix = "/chain_tracker/"
    lines = roslaunch("--dump-params", "chain_tracker", *arguments).splitlines()
    pairs = (line[len(prefix):].split(": ") for line in lines if line.startswith(prefix))
    return {key: value.strip("'") for key, value in pairs}


class Config(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.config = cls.folder / "config.yaml"
        cls.config.write_text("".join(f"{key}: {value}\n" for key, value in OF_CONFIG.items()))

    def test_its_parameters_hold(self):
        for file in ("tracker", "bag", "camera", "evaluate"):
            with self.subTest(file=file):
                self.assertEqual(tracker_parameters(f"{file}.launch", f"config:={self.config}"),
                                 OF_CONFIG)

    def test_arguments_have_precedence(self):
        self.assertEqual(tracker_parameters("tracker.launch", f"config:={self.config}",
                                            "points:=5,6,7,8", "model:=/my/model.yaml", "id:=foot",
                                            "image_transport:=theora"),
                         {"points": "5,6,7,8", "default_model": "/my/model.yaml",
                          "default_id": "foot", "image_transport": "theora", "history": "3"})

    def test_paths_may_look_like_numbers(self):
        dumped = roslaunch("--dump-params", "chain_tracker", "evaluate.launch", "bag:=1.bag",
                           "ground_truth:=2", "out:=2024")
        for name, value in (("bag", "1.bag"), ("ground_truth", "2"), ("out", "2024")):
            self.assertIn(f"/evaluate_live/{name}: {os.getcwd()}/{value}\n", dumped)
        roslaunch("--dump-params", "chain_tracker", "demo.launch", "record_dir:=7")


if __name__ == "__main__":
    unittest.main()
