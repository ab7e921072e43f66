# SPDX-License-Identifier: BSD-3-Clause
"""What the programs say of wrong options."""
import resource
import unittest

from programs import ProgramTest, run


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


class FullDisks(ProgramTest):
    def test_a_scene_without_room_is_refused(self):
        bag = self.folder / "scene.bag"
        ended = run("synthesize", "--scene", "box", "--frames", 2000000000, "--bag", bag)
        self.assertEqual(ended.returncode, 2, ended.stderr)
        self.assertIn(f"{bag} would be 1843200000 MB, must be at most", ended.stderr)
        self.assertFalse(bag.exists())

    def test_a_disk_that_fills_meanwhile_leaves_no_part(self):
        video = self.render("box", "box", 40)
        bag = self.folder / "video.bag"
        # A limit of the file's size stands for the full disk; Python ignores the signal of it.
        ended = run("make_bag", "--sequence", video, "--out", bag, restore_signals=False,
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (10**6, 10**6)))
        self.assertEqual(ended.returncode, 2, ended.stderr)
        self.assertIn(f"make_bag: {bag}: Error writing to file", ended.stderr)
        self.assertEqual(list(self.folder.glob("video.bag*")), [])


if __name__ == "__main__":
    unittest.main()
