// SPDX-License-Identifier: BSD-3-Clause
/// The tracker's state -> messages.
#pragma once

#include <cstdint>
#include <string>

#include <opencv2/core.hpp>

#include "chain_tracker/TrackedObject.h"
#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

/// `model` is the model's name; `image_size` [px] cuts the region of interest.
/// Of a LOST object only names, confidences and its structure are told: TrackedObject.msg.
TrackedObject toMsg(const ChainState& state, const std::string& id, const std::string& model,
                    const cv::Size& image_size);

/// Name of a state of TrackedObject, as in objects.csv.
std::string stateName(std::uint8_t state);

}  // namespace chain_tracker
