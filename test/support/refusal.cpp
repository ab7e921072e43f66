// SPDX-License-Identifier: BSD-3-Clause
#include "support/refusal.h"

#include <stdexcept>

namespace chain_tracker {

std::string refusalOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string omissionsOf(const std::string& refusal, const std::vector<std::string>& texts) {
  if (refusal.empty()) return "nothing was refused";
  std::string omissions;
  for (const std::string& text : texts) {
    if (refusal.find(text) == std::string::npos) omissions += " \"" + text + "\"";
  }
  return omissions.empty() ? "" : "\"" + refusal + "\" does not mention" + omissions;
}

}  // namespace chain_tracker
