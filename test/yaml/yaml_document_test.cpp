// SPDX-License-Identifier: BSD-3-Clause
#include "yaml/yaml_document.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "support/refusal.h"

namespace chain_tracker {
namespace {

TEST(YamlDocument, MayHaveMarksAndCommentsAroundIt) {
  for (const std::string text :
       {"name: cup", "---\nname: cup\n", "name: cup\n...\n", "%YAML 1.2\n---\nname: cup\n",
        "# a cup\r\n\r\n---\r\nname: cup\r\n", "  # a cup\n---\nname: cup\n...\n# no more\n"}) {
    EXPECT_EQ(parseYamlDocument(text, "cup.yaml")["name"].as<std::string>(), "cup") << text;
  }
}

TEST(YamlDocument, IsRefusedWhereASecondOneBegins) {
  for (const std::string text :
       {"name: cup\n---\n", "name: cup\n--- # next\n", "name: cup\n...\nname: pot\n",
        "---\n---\nname: cup\n", "name: cup\n...\n---\n"}) {
    EXPECT_THROW(parseYamlDocument(text, "cup.yaml"), std::invalid_argument) << text;
  }
  EXPECT_EQ(
      omissionsOf(refusalOf([] { parseYamlDocument("name: cup\n...\n\nname: pot\n", "cup"); }),
                  {"cup:4: a second YAML document begins"}),
      "");
}

TEST(YamlDocument, MayHaveDashesInItsText) {
  EXPECT_EQ(parseYamlDocument("text: a\n  ---\n", "t").Type(), YAML::NodeType::Map);
  EXPECT_EQ(parseYamlDocument("first: 1\n---second: 2\n", "t").size(), 2U);
}

}  // namespace
}  // namespace chain_tracker
