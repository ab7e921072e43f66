// SPDX-License-Identifier: BSD-3-Clause
/// Time of one ChainTracker::update, single thread, 640x480.
///
/// BM_Bottle: a rendered bottle that shifts, turns and rescales, followed with N parts.
/// BM_Parts: a textured board of N cells of 24 px each, so that only the number of parts grows.
/// BM_Square: a board of 150x150 px, followed with 12 parts; BM_Kcf, BM_Csrt: the same by OpenCV.
/// Each verifies that the tracker follows its object before any time is taken. p50_ms and p99_ms
/// are of single updates.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_tracker.h"
#include "chain_tracker/evaluation/evaluated_tracker.h"
#include "chain_tracker/evaluation/synthetic_scene.h"

namespace {

using chain_tracker::ChainModel;
using chain_tracker::ChainTracker;

struct Clip {
  std::vector<cv::Mat> images;
  std::vector<cv::Point2d> initial_points;
  std::vector<cv::Point2d> last_points;
};

Clip bottleClip() {
  const auto scene = chain_tracker::makeScene("bottle", chain_tracker::SceneOptions());
  Clip clip;
  for (int i = 0; i < 40; ++i) {
    const chain_tracker::SceneFrame frame = scene->render(i);
    clip.images.push_back(frame.image);
    if (i == 0) clip.initial_points = frame.points;
    clip.last_points = frame.points;
  }
  return clip;
}

/// A board of cells with colours of its own, moving on a small circle over grey noise.
Clip boardClip(const cv::Size& cells, int cell_side = 24) {
  cv::RNG rng(7);
  cv::Mat3b board(cells * cell_side);
  for (int row = 0; row < cells.height; ++row) {
    for (int column = 0; column < cells.width; ++column) {
      const cv::Rect cell(column * cell_side, row * cell_side, cell_side, cell_side);
      board(cell).setTo(cv::Scalar(rng.uniform(0, 256), rng.uniform(0, 256), rng.uniform(0, 256)));
    }
  }
  cv::Mat3b background(480, 640);
  rng.fill(background, cv::RNG::NORMAL, 128.0, 12.0);
  Clip clip;
  for (int i = 0; i < 40; ++i) {
    const cv::Point corner(200 + cvRound(12.0 * std::cos(0.3 * i)),
                           120 + cvRound(12.0 * std::sin(0.3 * i)));
    const cv::Rect area(corner, board.size());
    cv::Mat3b image = background.clone();
    board.copyTo(image(area));
    clip.images.push_back(image);
    const cv::Point2d low(area.x - 0.5, area.y - 0.5);
    const cv::Point2d high(area.br().x - 0.5, area.br().y - 0.5);
    clip.last_points = {low, {high.x, low.y}, high, {low.x, high.y}};
    if (i == 0) clip.initial_points = clip.last_points;
  }
  return clip;
}

double largestError(const ChainTracker& tracker, const std::vector<cv::Point2d>& truth) {
  double largest = 0.0;
  for (size_t i = 0; i < truth.size(); ++i) {
    largest = std::max(largest, cv::norm(tracker.state().points[i].position - truth[i]));
  }
  return largest;
}

/// Indices of the images there and back, so that every lap ends where it began.
class Laps {
 public:
  explicit Laps(std::size_t images) : last_(images - 1), next_(images - 1) {}
  std::size_t next() {
    if (next_ == last_) step_ = -1;
    if (next_ == 0) step_ = 1;
    return next_ = step_ < 0 ? next_ - 1 : next_ + 1;
  }

 private:
  std::size_t last_;
  std::size_t next_;
  int step_ = -1;
};

/// Times update(image) for every iteration, and tells the median and the 99th percentile.
template <typename Update>
void timeUpdates(benchmark::State& state, const Clip& clip, const Update& update) {
  std::vector<double> times;
  Laps laps(clip.images.size());
  for (auto _ : state) {
    const cv::Mat& image = clip.images[laps.next()];
    const auto start = std::chrono::steady_clock::now();
    update(image);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    times.push_back(time.count());
  }
  std::sort(times.begin(), times.end());
  state.counters["p50_ms"] = times[times.size() / 2];
  state.counters["p99_ms"] = times[times.size() * 99 / 100];
  state.counters["updates"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// `error`: where the tracker ends [px].
void requireFollowed(double error) {
  if (error < 5.0) return;
  throw std::runtime_error("the object is not followed: off by " + std::to_string(error) + " px");
}

void run(benchmark::State& state, const ChainModel& model, const Clip& clip) {
  cv::setNumThreads(1);
  ChainTracker tracker(model, clip.images.front(), clip.initial_points);
  for (const cv::Mat& image : clip.images) tracker.update(image);
  const double error = largestError(tracker, clip.last_points);
  requireFollowed(error);
  timeUpdates(state, clip, [&](const cv::Mat& image) { tracker.update(image); });
  const auto parts = static_cast<double>(tracker.state().parts.size());
  state.counters["parts"] = parts;
  state.counters["error_px"] = error;
  state.SetComplexityN(static_cast<benchmark::IterationCount>(parts));
}

void BM_Bottle(benchmark::State& state) {
  static const Clip clip = bottleClip();
  ChainModel model;
  model.segments.front().parts = static_cast<int>(state.range(0));
  run(state, model, clip);
}
BENCHMARK(BM_Bottle)->ArgName("parts")->Arg(10)->Arg(24)->Unit(benchmark::kMillisecond);

void BM_Parts(benchmark::State& state) {
  const cv::Size cells(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const Clip clip = boardClip(cells);
  ChainModel model;
  model.name = "box";
  model.segments.front().layout = chain_tracker::Layout::kPlanar;
  model.segments.front().parts = cells.area();
  run(state, model, clip);
}
BENCHMARK(BM_Parts)
    ->ArgNames({"columns", "rows"})
    ->Args({5, 1})
    ->Args({5, 2})
    ->Args({5, 4})
    ->Args({10, 5})
    ->Args({10, 10})
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);

Clip squareClip() { return boardClip({5, 5}, 30); }

void BM_Square(benchmark::State& state) {
  ChainModel model;
  model.name = "box";
  model.segments.front().layout = chain_tracker::Layout::kPlanar;
  model.segments.front().parts = 12;
  run(state, model, squareClip());
}
BENCHMARK(BM_Square)->Unit(benchmark::kMillisecond);

void followSquare(benchmark::State& state, const std::string& name) {
  cv::setNumThreads(1);
  const Clip clip = squareClip();
  const cv::Rect2d first(clip.initial_points[0], clip.initial_points[2]);
  const cv::Rect2d last(clip.last_points[0], clip.last_points[2]);
  const auto tracker = chain_tracker::makeBaseline(name, first);
  tracker->start(clip.images.front());
  cv::Rect2d found;
  for (const cv::Mat& image : clip.images) found = tracker->update(image).box;
  const double error = cv::norm(found.tl() - last.tl());
  requireFollowed(error);
  timeUpdates(state, clip, [&](const cv::Mat& image) { tracker->update(image); });
  state.counters["error_px"] = error;
}
void BM_Kcf(benchmark::State& state) { followSquare(state, "kcf"); }
void BM_Csrt(benchmark::State& state) { followSquare(state, "csrt"); }
BENCHMARK(BM_Kcf)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Csrt)->Unit(benchmark::kMillisecond);

}  // namespace
