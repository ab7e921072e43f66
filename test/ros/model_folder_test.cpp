// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/model_folder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

const std::string kFolder = std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/models";

std::string refusalOf(const ModelFolder& folder, const std::string& name) {
  try {
    folder.load(name);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ModelFolder, LoadsEveryModelByItsName) {
  const ModelFolder folder(kFolder);
  ASSERT_FALSE(folder.names().empty());
  for (const std::string& name : folder.names()) EXPECT_EQ(folder.load(name).name, name);
}

TEST(ModelFolder, LoadsAFile) {
  EXPECT_EQ(ModelFolder("/nowhere").load(kFolder + "/bottle.yaml").name, "bottle");
}

TEST(ModelFolder, AutoFollowsTheShape) {
  const ModelFolder folder(kFolder);
  EXPECT_EQ(folder.loadFor({{10, 10}, {10, 90}}, "auto").name, "bottle");
  EXPECT_EQ(folder.loadFor({{10, 10}, {50, 10}, {50, 90}, {10, 90}}, "auto").name, "box");
  EXPECT_EQ(folder.loadFor({{10, 10}, {10, 90}}, "cable").name, "cable");
}

TEST(ModelFolder, AutoTakesFromThePackageWhatTheFolderLacks) {
  setenv("ROS_PACKAGE_PATH", CHAIN_TRACKER_SOURCE_DIR, 1);
  const std::filesystem::path own = std::filesystem::path(testing::TempDir()) / "own_models";
  std::filesystem::create_directories(own);
  std::ofstream(own / "box.yaml") << "name: my_box\nsegments: [{layout: planar}]\n";
  const ModelFolder folder(own.string());
  EXPECT_EQ(folder.loadFor({{10, 10}, {10, 90}}, "auto").name, "bottle");
  EXPECT_EQ(folder.loadFor({{10, 10}, {50, 10}, {50, 90}, {10, 90}}, "auto").name, "my_box");
  EXPECT_THROW(folder.loadFor({{10, 10}, {10, 90}}, "bottle"), std::invalid_argument);
  std::filesystem::remove_all(own);
}

TEST(ModelFolder, RefusesAnUnknownNameNamingThoseThereAre) {
  const std::string refusal = refusalOf(ModelFolder(kFolder), "teapot");
  EXPECT_NE(refusal.find("'teapot' is unknown"), std::string::npos);
  EXPECT_NE(refusal.find("bottle"), std::string::npos);
  EXPECT_NE(refusal.find(kFolder), std::string::npos);
  EXPECT_NE(refusalOf(ModelFolder(kFolder), "../models/bottle"), "");
  EXPECT_NE(refusalOf(ModelFolder(kFolder), ""), "");
}

TEST(ModelFolder, OfNoFolderHasNoNames) {
  EXPECT_TRUE(ModelFolder("/nowhere").names().empty());
  EXPECT_NE(refusalOf(ModelFolder("/nowhere"), "bottle").find("/nowhere: none"), std::string::npos);
  EXPECT_NE(refusalOf(ModelFolder(""), "bottle").find("~models_folder"), std::string::npos);
}

TEST(ModelFolder, RefusesAFileThatIsNotThere) {
  EXPECT_NE(refusalOf(ModelFolder(kFolder), "/nowhere/x.yaml").find("/nowhere/x.yaml"),
            std::string::npos);
}

}  // namespace
}  // namespace chain_tracker
