# SPDX-License-Identifier: BSD-3-Clause
"""What `evaluate` writes: the same for the same input, complete, and kept when it is interrupted."""
import csv
import re
import shutil
import signal
import subprocess
import time
import unittest

from programs import PROGRAMS, TOPIC, ProgramTest, points_in, run, summary_in, without_times

BASELINES = "kcf,csrt,mil,medianflow,camshift"
TABLES = ("objects.csv", "parts.csv", "points.csv", "scores.csv")


class Output(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.sequence = cls.render("bottle", frames=12)

    def assert_same_tables(self, one, other):
        for name in TABLES:
            rows = without_times(one / name)
            self.assertGreater(len(rows), 0, name)
            self.assertEqual(rows, without_times(other / name), name)

    def test_two_runs_give_the_same_tables(self):
        for out in ("first", "second"):
            self.evaluate("--sequence", self.sequence, "--baselines", BASELINES, "--no-report",
                          "--out", self.folder / out)
        self.assert_same_tables(self.folder / "first", self.folder / "second")
        self.assertEqual(set(summary_in(self.folder / "first")["baselines"]),
                         set(BASELINES.split(",")))

    def test_a_bag_gives_the_tables_of_its_folder(self):
        bag = self.folder / "bottle.bag"
        self.assertEqual(run("make_bag", "--sequence", self.sequence, "--out", bag).returncode, 0)
        truth = self.sequence / "groundtruth_parts.csv"
        common = ("--ground-truth", truth, "--model", "bottle", "--points",
                  points_in(self.sequence), "--baselines", "kcf", "--no-report", "--out")
        self.evaluate("--sequence", self.sequence, *common, self.folder / "of_folder")
        self.evaluate("--bag", bag, "--topic", TOPIC, *common, self.folder / "of_bag")
        self.assert_same_tables(self.folder / "of_folder", self.folder / "of_bag")

    def test_a_rendered_bag_brings_its_truth(self):
        bag = self.folder / "rendered.bag"
        ended = run("synthesize", "--scene", "bottle", "--frames", 12, "--width", 320, "--height",
                    240, "--bag", bag)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.evaluate("--bag", bag, "--topic", TOPIC, "--ground-truth", "/ground_truth/objects",
                      "--no-report", "--out", self.folder / "of_rendered_bag")
        self.evaluate("--sequence", self.sequence, "--no-report", "--out",
                      self.folder / "of_rendered_folder")
        of_bag = summary_in(self.folder / "of_rendered_bag")
        of_folder = summary_in(self.folder / "of_rendered_folder")
        self.assertEqual(of_bag["model"], "bottle")
        self.assertEqual(of_bag["scored_frames"], 12)
        # The messages hold single precision, the files four decimals.
        self.assertAlmostEqual(of_bag["mean_iou"], of_folder["mean_iou"], delta=1e-3)
        self.assertAlmostEqual(of_bag["part_error_px"]["mean"], of_folder["part_error_px"]["mean"],
                               delta=1e-2)

    def test_one_of_several_recorded_objects_is_scored(self):
        bag = self.folder / "two.bag"
        ended = run("synthesize", "--scene", "bottle", "--frames", 4, "--width", 320, "--height",
                    240, "--bag", bag)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        recording = self.folder / "two_objects.bag"
        # The truth is the apple, the zebra beside it.
        script = ("import copy, sys, rosbag\n"
                  "out = rosbag.Bag(sys.argv[2], 'w')\n"
                  "for topic, message, time in rosbag.Bag(sys.argv[1]).read_messages(sys.argv[3]):\n"
                  "    apple = message.objects[0]\n"
                  "    apple.id = 'apple'\n"
                  "    zebra = copy.deepcopy(apple)\n"
                  "    zebra.id = 'zebra'\n"
                  "    for point in zebra.points: point.x += 30\n"
                  "    zebra.box = [zebra.box[0] + 30, *zebra.box[1:]]\n"
                  "    message.objects.append(zebra)\n"
                  "    out.write(topic, message, time)\n"
                  "out.close()\n")
        truth = "/ground_truth/objects"
        subprocess.run(["/usr/bin/python3", "-c", script, bag, recording, truth], check=True)
        common = ("--bag", bag, "--topic", TOPIC, "--recording", recording, "--recorded-topic",
                  truth, "--ground-truth", truth, "--no-report", "--out")
        told = f"{recording}: the recording has 'apple', 'zebra'; 'apple' is scored"
        out = self.folder / "of_apple"
        self.assertIn(told, self.evaluate(*common, out))
        self.assertEqual(summary_in(out)["id"], "apple")
        self.assertAlmostEqual(summary_in(out)["mean_iou"], 1.0, delta=1e-3)
        out = self.folder / "of_zebra"
        self.assertNotIn(told, self.evaluate(*common, out, "--id", "zebra"))
        self.assertEqual(summary_in(out)["id"], "zebra")
        self.assertLess(summary_in(out)["mean_iou"], 0.9)
        said = self.evaluate(*common, out, "--id", "yak", code=2)
        self.assertIn("tells of 'yak', only of 'apple', 'zebra'", said)

    def test_everything_is_written_and_the_report_needs_nothing_else(self):
        out = self.folder / "everything"
        self.evaluate("--sequence", self.sequence, "--baselines", "kcf,camshift", "--video",
                      "--out", out)
        for name in TABLES + ("summary.json", "report.html", "overlay.mp4"):
            self.assertGreater((out / name).stat().st_size, 0, name)
        report = (out / "report.html").read_text()
        sources = re.findall(r"""(?:src|href)\s*=\s*['"]?([^'">\s]{1,40})""", report)
        self.assertGreaterEqual(len(sources), 4, "curves, two plots over time, worst frames")
        for source in sources:
            self.assertTrue(source.startswith("data:image/"), source)
        self.assertFalse("http" in re.sub(r"data:[^'\"]*", "", report))
        for word in ("chain_tracker", "kcf", "camshift", "Curves", "Over time", "Worst frames"):
            self.assertTrue(word in report, word)

    def test_a_full_disk_is_told(self):
        for name in TABLES + ("summary.json",):
            out = self.folder / f"full_{name}"
            out.mkdir()
            (out / name).symlink_to("/dev/full")
            with self.subTest(name=name):
                said = self.evaluate("--sequence", self.sequence, "--no-report", "--out", out,
                                     code=2)
                self.assertIn(f"{out / name} cannot be written", said)

    def test_a_lost_object_is_nowhere(self):
        leaving = self.render("leaving", "bottle", 60, "--leave-at", "40", "--leave-for", "15")
        out = self.folder / "of_leaving"
        self.evaluate("--sequence", leaving, "--no-report", "--out", out)
        objects = without_times(out / "objects.csv")
        lost = {row["frame"] for row in objects if row["state"] == "LOST"}
        self.assertTrue(0 < len(lost) < len(objects), lost)
        for table, columns in (("objects.csv", ("x", "y", "w", "h", "theta", "scale")),
                               ("parts.csv", ("x", "y", "theta", "size")),
                               ("points.csv", ("x", "y"))):
            for row in without_times(out / table):
                for column in columns:
                    self.assertEqual(row[column] == "nan", row["frame"] in lost, (table, row))

    def test_the_summary_has_every_figure(self):
        out = self.folder / "summary"
        self.evaluate("--sequence", self.sequence, "--baselines", "kcf", "--no-report", "--out",
                      out)
        summary = summary_in(out)
        for scores in (summary, summary["baselines"]["kcf"]):
            for key in ("frames", "fps", "mean_iou", "success_auc", "pascal_50", "precision_20px",
                        "mean_center_error_px", "pck_10", "lost_frames", "reacquired", "occlusions",
                        "occlusions_recovered"):
                self.assertIn(key, scores)
            self.assertEqual(set(scores["latency_ms"]), {"p50", "p99"})
            self.assertEqual(set(scores["part_error_px"]), {"mean", "median", "p95"})
        self.assertGreater(summary["mean_iou"], 0.7)

    def test_an_interrupted_run_keeps_what_it_has(self):
        out = self.folder / "interrupted"
        sequence = self.render("long", "bottle", 100)
        with subprocess.Popen([PROGRAMS / "evaluate", "--sequence", sequence, "--baselines", "csrt",
                               "--no-report", "--out", out], stderr=subprocess.PIPE,
                              stdout=subprocess.DEVNULL, text=True) as process:
            process.stderr.readline()  # a tenth is done
            process.send_signal(signal.SIGINT)
            said = process.communicate()[1]
        self.assertEqual(process.returncode, 2)
        self.assertIn("interrupted: the results are those of the frames so far", said)
        summary = summary_in(out)
        self.assertTrue(summary["interrupted"])
        self.assertGreaterEqual(summary["frames"], 10)
        self.assertLess(summary["frames"], 100)
        self.assertEqual(len(without_times(out / "objects.csv")), summary["frames"])


class Suite(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.suite = cls.folder / "suite"
        cls.render("suite/bottle", frames=8)
        cls.render("suite/box", "box", 8)
        (cls.suite / "nothing_known").mkdir()

    def table(self, out):
        with open(out / "suite.csv", newline="") as file:
            return {row[0]: row[1:] for row in csv.reader(file)}

    def test_every_sequence_is_done_or_listed(self):
        out = self.folder / "done"
        said = self.evaluate("--suite", self.suite, "--baselines", "kcf", "--jobs", 2, "--out",
                             out, "--no-report")
        self.assertRegex(said, r"\[1/3\] .*: .*, about \d+ s left")
        self.assertRegex(said, r"\[3/3\] \w+: ")
        table = self.table(out)
        self.assertEqual(table["sequence"][:4], ["model", "frames", "IoU", "kcf"])
        self.assertEqual(table["nothing_known"][0], "no ground truth and no init.yaml")
        for name in ("bottle", "box"):
            summary = summary_in(out / name)
            self.assertEqual(table[name][2], f"{summary['mean_iou']:.3f}")
            self.assertEqual(table[name][3], f"{summary['baselines']['kcf']['mean_iou']:.3f}")
        mean = sum(float(table[name][2]) for name in ("bottle", "box")) / 2
        self.assertAlmostEqual(float(table["mean"][2]), mean, delta=2e-3)

    def test_occlusions_and_recoveries_are_counted_over_all(self):
        for scene in ("cable", "lips"):
            self.render(f"occluded/{scene}", scene, 80, "--occlusions", "1",
                        "--occlusion-frames", "15")
        self.render("occluded/bottle", frames=8)
        out = self.folder / "of_occluded"
        self.evaluate("--suite", self.folder / "occluded", "--out", out, "--no-report")
        table = self.table(out)
        column = table["sequence"].index("found again")
        for scene in ("cable", "lips"):
            self.assertEqual(table[scene][column], "1 of 1")
        self.assertEqual(table["bottle"][column], "", "nothing passed")
        self.assertEqual(table["mean"][column], "2 of 2")

    def test_a_faulty_sequence_does_not_stop_the_others(self):
        suite = self.folder / "faulty_suite"
        shutil.copytree(self.suite, suite)
        (suite / "box/groundtruth_rect.txt").write_text("1,2,3\n")
        out = self.folder / "faulty"
        said = self.evaluate("--suite", suite, "--out", out, "--no-report", code=2)
        self.assertIn("groundtruth_rect.txt:1: has 3 numbers", said)
        table = self.table(out)
        self.assertIn("groundtruth_rect.txt:1", table["box"][0])
        self.assertGreater(float(table["bottle"][2]), 0.5)

    def test_its_tables_hold_any_name_and_reason(self):
        suite = self.folder / "odd_suite"
        name = 'a, "b"|c\nd'
        shutil.copytree(self.suite / "bottle", suite / name)
        shutil.copytree(self.suite / "box", suite / "box")
        (suite / "box/groundtruth_rect.txt").write_text("1,2,3\n")
        out = self.folder / "odd"
        self.evaluate("--suite", suite, "--out", out, "--no-report", code=2)
        table = self.table(out)
        self.assertEqual({len(row) for row in table.values()}, {len(table["sequence"])})
        self.assertEqual(table[name][:2], ["bottle", "8"])
        self.assertIn("has 3 numbers, must be x,y,w,h or", table["box"][0])
        lines = (out / "suite.md").read_text().splitlines()
        self.assertEqual(len(lines), 5, lines)
        self.assertIn(r'| a, "b"\|c d | bottle | 8 |', lines[2])

    def test_a_sequence_that_does_not_say_why_it_failed_is_not_done(self):
        suite = self.folder / "silent_suite"
        shutil.copytree(self.suite, suite)
        (suite / "box/groundtruth_rect.txt").write_text("1,2,3\n")
        out = self.folder / "silent"
        (out / "box").mkdir(parents=True)
        log = out / "box/log.txt"
        log.symlink_to("/dev/null")
        said = self.evaluate("--suite", suite, "--out", out, "--no-report", code=2)
        self.assertIn(f"box: ended with code 2, see {log}", said)

    def test_a_full_disk_is_told(self):
        for name in ("suite.md", "suite.csv", "suite.json"):
            out = self.folder / f"full_{name}"
            out.mkdir()
            (out / name).symlink_to("/dev/full")
            with self.subTest(name=name):
                said = self.evaluate("--suite", self.suite, "--out", out, "--no-report", code=2)
                self.assertIn(f"{out / name} cannot be written", said)
        out = self.folder / "full_scores"
        (out / "box").mkdir(parents=True)
        scores = out / "box/scores.csv"
        scores.symlink_to("/dev/full")
        said = self.evaluate("--suite", self.suite, "--out", out, "--no-report", code=2)
        self.assertIn(f"{scores} cannot be written", said)

    def test_an_interrupted_suite_ends_as_a_whole(self):
        suite = self.folder / "long_suite"
        for name in ("a", "b", "c"):
            self.render(f"long_suite/{name}", "bottle", 60)
        out = self.folder / "interrupted"
        # Alone in its group: only the parent is told, and tells its children.
        process = subprocess.Popen([PROGRAMS / "evaluate", "--suite", suite, "--baselines", "csrt",
                                    "--jobs", "2", "--out", out, "--no-report"],
                                   stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   start_new_session=True)
        deadline = time.monotonic() + 60
        while not all((out / name / "log.txt").is_file() and
                      (out / name / "log.txt").stat().st_size > 0 for name in ("a", "b")):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 2)
        table = self.table(out)
        for name in ("a", "b"):
            self.assertIn(f"{name} (interrupted)", table)
            self.assertLess(summary_in(out / name)["frames"], 60)
        self.assertEqual(table["c"][0], "not begun: interrupted")
        self.assertFalse((out / "c").exists())


if __name__ == "__main__":
    unittest.main()
