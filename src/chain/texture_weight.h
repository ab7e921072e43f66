// SPDX-License-Identifier: BSD-3-Clause
/// How much texture counts against colours, as the first image shows the object.
#pragma once

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/object_appearance.h"

namespace chain_tracker {

/// `model`, with four times its haar_weight for a flat, thick body that bends: if all segments are
/// deformable, with windows of at least a 25th of their length, and the textures of these, where
/// they are known, are shorter than 0.87 in the mean (of 0, flat, to 1). O(parts).
AppearanceModel withMeasuredTexture(AppearanceModel model, const ChainLayout& layout,
                                    ObjectAppearance& learned);

}  // namespace chain_tracker
