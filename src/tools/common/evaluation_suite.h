// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "evaluation_job.h"

namespace chain_tracker {

struct SuiteResult {
  bool complete = false;    ///< every sequence that can be started was done to its end
  nlohmann::json mean_iou;  ///< of the chain tracker, over the sequences; null without truth
};

/// Evaluates every sequence folder below `suite` in processes of its own, `parallel_jobs` at a
/// time, each into `job.out`/NAME; writes suite.json, suite.csv and suite.md, a line a sequence and
/// the means, and prints the table. A folder that cannot be started, having neither truth nor
/// init.yaml, is listed as such; of one with a fault, what was written until then.
/// Once `interrupted` tells so, the sequences being evaluated end early and no further one begins.
/// Throws std::invalid_argument or std::runtime_error naming what is wrong.
SuiteResult runSuite(const std::string& suite, const EvaluationJob& job, int parallel_jobs,
                     const std::function<bool()>& interrupted);

}  // namespace chain_tracker
