// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/haar/buffered_executor.h"
#include "chain_tracker/haar/corner_reads.h"
#include "chain_tracker/haar/ensemble_io.h"
#include "chain_tracker/haar/reference_executor.h"
#include "chain_tracker/haar/shipped_ensembles.h"
#include "support/haar_inputs.h"
#include "support/random_inputs.h"
#include "support/refusal.h"

namespace chain_tracker::haar {
namespace {

using chain_tracker::firstDifference;

std::vector<cv::Mat1i> runBuffered(const ConvolutionPlan& plan, const cv::Mat1b& image,
                                   const ExecutorOptions& options = {}) {
  std::vector<cv::Mat1i> responses;
  BufferedExecutor(plan, image.size(), options).run(image, responses);
  return responses;
}

/// One option off, or another, at a time.
std::vector<ExecutorOptions> executorOptions() {
  std::vector<ExecutorOptions> all(10);
  all[1].rings = false;
  all[2].threads = 3;
  all[3].strip_columns = 32;
  all[4].streaming = Streaming::kAlways;
  all[5].threads = 2;
  all[5].strip_columns = 37;
  all[6].instructions = InstructionSet::kPortable;
  all[7].instructions = InstructionSet::kAvx2;
  all[8].instructions = InstructionSet::kAvx2;
  all[8].streaming = Streaming::kAlways;
  all[9].streaming = Streaming::kNever;
  return all;
}

std::vector<PlanOptions> planOptions() {
  std::vector<PlanOptions> all(5);
  for (PlanOptions& options : all) {
    options.search_rounds = 2;
    options.exact_work = 0;
  }
  all[1].factor = false;
  all[2].share = false;
  all[3].narrow = false;
  all[4].factor = all[4].share = all[4].narrow = false;
  return all;
}

std::string textOf(const cv::Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

/// Around the size of a kernel, and awkward ones.
std::vector<cv::Size> hostileSizes(const cv::Size& kernel) {
  return {{1, 1},
          {1, 9},
          {9, 1},
          {kernel.width - 1, kernel.height - 1},
          kernel,
          {kernel.width + 1, kernel.height + 1},
          {2, kernel.height},
          {67, 31}};
}

TEST(Executors, equalRectangleSumsForRandomEnsemblesAndEveryPlan) {
  RandomInputs random(1);
  for (int round = 0; round < 12; ++round) {
    const FeatureEnsemble ensemble = randomEnsemble(random, 1 + round % 6, 3 + round);
    const cv::Size size(random.integer(1, 70), random.integer(1, 40));
    SCOPED_TRACE("round " + std::to_string(round) + ", " + textOf(size));
    const cv::Mat1b image = random.noise(size, CV_8UC1);
    const std::vector<cv::Mat1i> expected = sumRectangles(image, ensemble);
    std::vector<cv::Mat1i> corners;
    CornerReads(ensemble).run(image, corners);
    EXPECT_EQ("", firstDifference(expected, corners));
    for (const PlanOptions& options : planOptions()) {
      const ConvolutionPlan plan(ensemble, options);
      EXPECT_EQ("", firstDifference(expected, runReference(plan, image)));
      for (const ExecutorOptions& executor : executorOptions()) {
        EXPECT_EQ("", firstDifference(expected, runBuffered(plan, image, executor)));
      }
    }
  }
}

TEST(Executors, equalRectangleSumsForShippedEnsemblesOnHostileSizes) {
  RandomInputs random(2);
  for (const std::string name : {"surf", "viola_jones"}) {
    const FeatureEnsemble ensemble = shippedEnsemble(name);
    const ConvolutionPlan plan(ensemble);
    for (const cv::Size& size : hostileSizes({27, 27})) {
      SCOPED_TRACE(name + ", " + textOf(size));
      const cv::Mat1b image = random.noise(size, CV_8UC1);
      const std::vector<cv::Mat1i> expected = sumRectangles(image, ensemble);
      EXPECT_EQ("", firstDifference(expected, runReference(plan, image)));
      for (const ExecutorOptions& executor : executorOptions()) {
        EXPECT_EQ("", firstDifference(expected, runBuffered(plan, image, executor)));
      }
    }
  }
}

TEST(Executors, equalRectangleSumsWhereverVectorsEnd) {
  RandomInputs random(12);
  for (const std::string name : {"surf", "viola_jones"}) {
    const FeatureEnsemble ensemble = shippedEnsemble(name);
    const ConvolutionPlan plan(ensemble);
    for (int width = 30; width < 100; width += width % 32 == 2 ? 28 : 1) {
      SCOPED_TRACE(name + ", " + textOf({width, 5}));
      const cv::Mat1b image = random.noise({width, 5}, CV_8UC1);
      const std::vector<cv::Mat1i> expected = sumRectangles(image, ensemble);
      for (const ExecutorOptions& executor : executorOptions()) {
        EXPECT_EQ("", firstDifference(expected, runBuffered(plan, image, executor)));
      }
    }
  }
}

TEST(Executors, equalCornerReadsForEveryShippedEnsembleOnHostileSizes) {
  RandomInputs random(9);
  for (const std::string& name : shippedEnsembleNames()) {
    const FeatureEnsemble ensemble = shippedEnsemble(name);
    PlanOptions options;
    options.search_rounds = 2;
    options.exact_work = 0;
    const ConvolutionPlan plan(ensemble, options);
    cv::Rect bounds;
    for (const HaarFeature& feature : ensemble.features()) bounds |= feature.bounds();
    for (const cv::Size& size : hostileSizes(bounds.size())) {
      SCOPED_TRACE(name + ", " + textOf(size));
      const cv::Mat1b image = random.noise(size, CV_8UC1);
      std::vector<cv::Mat1i> expected;
      CornerReads(ensemble).run(image, expected);
      EXPECT_EQ("", firstDifference(expected, runBuffered(plan, image)));
    }
  }
}

TEST(Executors, equalCornerReadsForEveryShippedEnsembleOnALargeImage) {
  RandomInputs random(3);
  const cv::Mat1b image = random.noise({533, 401}, CV_8UC1);
  for (const std::string& name : shippedEnsembleNames()) {
    SCOPED_TRACE(name);
    const FeatureEnsemble ensemble = shippedEnsemble(name);
    PlanOptions options;
    options.search_rounds = 2;
    options.exact_work = 0;
    std::vector<cv::Mat1i> expected;
    CornerReads(ensemble).run(image, expected);
    EXPECT_EQ("",
              firstDifference(expected, runBuffered(ConvolutionPlan(ensemble, options), image)));
  }
}

TEST(Executors, equalRectangleSumsForTheFrontalFaceCascade) {
  if (cascadeFolder().empty()) GTEST_SKIP() << "the package opencv-data is not installed";
  const FeatureEnsemble ensemble =
      loadCascade(cascadeFolder() + "/haarcascade_frontalface_default.xml").upright;
  RandomInputs random(4);
  const cv::Mat1b image = random.noise({41, 29}, CV_8UC1);
  const ConvolutionPlan plan(ensemble);
  const std::vector<cv::Mat1i> expected = sumRectangles(image, ensemble);
  EXPECT_EQ("", firstDifference(expected, runReference(plan, image)));
  EXPECT_EQ("", firstDifference(expected, runBuffered(plan, image)));
}

TEST(BufferedExecutor, holdsTheLargestResponses) {
  const FeatureEnsemble ensemble("large", {{"bright", {{0, 0, 11, 11, 65536}, {0, 0, 4, 4, 30000}}},
                                           {"dark", {{-5, -5, 11, 11, -65536}}}});
  const cv::Mat1b image(40, 50, uchar{255});
  const ConvolutionPlan plan(ensemble);
  EXPECT_EQ("", firstDifference(sumRectangles(image, ensemble), runBuffered(plan, image)));
}

TEST(BufferedExecutor, computesSeveralPlanesAtOnce) {
  RandomInputs random(5);
  const FeatureEnsemble box = boxEnsemble({9, 7});
  PlanOptions options;
  options.max_pixel = 1;
  const ConvolutionPlan plan(box, options);
  std::vector<cv::Mat1b> planes;
  std::vector<cv::Mat1i> expected;
  for (int i = 0; i < 5; ++i) {
    const cv::Mat noise = random.noise({61, 43}, CV_8UC1);
    planes.emplace_back(noise > 128);
    planes.back() /= 255;
    expected.push_back(sumRectangles(planes.back(), box).front());
  }
  std::vector<cv::Mat1i> responses;
  BufferedExecutor(plan, {61, 43}).run(planes, responses);
  EXPECT_EQ("", firstDifference(expected, responses));
}

/// Compares every response with the corners of its feature in the integral image, at once.
class CornerComparison : public ResponseConsumer {
 public:
  CornerComparison(const FeatureEnsemble& ensemble, const cv::Mat1b& image) {
    for (const HaarFeature& feature : ensemble.features()) {
      kernels_.push_back(doubleDifference(feature));
    }
    cv::Mat1b padded;
    cv::copyMakeBorder(image, padded, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT, 0);
    cv::integral(padded, integral_, CV_32S);
  }
  void consume(const ResponseRow& row) noexcept override {
    for (int i = 0; i < row.count; ++i) {
      int response = 0;
      for (const KernelTap& tap : kernels_[static_cast<size_t>(row.feature)].taps()) {
        response += static_cast<int>(tap.weight) * integral_(row.row - tap.dy + kBorder + 1,
                                                             row.column + i - tap.dx + kBorder + 1);
      }
      if (response != row.values[i]) ++differences_;
      ++compared_;
    }
  }
  std::int64_t differences() const { return differences_; }
  std::int64_t compared() const { return compared_; }

 private:
  static constexpr int kBorder = 32;
  std::vector<SparseKernel> kernels_;
  cv::Mat1i integral_;
  std::int64_t differences_ = 0;
  std::int64_t compared_ = 0;
};

TEST(BufferedExecutor, equalsCornersOfTheFrontalFaceCascadeOnALargeImage) {
  if (cascadeFolder().empty()) GTEST_SKIP() << "the package opencv-data is not installed";
  const FeatureEnsemble ensemble =
      loadCascade(cascadeFolder() + "/haarcascade_frontalface_default.xml").upright;
  RandomInputs random(10);
  const cv::Mat1b image = random.noise({533, 401}, CV_8UC1);
  const BytePlane plane{image.ptr(), static_cast<std::ptrdiff_t>(image.step1())};
  CornerComparison comparison(ensemble, image);
  const ConvolutionPlan plan(ensemble);
  BufferedExecutor(plan, image.size()).run(&plane, 1, comparison);
  EXPECT_EQ(static_cast<std::int64_t>(image.total() * ensemble.size()), comparison.compared());
  EXPECT_EQ(0, comparison.differences());
}

class Collector : public ResponseConsumer {
 public:
  Collector(size_t responses, const cv::Size& size) : responses_(responses) {
    for (cv::Mat1i& response : responses_) response = cv::Mat1i(size, -1);
  }
  void consume(const ResponseRow& row) noexcept override {
    cells_ += row.count;
    std::copy(row.values, row.values + row.count,
              responses_[static_cast<size_t>(row.feature)][row.row] + row.column);
  }
  const std::vector<cv::Mat1i>& responses() const { return responses_; }
  int cells() const { return cells_; }

 private:
  std::vector<cv::Mat1i> responses_;
  std::atomic<int> cells_{0};
};

TEST(BufferedExecutor, handsEveryResponseToTheConsumerOnce) {
  RandomInputs random(6);
  const FeatureEnsemble ensemble = surfEnsemble();
  const ConvolutionPlan plan(ensemble);
  const cv::Size size(90, 70);
  const cv::Mat1b image = random.noise(size, CV_8UC1);
  const BytePlane plane{image.ptr(), static_cast<std::ptrdiff_t>(image.step1())};
  for (const ExecutorOptions& options : executorOptions()) {
    Collector collector(ensemble.size(), size);
    BufferedExecutor(plan, size, options).run(&plane, 1, collector);
    EXPECT_EQ(size.area() * static_cast<int>(ensemble.size()), collector.cells());
    EXPECT_EQ("", firstDifference(sumRectangles(image, ensemble), collector.responses()));
  }
}

/// Bytes and responses inside larger arrays, whose other cells must not matter or change.
TEST(BufferedExecutor, staysInsideItsBuffers) {
  const int guard = 48;
  const int guard_value = 0x5A5A5A5A;
  RandomInputs random(7);
  const FeatureEnsemble ensemble = violaJonesEnsemble();
  const ConvolutionPlan plan(ensemble);
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(33, 20), cv::Size(64, 9)}) {
    const cv::Rect inside(cv::Point(guard, guard), size);
    const cv::Size outer(size.width + 2 * guard, size.height + 2 * guard);
    const cv::Mat1b pixels = random.noise(outer, CV_8UC1);
    const cv::Mat1b image = pixels(inside);
    for (const ExecutorOptions& options : executorOptions()) {
      std::vector<cv::Mat1i> memory;
      std::vector<cv::Mat1i> responses;
      for (size_t i = 0; i < ensemble.size(); ++i) {
        memory.emplace_back(outer, guard_value);
        responses.push_back(memory.back()(inside));
      }
      BufferedExecutor(plan, size, options).run(image, responses);
      EXPECT_EQ("", firstDifference(sumRectangles(image.clone(), ensemble), responses));
      for (cv::Mat1i& array : memory) {
        array(inside).setTo(guard_value);
        EXPECT_EQ(0, cv::norm(array, cv::Mat1i(outer, guard_value), cv::NORM_INF));
      }
    }
  }
}

TEST(BufferedExecutor, canRunAgainAndAgain) {
  RandomInputs random(8);
  const ConvolutionPlan plan(surfEnsemble());
  ExecutorOptions options;
  options.threads = 2;
  BufferedExecutor executor(plan, {80, 60}, options);
  std::vector<cv::Mat1i> responses;
  for (int round = 0; round < 3; ++round) {
    const cv::Mat1b image = random.noise({80, 60}, CV_8UC1);
    executor.run(image, responses);
    EXPECT_EQ("", firstDifference(sumRectangles(image, plan.ensemble()), responses));
  }
}

TEST(BufferedExecutor, runsOnSmallerImagesToo) {
  RandomInputs random(11);
  const ConvolutionPlan plan(surfEnsemble());
  for (const ExecutorOptions& options : executorOptions()) {
    BufferedExecutor executor(plan, {80, 60}, options);
    for (const cv::Size& size : {cv::Size(31, 60), cv::Size(1, 1), cv::Size(80, 7)}) {
      executor.setSize(size);
      const cv::Mat1b image = random.noise(size, CV_8UC1);
      std::vector<cv::Mat1i> responses;
      executor.run(image, responses);
      EXPECT_EQ("", firstDifference(sumRectangles(image, plan.ensemble()), responses));
    }
  }
}

TEST(BufferedExecutor, ringsNeedLessMemoryThanWholeImages) {
  const ConvolutionPlan plan(surfEnsemble());
  ExecutorOptions options;
  options.rings = false;
  EXPECT_LT(4 * BufferedExecutor(plan, {640, 480}).workspaceBytes(),
            BufferedExecutor(plan, {640, 480}, options).workspaceBytes());
}

TEST(BufferedExecutor, refusesWhatItCannotRun) {
  const ConvolutionPlan plan(boxEnsemble({3, 3}));
  const auto refusal = [&](const cv::Size& size, const ExecutorOptions& options) {
    return refusalOf([&] { BufferedExecutor(plan, size, options); });
  };
  EXPECT_EQ("the image is empty", refusal({0, 5}, {}));
  ExecutorOptions no_threads;
  no_threads.threads = 0;
  EXPECT_EQ("", omissionsOf(refusal({5, 5}, no_threads), {"threads", "0"}));
  ExecutorOptions narrow;
  narrow.strip_columns = 3;
  EXPECT_EQ("", omissionsOf(refusal({5, 5}, narrow), {"strip_columns", "3"}));
  std::vector<cv::Mat1i> responses;
  BufferedExecutor executor(plan, {5, 5});
  EXPECT_EQ("", omissionsOf(refusalOf([&] { executor.run(cv::Mat1b(4, 6), responses); }),
                            {"6 x 4", "5 x 5"}));
  for (const cv::Size& size : {cv::Size(0, 3), cv::Size(3, -1), cv::Size(6, 5), cv::Size(5, 6)}) {
    EXPECT_EQ("", omissionsOf(refusalOf([&] { executor.setSize(size); }),
                              {std::to_string(size.width), std::to_string(size.height), "5 x 5"}));
  }
}

}  // namespace
}  // namespace chain_tracker::haar
