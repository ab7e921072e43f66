// SPDX-License-Identifier: BSD-3-Clause
/// Following an object takes no memory: what is allocated is for what is new.
#include <atomic>
#include <cstdlib>
#include <new>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/chain/chain_model_io.h"
#include "chain_tracker/chain/chain_tracker.h"
#include "chain_tracker/evaluation/synthetic_scene.h"

namespace {

std::atomic<long> allocations{0};

}  // namespace

/// Replaces the one of the whole process; even for the pixels of a cv::Mat, OpenCV calls it once.
/// Inlined, GCC would take it and its counterpart for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace chain_tracker {
namespace {

/// There and back, so that after a while nothing of it is new.
constexpr int kPeriod = 8;
/// Until the state, too, comes back to where it was.
constexpr int kPeriods = 24;

cv::Mat shifted(const cv::Mat& image, int frame) {
  const int phase = frame % kPeriod;
  const double shift = std::min(phase, kPeriod - phase);
  const cv::Matx23d motion(1.0, 0.0, 2.0 * shift, 0.0, 1.0, shift);
  cv::Mat moved;
  cv::warpAffine(image, moved, motion, image.size(), cv::INTER_NEAREST, cv::BORDER_REPLICATE);
  return moved;
}

class Allocations : public testing::TestWithParam<std::string> {};

TEST_P(Allocations, areNoneWhereNothingIsNew) {
  const auto scene = makeScene(GetParam(), SceneOptions());
  const SceneFrame first = scene->render(0);
  ChainTracker tracker(
      loadChainModel(CHAIN_TRACKER_SOURCE_DIR "/config/models/" + scene->model() + ".yaml"),
      first.image, first.points);
  for (int frame = 1; frame < kPeriods * kPeriod; ++frame) {
    tracker.update(shifted(first.image, frame));
  }
  for (int frame = 0; frame < kPeriod; ++frame) {
    const cv::Mat image = shifted(first.image, frame);
    const long before = allocations;
    const ChainState& state = tracker.update(image);
    EXPECT_EQ(before, allocations) << "frame " << frame;
    EXPECT_EQ(TrackingStatus::kTracking, state.status);
  }
}

TEST(AllocationCount, countsTheMemoryOfMaps) {
  const long before = allocations;
  const cv::Mat1f map(3, 3);
  EXPECT_GT(allocations, before);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Allocations,
                         testing::Values("bottle", "box", "robot_arm", "finger_pair", "cable",
                                         "suture", "guitar_string", "lips"));

}  // namespace
}  // namespace chain_tracker
