# SPDX-License-Identifier: BSD-3-Clause
"""The trackers compared with are OpenCV's: the same frames through its Python give the same boxes."""
import unittest

from programs import ProgramTest, summary_in

try:
    import cv2
except ImportError:
    cv2 = None


def overlap(a, b):
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    common = max(0, width) * max(0, height)
    return common / (a[2] * a[3] + b[2] * b[3] - common) if common else 0


def mean_overlap(tracker, sequence):
    truth = [[float(x) for x in line.split(",")]
             for line in (sequence / "groundtruth_rect.txt").read_text().splitlines()]
    pictures = [cv2.imread(str(path)) for path in sorted((sequence / "img").iterdir())]
    box = tuple(int(x) for x in truth[0])
    tracker.init(pictures[0], box)
    overlaps = [overlap(box, truth[0])]
    for picture, true_box in zip(pictures[1:], truth[1:]):
        found, box = tracker.update(picture)
        overlaps.append(overlap(box, true_box) if found else 0)
    return sum(overlaps) / len(overlaps)


class Baselines(ProgramTest):
    @unittest.skipIf(cv2 is None, "there is no cv2: install python3-opencv")
    @unittest.skipUnless(hasattr(cv2, "TrackerKCF_create") and hasattr(cv2, "TrackerCSRT_create"),
                         "cv2 was built without OpenCV's contributed trackers")
    def test_kcf_and_csrt_are_those_of_opencv(self):
        sequence = self.render("box", "box", 20)
        out = self.folder / "out"
        self.evaluate("--sequence", sequence, "--baselines", "kcf,csrt", "--no-report", "--out",
                      out)
        baselines = summary_in(out)["baselines"]
        for name, create in (("kcf", cv2.TrackerKCF_create), ("csrt", cv2.TrackerCSRT_create)):
            expected = mean_overlap(create(), sequence)
            self.assertGreater(expected, 0.2, "a tracker that never follows shows nothing")
            self.assertAlmostEqual(baselines[name]["mean_iou"], expected, delta=0.02, msg=name)


if __name__ == "__main__":
    unittest.main()
