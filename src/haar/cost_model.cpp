// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/cost_model.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "loop_benchmark.h"
#include "loop_timings.h"
#include "machine_name.h"
#include "plan_loops.h"

namespace chain_tracker::haar {
namespace {

/// Loops are measured in turns, so that a burst of other programs' work spoils no loop's fastest.
constexpr int kRounds = 12;
constexpr int kVector = 32;

const cv::Size& required(const cv::Size& size) {
  if (size.width < 1 || size.height < 1) throw std::invalid_argument("the image is empty");
  return size;
}

}  // namespace

std::string costModelFile() {
  const auto variable = [](const char* name) -> std::string {
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
  };
  constexpr char kFile[] = "/chain_tracker/haar_timings.yaml";
  // The standard has relative paths ignored.
  const std::string cache = variable("XDG_CACHE_HOME");
  if (!cache.empty() && cache.front() == '/') return cache + kFile;
  const std::string home = variable("HOME");
  return home.empty() ? "" : home + "/.cache" + kFile;
}

class CostModel::Implementation {
 public:
  Implementation(const cv::Size& size, const CostModelOptions& options)
      : size_(required(size)), benchmark_(size), timings_(options.file, machineName()) {
    if (options.measure_anew) timings_.clear();
  }

  double planSeconds(const ConvolutionPlan& plan) { return secondsOf(planTerms(plan)); }
  double classicSeconds(const ConvolutionPlan& plan) { return secondsOf(classicTerms(plan)); }
  size_t measuredLoops() const { return measured_loops_; }

  /// Of all that both ways take, in the same rounds.
  void measure(const ConvolutionPlan& plan) {
    std::vector<Term> terms = planTerms(plan);
    for (Term& term : classicTerms(plan)) terms.push_back(std::move(term));
    measure(terms);
  }

 private:
  /// How often a plan takes how long.
  struct Term {
    double count;
    Measurement measurement;
  };

  std::vector<Term> planTerms(const ConvolutionPlan& plan) {
    const std::vector<PlanBuffer>& buffers = plan.buffers();
    std::vector<Term> terms;
    for (const PlanBuffer& buffer : buffers) {
      if (buffer.node != 0) continue;
      terms.push_back({elementsOf(buffer.reach), benchmark_.ofIntegral(buffer.lane)});
    }
    for (const PlanLoop& loop : loopsOf(plan, InstructionSet::kBest)) {
      const bool is_response = loop.target < 0;
      const Reach reach = is_response ? Reach{} : buffers[static_cast<size_t>(loop.target)].reach;
      const Place target = is_response ? Place::kImage : Place::kLineBuffer;
      terms.push_back(
          {elementsOf(reach), benchmark_.ofLoop({loop.kind, loop.taps, Place::kLineBuffer, target,
                                                 plan.ensemble().size()})});
    }
    return terms;
  }

  std::vector<Term> classicTerms(const ConvolutionPlan& plan) {
    std::vector<Term> terms{{1.0, benchmark_.ofFullIntegral()}};
    for (const HaarFeature& feature : plan.ensemble().features()) {
      std::vector<RowTap> taps;
      const SparseKernel kernel = doubleDifference(feature);
      for (const KernelTap& tap : kernel.taps()) {
        taps.push_back({tap.dx, tap.dy, static_cast<std::int32_t>(tap.weight)});
      }
      terms.push_back({elementsOf({}), benchmark_.ofLoop({RowKind::k32To32,
                                                          {taps, {}},
                                                          Place::kImage,
                                                          Place::kImage,
                                                          plan.ensemble().size()})});
    }
    return terms;
  }

  /// Rows of buffers are whole vectors.
  double elementsOf(const Reach& reach) const {
    const int width = size_.width + reach.right - reach.left;
    const bool is_buffer = reach.right != reach.left;
    const int columns = is_buffer ? (width + kVector - 1) / kVector * kVector : width;
    return static_cast<double>(columns) * (size_.height + reach.bottom - reach.top);
  }

  double secondsOf(const std::vector<Term>& terms) {
    measure(terms);
    double seconds = 0.0;
    for (const Term& term : terms) {
      seconds += term.count * timings_.find(term.measurement.name).value();
    }
    return seconds;
  }

  /// What is not known yet.
  void measure(const std::vector<Term>& terms) {
    std::map<std::string, const Measurement*> unknown;
    for (const Term& term : terms) {
      const std::string& name = term.measurement.name;
      if (!timings_.find(name)) unknown[name] = &term.measurement;
    }
    if (unknown.empty()) return;
    std::map<std::string, double> fastest;
    for (int round = 0; round < kRounds; ++round) {
      for (const auto& [name, measurement] : unknown) {
        const double seconds = measurement->seconds();
        double& best = fastest.try_emplace(name, seconds).first->second;
        best = std::min(best, seconds);
      }
    }
    for (const auto& [name, seconds] : fastest) timings_.set(name, seconds);
    measured_loops_ += fastest.size();
    // Where it cannot be kept, the next process measures again.
    static_cast<void>(timings_.save());
  }

  cv::Size size_;
  LoopBenchmark benchmark_;
  LoopTimings timings_;
  size_t measured_loops_ = 0;
};

CostModel::CostModel(const cv::Size& size, const CostModelOptions& options)
    : implementation_(std::make_unique<Implementation>(size, options)) {}
CostModel::~CostModel() = default;
CostModel::CostModel(CostModel&&) noexcept = default;
CostModel& CostModel::operator=(CostModel&&) noexcept = default;

double CostModel::planSeconds(const ConvolutionPlan& plan) {
  return implementation_->planSeconds(plan);
}
double CostModel::classicSeconds(const ConvolutionPlan& plan) {
  return implementation_->classicSeconds(plan);
}
double CostModel::speedUp(const ConvolutionPlan& plan) {
  implementation_->measure(plan);
  return classicSeconds(plan) / planSeconds(plan);
}
size_t CostModel::measuredLoops() const { return implementation_->measuredLoops(); }

}  // namespace chain_tracker::haar
