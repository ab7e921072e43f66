// SPDX-License-Identifier: BSD-3-Clause
#include "haar/loop_timings.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace chain_tracker::haar {
namespace {

constexpr char kMachine[] = "a processor: \"fast\", loops 1";

TEST(LoopTimings, comeBackExactly) {
  const TemporaryFolder folder;
  const std::string file = folder.path("cache/of/several/timings.yaml");
  LoopTimings timings(file, kMachine);
  timings.set("640x480 sum 1 to images", 1.0 / 3e10);
  timings.set("another", 0.1);
  ASSERT_TRUE(timings.save());
  const LoopTimings read(file, kMachine);
  EXPECT_EQ(read.find("640x480 sum 1 to images"), 1.0 / 3e10);
  EXPECT_EQ(read.find("another"), 0.1);
  EXPECT_FALSE(read.find("unknown"));
}

TEST(LoopTimings, leaveNoDraftBehind) {
  const TemporaryFolder folder;
  LoopTimings timings(folder.path("timings.yaml"), kMachine);
  timings.set("a", 1.0);
  ASSERT_TRUE(timings.save());
  ASSERT_TRUE(timings.save());
  EXPECT_EQ(folder.files(), 1U);
}

TEST(LoopTimings, ofAnotherMachineAreLeftOut) {
  const TemporaryFolder folder;
  const std::string file = folder.path("timings.yaml");
  LoopTimings other(file, "another processor");
  other.set("a", 1.0);
  ASSERT_TRUE(other.save());
  LoopTimings timings(file, kMachine);
  EXPECT_FALSE(timings.find("a"));
  timings.set("a", 2.0);
  ASSERT_TRUE(timings.save());
  EXPECT_EQ(LoopTimings(file, kMachine).find("a"), 2.0);
}

TEST(LoopTimings, replaceMalformedFiles) {
  const std::string machine = "machine: m\n";
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[1, 2]"), std::string("text"),
        std::string("\0\xff\x01", 3), machine, machine + "seconds: 3\n", machine + "seconds: [1]\n",
        machine + "seconds: {a: fast}\n", machine + "seconds: {a: [1]}\n",
        machine + "seconds: {a: -1}\n", machine + "seconds: {a: .nan}\n",
        machine + "seconds: {a: .inf}\n", std::string("machine: [m]\nseconds: {a: 1}\n")}) {
    const TemporaryFolder folder;
    const std::string file = folder.path("timings.yaml");
    folder.write("timings.yaml", text);
    LoopTimings timings(file, "m");
    EXPECT_FALSE(timings.find("a")) << text;
    timings.set("a", 2.0);
    EXPECT_TRUE(timings.save()) << text;
    EXPECT_EQ(LoopTimings(file, "m").find("a"), 2.0) << text;
  }
}

TEST(LoopTimings, areKeptInTheProcessWhereNoFileCanBeWritten) {
  const TemporaryFolder folder;
  folder.write("file", "no folder");
  std::filesystem::create_directories(folder.path("folder/not_empty"));
  for (const std::string& file : {std::string(), folder.path("file/timings.yaml"),
                                  folder.path("folder"), std::string("/proc/none/timings.yaml")}) {
    LoopTimings timings(file, kMachine);
    timings.set("a", 2.0);
    EXPECT_FALSE(timings.save()) << file;
    EXPECT_EQ(timings.find("a"), 2.0) << file;
  }
  EXPECT_EQ(folder.files(), 2U);
}

}  // namespace
}  // namespace chain_tracker::haar
