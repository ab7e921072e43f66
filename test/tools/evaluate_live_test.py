# SPDX-License-Identifier: BSD-3-Clause
"""launch/evaluate.launch: the figures of the running tracker are those of the tracker in-process."""
import os
import socket
import subprocess
import time
import unittest

from programs import PROGRAMS, TOPIC, ProgramTest, points_in, run, summary_in, without_times


def free_port():
    with socket.socket() as candidate:
        candidate.bind(("", 0))
        return candidate.getsockname()[1]


def wait_for(port):
    """Until somebody listens there: rostopic, unlike nodes, does not wait for a master."""
    for _ in range(300):
        with socket.socket() as client:
            if client.connect_ex(("127.0.0.1", port)) == 0:
                return
        time.sleep(0.1)
    raise TimeoutError(f"nobody listens on port {port}")


def environment_of(port, folder):
    """Of programs that ask the ROS master at that port."""
    environment = dict(os.environ, ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1",
                       ROS_HOME=str(folder / "ros"))
    environment.pop("ROS_HOSTNAME", None)
    return environment


class Live(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.sequence = cls.render("bottle", "bottle", 40)
        cls.bag = cls.folder / "my bottle.bag"
        assert run("make_bag", "--sequence", cls.sequence, "--out", cls.bag).returncode == 0
        cls.live = cls.folder / "live"
        port = free_port()
        # Slow enough that nothing has to be dropped.
        cls.launch = subprocess.run(
            ["roslaunch", "-p", str(port), "chain_tracker", "evaluate.launch", f"bag:={cls.bag}",
             "topic:=camera/image_raw",
             f"points:={points_in(cls.sequence)}", "model:=bottle", "rate:=0.2",
             f"ground_truth:={cls.sequence}/groundtruth_parts.csv", f"out:={cls.live}"],
            env=environment_of(port, cls.folder), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            timeout=150)

    def evaluate_bag(self, name, *arguments):
        out = self.folder / name
        said = self.evaluate("--bag", self.bag, "--topic", TOPIC, "--points",
                             points_in(self.sequence), "--ground-truth",
                             self.sequence / "groundtruth_parts.csv", "--no-report", "--out", out,
                             *arguments)
        return out, said

    def assert_same_rows(self, name, one, other, tolerance):
        rows = zip(without_times(one / name), without_times(other / name))
        for mine, theirs in rows:
            for key, value in mine.items():
                try:
                    self.assertAlmostEqual(float(value), float(theirs[key]), delta=tolerance)
                except ValueError:
                    self.assertEqual(value, theirs[key])

    def test_figures_are_those_in_process(self):
        self.assertTrue((self.live / "summary.json").exists(), self.launch.stdout)
        live = summary_in(self.live)
        out, _ = self.evaluate_bag("in_process", "--model", "bottle")
        expected = summary_in(out)
        self.assertEqual(live["dropped_frames"], 0, self.launch.stdout)
        self.assertEqual((live["frames"], live["scored_frames"]), (40, 40))
        self.assertEqual(live["model"], expected["model"])
        self.assertEqual(live["lost_frames"], expected["lost_frames"])
        for key in ("mean_iou", "success_auc", "pascal_50", "precision_20px", "pck_10"):
            self.assertAlmostEqual(live[key], expected[key], delta=1e-4, msg=key)
        self.assertAlmostEqual(live["mean_center_error_px"], expected["mean_center_error_px"],
                               delta=1e-3)
        self.assertAlmostEqual(live["part_error_px"]["mean"], expected["part_error_px"]["mean"],
                               delta=1e-3)
        # Messages hold single precision, tables two decimals.
        for name in ("objects.csv", "parts.csv", "points.csv"):
            self.assert_same_rows(name, self.live, out, 0.011)
        self.assertGreater(live["latency_ms"]["p50"], 0)
        self.assertTrue((self.live / "report.html").exists(), self.launch.stdout)

    def test_the_recording_can_be_scored_again(self):
        out, _ = self.evaluate_bag("again", "--recording", self.live / "objects.bag")
        self.assertEqual(summary_in(out), summary_in(self.live))

    def test_drops_are_told_and_do_not_count(self):
        recording = self.folder / "with_drops.bag"
        # Every fourth message is missing.
        script = ("import sys, rosbag\n"
                  "out = rosbag.Bag(sys.argv[2], 'w')\n"
                  "for i, (topic, message, time) in enumerate(rosbag.Bag(sys.argv[1])):\n"
                  "    if i % 4 != 3: out.write(topic, message, time)\n"
                  "out.close()\n")
        subprocess.run(["/usr/bin/python3", "-c", script, self.live / "objects.bag", recording],
                       check=True)
        out, said = self.evaluate_bag("drops", "--recording", recording)
        self.assertIn("the recorded tracker dropped 10 frames", said)
        summary = summary_in(out)
        self.assertEqual((summary["frames"], summary["dropped_frames"]), (30, 10))
        every = {row["frame"]: row for row in without_times(self.live / "scores.csv")}
        scored = without_times(out / "scores.csv")
        self.assertEqual(scored, [every[row["frame"]] for row in scored])
        overlaps = [float(row["iou"]) for row in scored]
        self.assertAlmostEqual(summary["mean_iou"], sum(overlaps) / 30, delta=1e-4)


class Parameters(ProgramTest):
    """What is wrong is told before anything is waited for."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.bag = cls.folder / "box.bag"
        assert run("synthesize", "--scene", "box", "--frames", 2, "--width", 64, "--height", 64,
                   "--bag", cls.bag).returncode == 0
        port = free_port()
        cls.environment = environment_of(port, cls.folder)
        master = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], env=cls.environment,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.addClassCleanup(master.wait)
        cls.addClassCleanup(master.terminate)
        wait_for(port)

    def refusal_of(self, program, *parameters):
        ended = run(program, *parameters, env=self.environment, timeout=30)
        self.assertEqual(ended.returncode, 2, ended.stderr)
        return ended.stdout + ended.stderr

    def live_refusal_of(self, name, *parameters):
        """Of a node of its own: parameters outlive it."""
        return self.refusal_of("evaluate_live", f"__name:={name}", f"_bag:={self.bag}",
                               f"_topic:={TOPIC}", f"_out:={self.folder}/{name}", *parameters)

    def test_types(self):
        for key, value, allowed in (("first_timeout", "abc", "a number > 0 [s]"),
                                    ("idle_timeout", "soon", "a number > 0 [s]"),
                                    ("min_iou", "half", "a number"),
                                    ("video", "perhaps", "true or false")):
            with self.subTest(key=key):
                self.assertIn(f"~{key} is {value}, must be {allowed}",
                              self.live_refusal_of(key, f"_{key}:={value}"))
        self.assertIn("~first_timeout is abc, must be a number > 0 [s]",
                      self.refusal_of("record_results", f"_dir:={self.folder}/recorded",
                                      "_first_timeout:=abc"))

    def test_points(self):
        self.assertIn("~points is '1,2,3', must be", self.live_refusal_of("odd", "_points:=1,2,3"))

    def test_ground_truth(self):
        self.assertIn("ground truth /no/such.csv cannot be read",
                      self.live_refusal_of("no_file", "_ground_truth:=/no/such.csv"))
        self.assertIn("has no topic '/no/such'",
                      self.live_refusal_of("no_topic", "_ground_truth:=/no/such"))

    def test_images_without_stamps(self):
        bag = self.folder / "without_stamps.bag"
        script = ("import sys, rosbag\n"
                  "out = rosbag.Bag(sys.argv[2], 'w')\n"
                  "for topic, message, time in rosbag.Bag(sys.argv[1]):\n"
                  "    message.header.stamp.secs = message.header.stamp.nsecs = 0\n"
                  "    out.write(topic, message, time)\n"
                  "out.close()\n")
        subprocess.run(["/usr/bin/python3", "-c", script, self.bag, bag], check=True)
        said = self.live_refusal_of("stampless", f"_bag:={bag}")
        self.assertIn(f"{bag}: frame 0 of {TOPIC} has no stamp", said)
        self.assertIn("use `evaluate --bag`", said)

    def test_a_full_disk_is_told(self):
        folder = self.folder / "full"
        folder.mkdir()
        (folder / "parts.csv").symlink_to("/dev/full")
        self.assertIn(f"{folder}/parts.csv: cannot be written",
                      self.refusal_of("record_results", f"_dir:={folder}"))

    def test_no_message_tells_of_the_object(self):
        # In a workspace that was configured before it was built, nobody has set that path yet.
        messages = PROGRAMS.parent / "python3" / "dist-packages"
        path = os.pathsep.join(filter(None, [str(messages), os.environ.get("PYTHONPATH")]))
        publisher = subprocess.Popen(
            ["rostopic", "pub", "--latch", "/objects", "chain_tracker/TrackedObjectArray",
             "{objects: [{id: apple}, {id: zebra}]}"], env=dict(self.environment, PYTHONPATH=path),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(publisher.wait)
        self.addCleanup(publisher.terminate)
        for name, code in (("zebra", 0), ("yak", 1)):
            with self.subTest(name=name):
                ended = run("record_results", f"_dir:={self.folder}/of_{name}", f"_id:={name}",
                            "_idle_timeout:=0.5", f"__name:=record_{name}", env=self.environment,
                            timeout=60)
                said = ended.stdout + ended.stderr
                self.assertEqual(ended.returncode, code, said)
        self.assertIn("no message on /objects told of 'yak', only of 'apple', 'zebra'", said)


if __name__ == "__main__":
    unittest.main()
