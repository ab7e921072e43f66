// SPDX-License-Identifier: BSD-3-Clause
/// Ensembles that everybody knows, made by rule.
#pragma once

#include <string>
#include <vector>

#include "chain_tracker/haar/haar_feature.h"

namespace chain_tracker::haar {

/// The box approximations of Gaussian second derivatives of SURF (Bay, Ess, Tuytelaars, Van Gool:
/// Speeded-Up Robust Features, CVIU 2008, fig. 4), centred on the pixel of the response.
/// Octave o (1 .. 4) has the four filter sizes 9 15 21 27, 15 27 39 51, 27 51 75 99, 51 99 147 195.
/// With the lobe l = size / 3:
///   Dyy: lobes +1 -2 +1, each 2l - 1 wide and l high, below one another: the weight 1 on all three
///        and -3 on the middle one;
///   Dxx: the same, transposed;
///   Dxy: four squares of side l, one pixel apart, +1 top left and bottom right, -1 elsewhere.
/// So Dxx and Dyy have 8 corners, Dxy 16: 128 reads and 12 writes an octave in the classic way.
/// Throws std::invalid_argument for an octave that does not exist.
FeatureEnsemble surfEnsemble(int octave = 1);

/// The five shapes of Viola and Jones (Rapid object detection using a boosted cascade of simple
/// features, CVPR 2001) with square cells of 2, 3, 4, 6 and 8 px: two cells side by side (-1 +1)
/// and below one another, three cells (+1 -2 +1) side by side and below one another, four cells
/// (+1 -1 / -1 +1); the first cell begins at the pixel of the response. 25 features.
FeatureEnsemble violaJonesEnsemble();

/// One rectangle of weight 1 whose first pixel is the pixel of the response: window sums.
FeatureEnsemble boxEnsemble(const cv::Size& window);

/// Names that shippedEnsemble() knows.
std::vector<std::string> shippedEnsembleNames();

/// surf (octave 1), surf2, surf3, surf4, viola_jones; throws std::invalid_argument for other names.
FeatureEnsemble shippedEnsemble(const std::string& name);

}  // namespace chain_tracker::haar
