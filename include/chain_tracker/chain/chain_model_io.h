// SPDX-License-Identifier: BSD-3-Clause
/// Reads models from YAML. A key left out keeps the default of chain_model.h; a key that is not
/// known, has the wrong type or is out of range is refused: a typo never means the default.
#pragma once

#include <string>

#include "chain_tracker/chain/chain_model.h"

namespace chain_tracker {

/// The model in a YAML file.
/// Throws std::invalid_argument that names the file, the line, the key, its value and what is
/// allowed; all faults of range at once.
ChainModel loadChainModel(const std::string& path);

/// The same from text; `source` stands for the file's name in errors.
ChainModel parseChainModel(const std::string& yaml, const std::string& source);

}  // namespace chain_tracker
