// SPDX-License-Identifier: BSD-3-Clause
/// Reads ensembles from files. Whatever is not understood is refused with file, line and reason.
///
/// The YAML format (config/ensembles/*.yaml):
///     name: edges                      # of the ensemble
///     features:                        # at least one
///       - name: left_right             # each name once
///         rectangles:                  # [x, y, width, height, weight], whole numbers; x and y
///           - [0, 0, 4, 8, -1]         # relative to the pixel of the response, see haar_feature.h
///           - [4, 0, 4, 8, 1]
#pragma once

#include <string>
#include <vector>

#include "chain_tracker/haar/haar_feature.h"

namespace chain_tracker::haar {

/// Throws std::invalid_argument that names the file, the line and what is wrong.
FeatureEnsemble loadEnsemble(const std::string& path);

/// The same from text; `source` stands for the file's name in errors.
FeatureEnsemble parseEnsemble(const std::string& yaml, const std::string& source);

/// The upright features of a cascade; tilted ones are not computed here.
struct CascadeFeatures {
  FeatureEnsemble upright;          ///< named feature_N, N counts all features from 0
  std::vector<std::string> tilted;  ///< names of the features left out
};

/// Features of an OpenCV cascade classifier of Haar features (XML, as opencv_traincascade writes
/// it). Throws std::invalid_argument as loadEnsemble() does, also if there is no upright feature.
CascadeFeatures loadCascade(const std::string& path);

/// The same from text.
CascadeFeatures parseCascade(const std::string& xml, const std::string& source);

}  // namespace chain_tracker::haar
