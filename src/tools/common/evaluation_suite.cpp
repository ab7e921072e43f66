// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_suite.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include "chain_tracker/evaluation/ground_truth.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to programs

namespace chain_tracker {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct SuiteEntry {
  std::string name;
  json summary;       ///< null unless done
  std::string fault;  ///< why it was not done
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
    return readStart(folder, readGroundTruth(folder)).has_value();
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
  if (job.video) command.push_back("--video");
  return command;
}

/// Runs a command with its output in a file; returns its exit code.
int runCommand(const std::vector<std::string>& command, const std::string& log) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return -1;
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
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

void runEntry(const std::string& suite, const EvaluationJob& job, const std::string& program,
              SuiteEntry& entry) {
  const std::string sequence = suite + "/" + entry.name;
  if (!canStart(sequence)) {
    entry.startable = false;
    entry.fault = "no ground truth and no init.yaml";
    return;
  }
  const std::string out = job.out + "/" + entry.name;
  fs::create_directories(out);
  const std::string log = out + "/log.txt";
  const int code = runCommand(commandOf(program, sequence, job, out), log);
  if (code == 0) {
    entry.summary = json::parse(std::ifstream(out + "/summary.json"));
  } else {
    entry.fault = lastLine(log);
  }
}

std::string text(const json& value, int decimals) {
  if (value.is_null()) return "-";
  std::ostringstream stream;
  stream << std::fixed << std::setprecision(decimals) << value.get<double>();
  return stream.str();
}

/// Header and one row a sequence, in columns: sequence, model, frames, IoU of every tracker, then
/// the chain tracker's further figures.
std::vector<std::vector<std::string>> tableRows(const std::vector<SuiteEntry>& entries,
                                                const std::vector<std::string>& baselines) {
  std::vector<std::string> header = {"sequence", "model", "frames", "IoU"};
  for (const std::string& name : baselines) header.push_back(name);
  for (const char* name : {"AUC", "20 px", "points px", "PCK10", "lost", "fps"}) {
    header.emplace_back(name);
  }
  std::vector<std::vector<std::string>> rows = {header};
  for (const SuiteEntry& entry : entries) {
    if (entry.summary.is_null()) {
      rows.push_back({entry.name, entry.fault});
      continue;
    }
    const json& s = entry.summary;
    std::vector<std::string> row = {entry.name, s["model"].get<std::string>(),
                                    std::to_string(s["frames"].get<int>()), text(s["mean_iou"], 3)};
    for (const std::string& name : baselines) {
      row.push_back(text(s["baselines"][name]["mean_iou"], 3));
    }
    row.insert(row.end(), {text(s["success_auc"], 3), text(s["precision_20px"], 3),
                           text(s["part_error_px"]["mean"], 1), text(s["pck_10"], 3),
                           std::to_string(s["lost_frames"].get<int>()), text(s["fps"], 0)});
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

std::vector<std::string> meanRow(const std::vector<SuiteEntry>& entries,
                                 const std::vector<std::string>& baselines) {
  std::vector<std::string> row = {"mean", "", "", text(meanOf(entries, "", "mean_iou"), 3)};
  for (const std::string& name : baselines) {
    row.push_back(text(meanOf(entries, name, "mean_iou"), 3));
  }
  row.insert(row.end(), {text(meanOf(entries, "", "success_auc"), 3),
                         text(meanOf(entries, "", "precision_20px"), 3), "",
                         text(meanOf(entries, "", "pck_10"), 3), "", ""});
  return row;
}

std::string markdown(const std::vector<std::vector<std::string>>& rows) {
  std::string table;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<std::string> cells = rows[r];
    cells.resize(rows.front().size());
    table += "|";
    for (const std::string& cell : cells) table += " " + cell + " |";
    table += "\n";
    if (r > 0) continue;
    table += "|";
    for (std::size_t c = 0; c < cells.size(); ++c) table += "---|";
    table += "\n";
  }
  return table;
}

std::string csv(const std::vector<std::vector<std::string>>& rows) {
  std::string table;
  for (const auto& row : rows) table += joined(row) + "\n";
  return table;
}

json jsonOf(const std::vector<SuiteEntry>& entries) {
  json suite = json::array();
  for (const SuiteEntry& entry : entries) {
    suite.push_back(entry.summary.is_null() ? json{{"sequence", entry.name}, {"fault", entry.fault}}
                                            : entry.summary);
  }
  return suite;
}

void writeText(const std::string& path, const std::string& content) {
  std::ofstream file(path);
  if (!(file << content)) throw std::runtime_error(path + " cannot be written");
}

}  // namespace

bool runSuite(const std::string& suite, const EvaluationJob& job, int parallel_jobs,
              const std::string& program) {
  std::vector<SuiteEntry> entries;
  for (const std::string& name : foldersIn(suite)) entries.push_back({name, nullptr, "", true});
  fs::create_directories(job.out);
  std::atomic<std::size_t> next{0};
  std::mutex output;
  const auto work = [&] {
    for (std::size_t i = next++; i < entries.size(); i = next++) {
      runEntry(suite, job, program, entries[i]);
      const std::lock_guard<std::mutex> lock(output);
      std::cerr << entries[i].name << ": "
                << (entries[i].summary.is_null() ? entries[i].fault : "done") << "\n";
    }
  };
  std::vector<std::thread> workers;
  for (int i = 0; i < parallel_jobs; ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();

  std::vector<std::vector<std::string>> rows = tableRows(entries, job.baselines);
  rows.push_back(meanRow(entries, job.baselines));
  writeText(job.out + "/suite.md", markdown(rows));
  writeText(job.out + "/suite.csv", csv(rows));
  writeText(job.out + "/suite.json", jsonOf(entries).dump(2) + "\n");
  std::cout << markdown(rows);
  return std::all_of(entries.begin(), entries.end(), [](const SuiteEntry& entry) {
    return !entry.summary.is_null() || !entry.startable;
  });
}

}  // namespace chain_tracker
