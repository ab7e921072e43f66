// SPDX-License-Identifier: BSD-3-Clause
/// Prints how the responses of an ensemble of Haar-like features are computed, and what that costs.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include "chain_tracker/haar/convolution_plan.h"
#include "chain_tracker/haar/cost_model.h"
#include "chain_tracker/haar/ensemble_io.h"
#include "chain_tracker/haar/shipped_ensembles.h"

namespace {

namespace haar = chain_tracker::haar;

/// A cascade, an ensemble file, or the name of a shipped ensemble.
haar::FeatureEnsemble loadAny(const std::string& name) {
  const std::string extension = std::filesystem::path(name).extension().string();
  if (extension == ".xml") {
    haar::CascadeFeatures cascade = haar::loadCascade(name);
    for (const std::string& tilted : cascade.tilted) {
      std::cerr << "left out: " << tilted << " is tilted\n";
    }
    if (!cascade.tilted.empty()) {
      std::cerr << "left out: " << cascade.tilted.size() << " tilted features\n";
    }
    return cascade.upright;
  }
  if (!extension.empty()) return haar::loadEnsemble(name);
  return haar::shippedEnsemble(name);
}

void printPrediction(const haar::ConvolutionPlan& plan, bool calibrate) {
  haar::CostModelOptions options;
  options.measure_anew = calibrate;
  haar::CostModel model(cv::Size(640, 480), options);
  const double speed_up = model.speedUp(plan);
  std::cout << "predicted for 640 x 480 on this machine: classic "
            << 1e3 * model.classicSeconds(plan) << " ms, parsed " << 1e3 * model.planSeconds(plan)
            << " ms, speed-up " << speed_up << "\n";
}

void writeDot(const haar::ConvolutionPlan& plan, const std::string& path) {
  std::ofstream file(path);
  file << plan.dot();
  if (!file) throw std::runtime_error(path + " cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Prints how the responses of an ensemble of Haar-like features are computed.");
  std::string file;
  std::string ensemble;
  std::string dot;
  haar::PlanOptions options;
  auto* input = app.add_option("file", file, "Ensemble (YAML) or OpenCV cascade (XML)");
  app.add_option("--ensemble", ensemble, "surf, surf2, surf3, surf4, viola_jones, or a file")
      ->excludes(input);
  app.add_option("--dot", dot, "Writes the trees for Graphviz");
  app.add_option("--rounds", options.search_rounds, "Disturbances of the parser's search")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()))
      ->capture_default_str();
  bool calibrate = false;
  app.add_flag("--calibrate", calibrate,
               "Measures this machine anew for the prediction, instead of reading what is kept in "
               "$XDG_CACHE_HOME/chain_tracker/haar_timings.yaml (~/.cache/...)");
  try {
    app.parse(argc, argv);
    if (file.empty() && ensemble.empty()) throw std::invalid_argument("no ensemble is given");
    const haar::ConvolutionPlan plan(loadAny(file.empty() ? ensemble : file), options);
    std::cout << plan.describe();
    printPrediction(plan, calibrate);
    if (!dot.empty()) writeDot(plan, dot);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "haar_plan: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
