// SPDX-License-Identifier: BSD-3-Clause
#include "tools/common/free_space.h"

#include <string>

#include <gtest/gtest.h>

#include "support/refusal.h"

namespace chain_tracker {
namespace {

constexpr std::uintmax_t kTooMuch = 1'000'000'000'000'000'000;

TEST(FreeSpace, IsEnoughForASmallFile) {
  requireSpace(testing::TempDir() + "small.bag", 1000);
  requireSpace("small.bag", 1000);
}

TEST(FreeSpace, IsToldWhereItIsTooSmall) {
  for (const std::string& file : {testing::TempDir() + "large.bag", std::string("large.bag")}) {
    const std::string refusal = refusalOf([&] { requireSpace(file, kTooMuch); });
    EXPECT_EQ(omissionsOf(refusal, {file, "1000000000000 MB", " MB that its disk has left"}), "");
  }
}

TEST(FreeSpace, OfAFolderThatIsNotThereIsLeftToTheWriter) {
  requireSpace("/no/such/folder/large.bag", kTooMuch);
}

}  // namespace
}  // namespace chain_tracker
