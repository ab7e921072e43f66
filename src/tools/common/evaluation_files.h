// SPDX-License-Identifier: BSD-3-Clause
/// What `evaluate` writes into its folder.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "chain_tracker/evaluation/evaluation_run.h"

namespace chain_tracker {

/// Scores by the names of the summary; NaN becomes null.
nlohmann::json toJson(const Scores& scores);

/// Scores of the chain tracker, with `baselines` {name: the same}, faults and skipped frames.
nlohmann::json summaryOf(const EvaluationResult& result, const std::string& sequence,
                         const std::string& model);

/// objects.csv, parts.csv and points.csv of the chain tracker, scores.csv of all trackers and
/// summary.json. Throws std::runtime_error naming the file that cannot be written.
void writeResults(const EvaluationResult& result, const nlohmann::json& summary,
                  const std::string& folder);

/// A figure of a summary for people; "-" where there is none.
std::string figure(const nlohmann::json& value, int decimals);

/// The table of a summary for people, one tracker a line.
std::string tableOf(const nlohmann::json& summary);

}  // namespace chain_tracker
