// SPDX-License-Identifier: BSD-3-Clause
/// Responses of the shipped ensembles, one thread: the buffered executor (Buffered) against corner
/// reads over cv::integral with the same loops (Corners), also where these are compiled with the
/// package's flags only (PortableCorners), against cv::integral and one call of
/// cv::filter2D or cv::boxFilter for every rectangle (OpenCv), and against merely writing the
/// planes (Writes). The arguments are width and height. Counters: the fastest call; of Buffered
/// also accesses per pixel, classic, of the parser's tree and of the tree that is run, and the
/// speed-up over Corners, predicted by the cost model and measured. Every way is verified before it
/// is timed.
#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include "chain_tracker/haar/buffered_executor.h"
#include "chain_tracker/haar/corner_reads.h"
#include "chain_tracker/haar/cost_model.h"
#include "chain_tracker/haar/shipped_ensembles.h"

namespace {

namespace haar = chain_tracker::haar;
using Responses = std::vector<cv::Mat1i>;

cv::Mat1b noise(const cv::Size& size) {
  cv::Mat1b image(size);
  cv::RNG(7).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

cv::Size sizeOf(const benchmark::State& state) {
  return {static_cast<int>(state.range(0)), static_cast<int>(state.range(1))};
}

void requireEqual(const Responses& expected, const Responses& actual) {
  for (size_t i = 0; i < expected.size(); ++i) {
    if (cv::norm(expected[i], actual[i], cv::NORM_INF) != 0.0) {
      throw std::logic_error("response " + std::to_string(i) + " is wrong");
    }
  }
}

/// What a user of OpenCV writes: a box filter for every rectangle, summed up. Box sums are exact in
/// single precision.
class OpenCvFilters {
 public:
  explicit OpenCvFilters(const haar::FeatureEnsemble& ensemble) : ensemble_(ensemble) {}

  void run(const cv::Mat1b& image, Responses& responses) {
    responses.resize(ensemble_.size());
    for (size_t i = 0; i < responses.size(); ++i) {
      sum_.create(image.size());
      sum_.setTo(0);
      for (const haar::WeightedRectangle& r : ensemble_.features()[i].rectangles) {
        const cv::Rect bounds(r.x, r.y, r.width, r.height);
        addBox(image, bounds, r.weight);
      }
      sum_.convertTo(responses[i], CV_32S);
    }
  }

 private:
  /// The anchor must lie inside the box: boxes beside the pixel are filtered at their corner and
  /// shifted.
  void addBox(const cv::Mat1b& image, const cv::Rect& box, int weight) {
    cv::copyMakeBorder(image, padded_, kMargin, kMargin, kMargin, kMargin, cv::BORDER_CONSTANT, 0);
    cv::boxFilter(padded_, box_, CV_32F, box.size(), {0, 0}, false, cv::BORDER_CONSTANT);
    const cv::Rect shifted(box.tl() + cv::Point(kMargin, kMargin), image.size());
    cv::scaleAdd(box_(shifted), weight, sum_, sum_);
  }

  static constexpr int kMargin = 128;
  const haar::FeatureEnsemble& ensemble_;
  cv::Mat1b padded_;
  cv::Mat1f box_;
  cv::Mat1f sum_;
};

Responses corners(const haar::FeatureEnsemble& ensemble, const cv::Mat1b& image) {
  Responses responses;
  haar::CornerReads(ensemble).run(image, responses);
  return responses;
}

using Clock = std::chrono::steady_clock;

/// Of one call, in seconds.
template <typename Work>
double secondsOf(const Work& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Times the work, and tells its fastest call too, as other programs only ever slow it down.
template <typename Work>
void timeCalls(benchmark::State& state, const Work& work) {
  double fastest = std::numeric_limits<double>::max();
  for (auto unused : state) {
    (void)unused;
    fastest = std::min(fastest, secondsOf(work));
  }
  state.counters["fastest_ms"] = 1e3 * fastest;
}

/// How much faster the second way is. They take turns, as other programs slow down whatever runs,
/// of several calls each, so that each finds in the caches what its own last call left there. The
/// fastest calls count.
template <typename First, typename Second>
double measuredSpeedUp(const First& first, const Second& second) {
  constexpr int kCalls = 10;
  double first_seconds = std::numeric_limits<double>::max();
  double second_seconds = std::numeric_limits<double>::max();
  const auto takeTurn = [&](const auto& work, double& fastest) {
    for (int i = 0; i < kCalls; ++i) fastest = std::min(fastest, secondsOf(work));
  };
  for (const auto end = Clock::now() + std::chrono::seconds(1); Clock::now() < end;) {
    takeTurn(first, first_seconds);
    takeTurn(second, second_seconds);
  }
  return first_seconds / second_seconds;
}

void buffered(benchmark::State& state, const std::string& name) {
  const cv::Mat1b image = noise(sizeOf(state));
  const haar::ConvolutionPlan plan(haar::shippedEnsemble(name));
  haar::BufferedExecutor executor(plan, image.size());
  Responses responses;
  executor.run(image, responses);
  requireEqual(corners(plan.ensemble(), image), responses);
  timeCalls(state, [&] { executor.run(image, responses); });
  haar::CornerReads classic(plan.ensemble());
  Responses classic_responses;
  classic.run(image, classic_responses);
  const double measured = measuredSpeedUp([&] { classic.run(image, classic_responses); },
                                          [&] { executor.run(image, responses); });
  state.counters["classic"] = static_cast<double>(plan.classicAccesses());
  state.counters["parsed"] = static_cast<double>(plan.parsedAccesses());
  state.counters["run"] = static_cast<double>(plan.accesses());
  state.counters["predicted"] = haar::CostModel(image.size()).speedUp(plan);
  state.counters["measured"] = measured;
}

void readCorners(benchmark::State& state, const std::string& name,
                 haar::InstructionSet instructions) {
  const cv::Mat1b image = noise(sizeOf(state));
  const haar::FeatureEnsemble ensemble = haar::shippedEnsemble(name);
  haar::CornerReads classic(ensemble, instructions);
  Responses responses;
  classic.run(image, responses);
  timeCalls(state, [&] { classic.run(image, responses); });
}

void cornerReads(benchmark::State& state, const std::string& name) {
  readCorners(state, name, haar::InstructionSet::kBest);
}

void portableCornerReads(benchmark::State& state, const std::string& name) {
  readCorners(state, name, haar::InstructionSet::kPortable);
}

void openCvFilters(benchmark::State& state, const std::string& name) {
  const cv::Mat1b image = noise(sizeOf(state));
  const haar::FeatureEnsemble ensemble = haar::shippedEnsemble(name);
  OpenCvFilters filters(ensemble);
  Responses responses;
  filters.run(image, responses);
  requireEqual(corners(ensemble, image), responses);
  timeCalls(state, [&] { filters.run(image, responses); });
}

void writes(benchmark::State& state, const std::string& name) {
  Responses responses(haar::shippedEnsemble(name).size());
  for (cv::Mat1i& response : responses) response = cv::Mat1i(sizeOf(state), 0);
  timeCalls(state, [&] {
    for (cv::Mat1i& response : responses) response.setTo(7);
  });
}

using Way = void (*)(benchmark::State&, const std::string&);

void addBenchmark(const std::string& way, Way run, const std::string& ensemble) {
  benchmark::RegisterBenchmark((way + "/" + ensemble).c_str(), run, ensemble)
      ->Args({640, 480})
      ->Args({1920, 1080})
      ->Unit(benchmark::kMillisecond);
}

const bool kRegistered = [] {
  cv::setNumThreads(1);
  for (const std::string& ensemble : haar::shippedEnsembleNames()) {
    addBenchmark("Buffered", buffered, ensemble);
    addBenchmark("Corners", cornerReads, ensemble);
    addBenchmark("PortableCorners", portableCornerReads, ensemble);
    addBenchmark("OpenCv", openCvFilters, ensemble);
    addBenchmark("Writes", writes, ensemble);
  }
  return true;
}();

}  // namespace
