// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "evaluation_job.h"

namespace chain_tracker {

/// Evaluates every sequence folder below `suite` in processes of its own, `parallel_jobs` at a
/// time, each into `job.out`/NAME; writes suite.json, suite.csv and suite.md, a line a sequence and
/// the means, and prints the table. A folder that cannot be started, having neither truth nor
/// init.yaml, is listed as such.
/// `program`: the evaluate program. Returns whether every sequence that can be started was done.
bool runSuite(const std::string& suite, const EvaluationJob& job, int parallel_jobs,
              const std::string& program);

}  // namespace chain_tracker
