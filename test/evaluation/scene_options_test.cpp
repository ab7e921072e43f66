// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/evaluation/scene_options.h"

#include <functional>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "chain_tracker/evaluation/synthetic_scene.h"

namespace chain_tracker {
namespace {

struct BadOption {
  std::string name;
  std::string value;  ///< as the fault must show it
  std::function<void(SceneOptions&)> set;
};

void PrintTo(const BadOption& bad, std::ostream* out) { *out << bad.name << " = " << bad.value; }

class RefusedOption : public testing::TestWithParam<BadOption> {};

TEST_P(RefusedOption, IsNamedWithItsValue) {
  SceneOptions options;
  GetParam().set(options);
  const std::vector<std::string> faults = sceneOptionFaults(options);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].find(" " + GetParam().name + " is " + GetParam().value), std::string::npos)
      << faults[0];
  EXPECT_NE(faults[0].find("must be"), std::string::npos) << faults[0];
  EXPECT_THROW(makeScene("bottle", options), std::invalid_argument);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Options, RefusedOption,
    testing::Values(
        BadOption{"frames", "0", [](SceneOptions& o) { o.frames = 0; }},
        BadOption{"size", "[10 x 480]",
                  [](SceneOptions& o) {
                    o.size = {10, 480};
                  }},
        BadOption{"size", "[640 x 9000]",
                  [](SceneOptions& o) {
                    o.size = {640, 9000};
                  }},
        BadOption{"speed", "-1", [](SceneOptions& o) { o.speed = -1.0; }},
        BadOption{"speed", "nan", [](SceneOptions& o) { o.speed = kNan; }},
        BadOption{"rotation", "4", [](SceneOptions& o) { o.rotation = 4.0; }},
        BadOption{"scale_range", "0.9", [](SceneOptions& o) { o.scale_range = 0.9; }},
        BadOption{"shift_bursts.rate", "200",
                  [](SceneOptions& o) {
                    o.shift_bursts = {{5, 2, 200.0}};
                  }},
        BadOption{"shift_bursts.start", "-1",
                  [](SceneOptions& o) {
                    o.shift_bursts = {{-1, 2, 20.0}};
                  }},
        BadOption{"rotation_bursts.length", "0",
                  [](SceneOptions& o) {
                    o.rotation_bursts = {{5, 0, 0.2}};
                  }},
        BadOption{"rotation_bursts.rate", "-4",
                  [](SceneOptions& o) {
                    o.rotation_bursts = {{5, 1, -4.0}};
                  }},
        BadOption{"leave_for", "-2", [](SceneOptions& o) { o.leave_for = -2; }},
        BadOption{"leave_at", "3",
                  [](SceneOptions& o) {
                    o.leave_at = 3;
                    o.leave_for = 10;
                  }},
        BadOption{"leave_at", "2147483600",
                  [](SceneOptions& o) {
                    o.leave_at = 2147483600;
                    o.leave_for = 100;
                  }},
        BadOption{"blur", "1.5", [](SceneOptions& o) { o.blur = 1.5; }},
        BadOption{"noise", "-1", [](SceneOptions& o) { o.noise = -1.0; }},
        BadOption{"illumination", "1", [](SceneOptions& o) { o.illumination = 1.0; }},
        BadOption{"clutter", "-1", [](SceneOptions& o) { o.clutter = -1; }},
        BadOption{"shadow", "2", [](SceneOptions& o) { o.shadow = 2.0; }},
        BadOption{"background_speed", "nan", [](SceneOptions& o) { o.background_speed = kNan; }},
        BadOption{"occlusions", "-1", [](SceneOptions& o) { o.occlusions = -1; }},
        BadOption{"occluder_size", "0", [](SceneOptions& o) { o.occluder_size = 0.0; }},
        BadOption{"occlusion_frames", "0", [](SceneOptions& o) { o.occlusion_frames = 0; }},
        BadOption{"occlusion_frames", "90", [](SceneOptions& o) {
                    o.frames = 100;
                    o.occlusions = 1;
                    o.occlusion_frames = 90;
                  }}));

TEST(SceneOptions, DefaultsAreGood) { EXPECT_TRUE(sceneOptionFaults(SceneOptions()).empty()); }

TEST(SceneOptions, AllFaultsAreNamedAtOnce) {
  SceneOptions options;
  options.frames = -1;
  options.noise = -1.0;
  try {
    makeScene("bottle", options);
    FAIL() << "faulty options were taken";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("frames is -1"), std::string::npos) << text;
    EXPECT_NE(text.find("noise is -1"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace chain_tracker
