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


if __name__ == "__main__":
    unittest.main()
