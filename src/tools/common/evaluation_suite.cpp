// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_suite.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "chain_tracker/evaluation/ground_truth.h"
#include "child_process.h"
#include "evaluation_files.h"
#include "text_files.h"

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kBadInput = 2;  // exit code, with the reason in the last line

struct SuiteEntry {
  std::string name;
  json summary;       ///< null if nothing was written
  std::string fault;  ///< why it was not done to its end
  bool startable = true;
};

std::vector<std::string> foldersIn(const std::string& suite) {
  if (!fs::is_directory(suite)) throw std::invalid_argument(suite + " is not a folder");
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(suite)) {
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  if (names.empty()) throw std::invalid_argument(suite + " has no sequence folders");
  return names;
}

bool canStart(const std::string& folder) {
  try {
    // What has truth but no start is a fault of its own, which the run will tell.
    const GroundTruth truth = readGroundTruth(folder);
    return !truth.empty() || readStart(folder, truth).has_value();
  } catch (const std::invalid_argument&) {
    return true;  // the run itself will tell what is wrong with its files
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
}

std::vector<std::string> commandOf(const std::string& program, const std::string& sequence,
                                   const EvaluationJob& job, const std::string& out) {
  std::vector<std::string> command = {program, "--sequence", sequence, "--out", out};
  if (!job.model.empty()) command.insert(command.end(), {"--model", job.model});
  if (!job.baselines.empty()) {
    command.insert(command.end(), {"--baselines", joined(job.baselines)});
  }
  if (job.max_frames > 0) {
    command.insert(command.end(), {"--max-frames", std::to_string(job.max_frames)});
  }
  command.insert(command.end(), {"--threads", std::to_string(job.threads)});
  if (job.grey) command.emplace_back("--grey");
  if (job.video) command.emplace_back("--video");
  if (!job.report) command.emplace_back("--no-report");
  return command;
}

std::string lastLine(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::string last;
  while (std::getline(file, line)) {
    if (!line.empty()) last = line;
  }
  return last;
}

/// What the run wrote, if it came so far; null otherwise, or if the disk held only some of it.
json readSummary(const std::string& path) {
  std::ifstream file(path);
  const json summary = json::parse(file, nullptr, false);
  return summary.is_object() ? summary : json(nullptr);
}

/// Of a run that ended with this exit code. Its log may be empty: the disk may be full.
std::string faultOf(int code, const std::string& log) {
  const std::string reason = code == kBadInput ? lastLine(log) : "";
  return reason.empty() ? "ended with code " + std::to_string(code) + ", see " + log : reason;
}

void runEntry(const std::string& suite, const EvaluationJob& job,
              const std::function<bool()>& interrupted, SuiteEntry& entry) {
  const std::string sequence = suite + "/" + entry.name;
  if (!canStart(sequence)) {
    entry.startable = false;
    entry.fault = "no ground truth and no init.yaml";
    return;
  }
  const std::string out = job.out + "/" + entry.name;
  const std::string log = out + "/log.txt";
  fs::create_directories(out);
  fs::remove(out + "/summary.json");  // of an earlier run
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  const int code = runChild(commandOf(program, sequence, job, out), log, interrupted);
  entry.summary = readSummary(out + "/summary.json");
  if (code != 0) entry.fault = interrupted() ? "interrupted" : faultOf(code, log);
}

/// Of how many occlusions the object was found again after; nothing if there was none.
std::string foundAgain(int recovered, int occlusions) {
  if (occlusions == 0) return "";
  return std::to_string(recovered) + " of " + std::to_string(occlusions);
}

/// Header and one row a sequence, in columns: sequence, model, frames, IoU of every tracker, then
/// the chain tracker's further figures.
std::vector<std::vector<std::string>> tableRows(const std::vector<SuiteEntry>& entries,
                                                const std::vector<std::string>& baselines) {
  std::vector<std::string> header = {"sequence", "model", "frames", "IoU"};
  for (const std::string& name : baselines) header.push_back(name);
  for (const char* name : {"AUC", "20 px", "points px", "PCK10", "lost", "found again", "fps"}) {
    header.emplace_back(name);
  }
  std::vector<std::vector<std::string>> rows = {header};
  for (const SuiteEntry& entry : entries) {
    if (entry.summary.is_null()) {
      rows.push_back({entry.name, entry.fault});
      rows.back().resize(header.size());
      continue;
    }
    const json& s = entry.summary;
    const std::string note = entry.fault.empty() ? "" : " (" + entry.fault + ")";
    std::vector<std::string> row = {entry.name + note, s["model"].get<std::string>(),
                                    std::to_string(s["frames"].get<int>()),
                                    figure(s["mean_iou"], 3)};
    for (const std::string& name : baselines) {
      row.push_back(figure(s["baselines"][name]["mean_iou"], 3));
    }
    row.insert(row.end(),
               {figure(s["success_auc"], 3), figure(s["precision_20px"], 3),
                figure(s["part_error_px"]["mean"], 1), figure(s["pck_10"], 3),
                std::to_string(s["lost_frames"].get<int>()),
                foundAgain(s["occlusions_recovered"], s["occlusions"]), figure(s["fps"], 0)});
    rows.push_back(row);
  }
  return rows;
}

json meanOf(const std::vector<SuiteEntry>& entries, const std::string& baseline,
            const std::string& key) {
  double sum = 0.0;
  int count = 0;
  for (const SuiteEntry& entry : entries) {
    if (entry.summary.is_null()) continue;
    const json& scores = baseline.empty() ? entry.summary : entry.summary["baselines"][baseline];
    if (scores[key].is_null()) continue;
    sum += scores[key].get<double>();
    ++count;
  }
  return count > 0 ? json(sum / count) : json(nullptr);
}

int sumOf(const std::vector<SuiteEntry>& entries, const std::string& key) {
  int sum = 0;
  for (const SuiteEntry& entry : entries) {
    if (!entry.summary.is_null()) sum += entry.summary[key].get<int>();
  }
  return sum;
}

/// Of what is counted, the sum.
std::vector<std::string> meanRow(const std::vector<SuiteEntry>& entries,
                                 const std::vector<std::string>& baselines) {
  std::vector<std::string> row = {"mean", "", "", figure(meanOf(entries, "", "mean_iou"), 3)};
  for (const std::string& name : baselines) {
    row.push_back(figure(meanOf(entries, name, "mean_iou"), 3));
  }
  row.insert(
      row.end(),
      {figure(meanOf(entries, "", "success_auc"), 3),
       figure(meanOf(entries, "", "precision_20px"), 3), "",
       figure(meanOf(entries, "", "pck_10"), 3), "",
       foundAgain(sumOf(entries, "occlusions_recovered"), sumOf(entries, "occlusions")), ""});
  return row;
}

/// The text with every `special` replaced.
std::string replaced(const std::string& text, char special, const std::string& replacement) {
  std::string result;
  for (const char c : text) result += c == special ? replacement : std::string(1, c);
  return result;
}

std::string markdownRow(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) {
    row += " " + replaced(replaced(cell, '|', "\\|"), '\n', " ") + " |";
  }
  return row + "\n";
}

std::string markdown(const std::vector<std::vector<std::string>>& rows) {
  std::string table = markdownRow(rows.front()) + "|";
  for (std::size_t c = 0; c < rows.front().size(); ++c) table += "---|";
  table += "\n";
  for (std::size_t r = 1; r < rows.size(); ++r) table += markdownRow(rows[r]);
  return table;
}

/// As of RFC 4180.
std::string csvCell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  return "\"" + replaced(text, '"', "\"\"") + "\"";
}

std::string csv(const std::vector<std::vector<std::string>>& rows) {
  std::string table;
  for (const std::vector<std::string>& row : rows) {
    std::vector<std::string> cells(row.size());
    std::transform(row.begin(), row.end(), cells.begin(), csvCell);
    table += joined(cells) + "\n";
  }
  return table;
}

json jsonOf(const std::vector<SuiteEntry>& entries) {
  json suite = json::array();
  for (const SuiteEntry& entry : entries) {
    suite.push_back(entry.summary.is_null() ? json{{"sequence", entry.name}} : entry.summary);
    if (!entry.fault.empty()) suite.back()["fault"] = entry.fault;
  }
  return suite;
}

/// One line for each sequence that has ended, with the time that the others may take.
class SuiteProgress {
 public:
  explicit SuiteProgress(std::size_t total)
      : total_(total), start_(std::chrono::steady_clock::now()) {}

  void report(const SuiteEntry& entry, bool interrupted) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++done_;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const double left = elapsed.count() / double(done_) * double(total_ - done_);
    std::cerr << "[" << done_ << "/" << total_ << "] " << entry.name << ": "
              << (entry.fault.empty() ? "done" : entry.fault);
    if (done_ < total_ && !interrupted) std::cerr << ", about " << std::lround(left) << " s left";
    std::cerr << std::endl;
  }

 private:
  std::size_t total_;
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

void runEntries(const std::string& suite, const EvaluationJob& job, int parallel_jobs,
                const std::function<bool()>& interrupted, std::vector<SuiteEntry>& entries) {
  std::atomic<std::size_t> next{0};
  SuiteProgress progress(entries.size());
  const auto work = [&] {
    for (std::size_t i = next++; i < entries.size(); i = next++) {
      SuiteEntry& entry = entries[i];
      try {
        if (interrupted()) throw std::runtime_error("not begun: interrupted");
        runEntry(suite, job, interrupted, entry);
      } catch (const std::exception& error) {
        entry.fault = error.what();
      }
      progress.report(entry, interrupted());
    }
  };
  std::vector<std::thread> workers;
  workers.reserve(static_cast<std::size_t>(parallel_jobs));
  for (int i = 0; i < parallel_jobs; ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
}

}  // namespace

SuiteResult runSuite(const std::string& suite, const EvaluationJob& job, int parallel_jobs,
                     const std::function<bool()>& interrupted) {
  std::vector<SuiteEntry> entries;
  for (const std::string& name : foldersIn(suite)) entries.push_back({name, nullptr, "", true});
  fs::create_directories(job.out);
  runEntries(suite, job, parallel_jobs, interrupted, entries);

  std::vector<std::vector<std::string>> rows = tableRows(entries, job.baselines);
  rows.push_back(meanRow(entries, job.baselines));
  writeText(job.out + "/suite.md", markdown(rows));
  writeText(job.out + "/suite.csv", csv(rows));
  writeJson(job.out + "/suite.json", jsonOf(entries));
  std::cout << markdown(rows);
  const bool complete = std::all_of(entries.begin(), entries.end(), [](const SuiteEntry& entry) {
    return entry.fault.empty() || !entry.startable;
  });
  return {complete, meanOf(entries, "", "mean_iou")};
}

}  // namespace chain_tracker
