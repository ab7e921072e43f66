# SPDX-License-Identifier: BSD-3-Clause
"""What the programs say of wrong options."""
import unittest

from programs import run


class Usage(unittest.TestCase):
    def assert_refused(self, sentence, program, *arguments):
        ended = run(program, *arguments)
        self.assertEqual(ended.returncode, 2, ended.stderr)
        self.assertIn(sentence, ended.stdout + ended.stderr)

    def test_numbers_out_of_range(self):
        for sentence, *command in (
                ("--max-frames: Value -1 not in range 0 to 2147483647",
                 "evaluate", "--sequence", "none", "--out", "none", "--max-frames", "-1"),
                ("--jobs: Value 0 not in range 1 to 2147483647",
                 "evaluate", "--suite", "none", "--out", "none", "--jobs", "0"),
                ("--rounds: Value -1 not in range 0 to 2147483647",
                 "haar_plan", "--ensemble", "surf", "--rounds", "-1")):
            with self.subTest(command=command):
                self.assert_refused(sentence, *command)

    def test_unknown_options(self):
        for program in ("evaluate", "synthesize", "make_bag", "haar_plan", "haar_benchmark",
                        "tracker_benchmark", "tracker_node", "record_results",
                        "evaluate_live"):
            with self.subTest(program=program):
                self.assert_refused("", program, "--nonsense")

    def test_points_are_pairs(self):
        for points in ("1,2,3", "1,2", "1,2,3,4x"):
            with self.subTest(points=points):
                self.assert_refused(f"--points is '{points}', must be at least two points",
                                    "evaluate", "--sequence", "none", "--out", "none", "--points",
                                    points)


if __name__ == "__main__":
    unittest.main()
