# SPDX-License-Identifier: BSD-3-Clause
"""What `evaluate` says of bad input, and what it keeps."""
import json
import os
import shutil
import unittest

from programs import TOPIC, ProgramTest, points_in, run, summary_in


class BadInput(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.good = cls.render("good")
        cls.bag = cls.folder / "good.bag"
        ended = run("make_bag", "--sequence", cls.good, "--out", cls.bag)
        assert ended.returncode == 0, ended.stderr

    def setUp(self):
        self.out = self.folder / self.id().split(".")[-1]

    def copy(self):
        sequence = self.folder / (self.out.name + "_sequence")
        shutil.copytree(self.good, sequence)
        return sequence

    def evaluate_folder(self, sequence, *arguments, code=0):
        return self.evaluate("--sequence", sequence, "--out", self.out, "--no-report", *arguments,
                             code=code)

    def evaluate_bag(self, bag, *arguments, code=0):
        return self.evaluate("--bag", bag, "--topic", TOPIC, "--points", points_in(self.good),
                             "--model", "bottle", "--out", self.out, "--no-report", *arguments,
                             code=code)

    def test_missing_folder(self):
        said = self.evaluate_folder("/no/such/folder", code=2)
        self.assertIn("/no/such/folder does not exist", said)

    def test_no_ground_truth_and_no_start(self):
        sequence = self.copy()
        for name in ("init.yaml", "groundtruth_rect.txt", "groundtruth_parts.csv"):
            (sequence / name).unlink()
        said = self.evaluate_folder(sequence, code=2)
        self.assertIn("has neither ground truth nor an init.yaml", said)
        said = self.evaluate_folder(sequence, "--points", points_in(self.good))
        self.assertIn("has no ground truth: there are tracks, but no scores", said)
        self.assertIsNone(summary_in(self.out)["mean_iou"])
        self.assertEqual(summary_in(self.out)["frames"], 20)

    def test_a_folder_whose_name_is_no_utf8(self):
        suite = self.folder / "names"
        suite.mkdir()
        sequence = os.fsencode(suite) + b"/caf\xe9"
        shutil.copytree(os.fsencode(self.good), sequence)
        self.evaluate_folder(os.fsdecode(sequence))
        self.assertEqual(summary_in(self.out)["sequence"], "caf\ufffd")
        self.evaluate("--suite", suite, "--out", self.out, "--no-report")
        (done,) = json.loads((self.out / "suite.json").read_text())
        self.assertEqual((done["sequence"], done["frames"]), ("caf\ufffd", 20))

    def test_missing_ground_truth_file(self):
        said = self.evaluate_folder(self.good, "--ground-truth", "/no/such.txt", code=2)
        self.assertIn("/no/such.txt cannot be read", said)

    def test_shorter_ground_truth(self):
        sequence = self.copy()
        boxes = sequence / "groundtruth_rect.txt"
        boxes.write_text("".join(boxes.read_text().splitlines(True)[:12]))
        (sequence / "groundtruth_parts.csv").unlink()
        said = self.evaluate_folder(sequence)
        self.assertIn("the ground truth ends at frame 11, the frames at 19", said)
        self.assertEqual(summary_in(self.out)["scored_frames"], 12)

    def test_nan_lines(self):
        sequence = self.copy()
        boxes = sequence / "groundtruth_rect.txt"
        lines = boxes.read_text().splitlines(True)
        lines[5] = lines[6] = "NaN,NaN,NaN,NaN\n"
        boxes.write_text("".join(lines))
        self.evaluate_folder(sequence)
        self.assertEqual(summary_in(self.out)["scored_frames"], 18)

    def test_faulty_ground_truth_names_file_and_line(self):
        sequence = self.copy()
        boxes = sequence / "groundtruth_rect.txt"
        boxes.write_text("1,2,3,4\n1,2,three,4\n")
        said = self.evaluate_folder(sequence, code=2)
        self.assertIn(f"{boxes}:2: '1,2,three,4'", said)

    def test_unreadable_frame_in_the_middle(self):
        sequence = self.copy()
        picture = sequence / "img/000010.png"
        picture.write_text("no picture")
        said = self.evaluate_folder(sequence)
        self.assertIn(f"skipped a frame: {picture} cannot be read as an image", said)
        summary = summary_in(self.out)
        self.assertEqual((summary["frames"], summary["skipped_frames"]), (19, 1))

    def test_a_bag_goes_on_behind_an_unreadable_frame(self):
        sequence = self.copy()
        pictures = [sequence / "img/000010.png", sequence / "img/000011.png"]
        for picture in pictures:
            picture.write_text("no picture")
        bag = self.folder / "gap.bag"
        ended = run("make_bag", "--sequence", sequence, "--out", bag)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        for picture in pictures:
            self.assertIn(f"later frames have lower numbers in the bag: {picture} cannot be read",
                          ended.stderr)
        self.assertIn("frame 10: a gap of 0.1 s", self.evaluate_bag(bag))
        self.assertEqual(summary_in(self.out)["frames"], 18)

    def test_unreadable_first_frame(self):
        sequence = self.copy()
        picture = sequence / "img/000000.png"
        picture.write_text("no picture")
        said = self.evaluate_folder(sequence, code=2)
        self.assertIn(f"frame 0, in which the object is given: {picture}", said)

    def test_first_frame_behind_the_last(self):
        sequence = self.copy()
        init = sequence / "init.yaml"
        init.write_text(init.read_text().replace("first_frame: 0", "first_frame: 20"))
        self.assertIn("given in frame 20, counted from 0, of only 20",
                      self.evaluate_folder(sequence, code=2))

    def test_points_outside_the_image(self):
        said = self.evaluate_folder(self.good, "--points", "-5,10,1000,20", code=2)
        self.assertIn("must lie at least half inside the 320x240 image", said)

    def test_other_points_than_the_parts_of_the_truth(self):
        box = (self.good / "groundtruth_rect.txt").read_text().splitlines()[0]
        x, y, width, height = map(float, box.split(","))
        corners = f"{x},{y},{x + width},{y},{x + width},{y + height},{x},{y + height}"
        said = self.evaluate_folder(self.good, "--points", corners)
        self.assertIn("the object is given by 4 points, must be by the 2 parts", said)
        summary = summary_in(self.out)
        self.assertIsNone(summary["pck_10"])
        self.assertIsNone(summary["part_error_px"]["mean"])
        self.assertEqual(summary["scored_frames"], 20)

    def test_wrong_usage(self):
        for arguments in ([], ["--bag", self.bag], ["--sequence", self.good, "--bag", self.bag],
                          ["--sequence", self.good, "--baselines", "goturn"],
                          ["--sequence", self.good, "--points", "1,2,3"],
                          ["--sequence", self.good, "--model", "unicorn"],
                          ["--suite", self.good / "img"]):
            with self.subTest(arguments=arguments):
                self.assertTrue(self.evaluate("--out", self.out, *arguments, code=2))
        self.assertEqual(run("evaluate", "--help").returncode, 0)

    def test_truncated_bag(self):
        bag = self.folder / "truncated.bag"
        shutil.copy(self.bag, bag)
        os.truncate(bag, bag.stat().st_size // 2)
        said = self.evaluate_bag(bag, code=2)
        self.assertIn(f"`rosbag reindex {bag}` can repair it", said)

    def test_bag_without_the_topic(self):
        said = self.evaluate("--bag", self.bag, "--topic", "/nope", "--out", self.out, code=2)
        self.assertIn("has no topic '/nope'", said)
        self.assertIn(f"topics of that type: {TOPIC}", said)

    def test_missing_ground_truth_file_beside_a_bag(self):
        said = self.evaluate_bag(self.bag, "--ground-truth", "/no/such.csv", code=2)
        self.assertIn("ground truth /no/such.csv cannot be read", said)

    def test_a_bag_has_nothing_to_do_with_the_working_folder(self):
        self.out.mkdir()
        (self.out / "init.yaml").write_text("model: unicorn\n")
        ended = run("evaluate", "--bag", self.bag, "--topic", TOPIC, "--ground-truth",
                    self.good / "groundtruth_parts.csv", "--out", "out", "--no-report",
                    cwd=self.out)
        self.assertEqual(ended.returncode, 0, ended.stderr)

    def test_bag_damaged_in_the_middle(self):
        bag = self.folder / "damaged.bag"
        data = bytearray(self.bag.read_bytes())
        # The first field of an image is its header; "camera" in it ends with the frame's stamp.
        places = [i for i in range(len(data)) if data.startswith(b"camera", i)]
        middle = places[len(places) // 2]
        data[middle - 16:middle + 6] = b"\xff" * 22
        bag.write_bytes(data)
        said = self.evaluate_bag(bag)
        self.assertIn("skipped a frame: frame", said)
        summary = summary_in(self.out)
        self.assertEqual(summary["skipped_frames"], 1)
        self.assertEqual(summary["frames"], 19)

    def test_threshold(self):
        self.evaluate_folder(self.good, "--min-iou", "0.1")
        self.evaluate_folder(self.good, "--min-iou", "0.9999", code=1)


if __name__ == "__main__":
    unittest.main()
