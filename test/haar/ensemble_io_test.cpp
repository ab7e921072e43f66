// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/ensemble_io.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "chain_tracker/haar/convolution_plan.h"
#include "chain_tracker/haar/shipped_ensembles.h"
#include "support/haar_inputs.h"
#include "support/refusal.h"

namespace chain_tracker::haar {
namespace {

const std::string kGoodYaml =
    "name: good\n"
    "features:\n"
    "  - name: edge\n"
    "    rectangles:\n"
    "      - [0, 0, 4, 8, -1]\n"
    "      - [4, 0, 4, 8, 1]\n";

const std::string kGoodXml =
    "<?xml version=\"1.0\"?>\n"
    "<opencv_storage>\n"
    "<cascade type_id=\"x\"><featureType>HAAR</featureType>\n"
    "<features>\n"
    "<_><rects><_>0 0 4 8 -1.</_><_>4 0 4 8 2.</_></rects></_>\n"
    "<_><rects><_>0 0 4 8 -1.</_></rects><tilted>1</tilted></_>\n"
    "</features></cascade>\n"
    "</opencv_storage>\n";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

std::string yamlRefusal(const std::string& yaml) {
  return refusalOf([&] { parseEnsemble(yaml, "e.yaml"); });
}

std::string xmlRefusal(const std::string& xml) {
  return refusalOf([&] { parseCascade(xml, "c.xml"); });
}

TEST(EnsembleIo, readsRectangles) {
  const FeatureEnsemble ensemble = parseEnsemble(kGoodYaml, "e.yaml");
  EXPECT_EQ("good", ensemble.name());
  ASSERT_EQ(1U, ensemble.size());
  const WeightedRectangle& r = ensemble.features()[0].rectangles[1];
  EXPECT_EQ(cv::Rect(4, 0, 4, 8), cv::Rect(r.x, r.y, r.width, r.height));
  EXPECT_EQ(1, r.weight);
}

TEST(EnsembleIo, refusesMalformedYamlWithLineAndReason) {
  const auto omissions = [](const std::string& what, const std::string& with,
                            const std::vector<std::string>& texts) {
    return omissionsOf(yamlRefusal(replaced(kGoodYaml, what, with)), texts);
  };
  EXPECT_EQ("", omissions("[0, 0, 4, 8, -1]", "[0, 0, 4, 8]", {"e.yaml:5", "4 numbers"}));
  EXPECT_EQ("", omissions("[0, 0, 4, 8, -1]", "[0, 0, 4, 8, x]", {"e.yaml:5", "'x'", "whole"}));
  EXPECT_EQ("", omissions("[0, 0, 4, 8, -1]", "[0, 0, 4, 8, 0.5]", {"e.yaml:5", "0.5"}));
  EXPECT_EQ("", omissions("[0, 0, 4, 8, -1]", "[0, 0, 0, 8, -1]", {"e.yaml:3", "'edge'", "area"}));
  EXPECT_EQ("", omissions("[0, 0, 4, 8, -1]", "[0, 0, 4, 9999, 1]", {"e.yaml:3", "larger"}));
  EXPECT_EQ("", omissions("[0, 0, 4, 8, -1]", "[0, -9999, 4, 8, 1]", {"e.yaml:3", "further"}));
  EXPECT_EQ("", omissions("[0, 0, 4, 8, -1]", "[0, 0, 4, 8, 99999]", {"e.yaml:3", "weight"}));
  EXPECT_EQ("", omissions("[0, 0, 4, 8, -1]", "[0, 0, 4, 8, 0]", {"e.yaml:3", "weight 0"}));
  EXPECT_EQ("", omissions("name: edge", "label: edge", {"e.yaml:3", "'label'"}));
  EXPECT_EQ("", omissions("name: good\n", "", {"e.yaml:1", "'name' is missing"}));
  EXPECT_EQ("", omissions("name: good", "name: good\nname: again", {"e.yaml:2", "twice"}));
  EXPECT_EQ("", omissions("rectangles:", "rectangles: [", {"e.yaml:", "YAML"}));
  EXPECT_EQ("", omissionsOf(yamlRefusal(""), {"e.yaml:1", "must be a map"}));
  EXPECT_EQ("", omissionsOf(yamlRefusal("name: n\nfeatures: []\n"), {"e.yaml:2", "no features"}));
  EXPECT_EQ("", omissionsOf(yamlRefusal(kGoodYaml + kGoodYaml.substr(kGoodYaml.find("  - "))),
                            {"e.yaml:7", "'edge'", "twice"}));
  EXPECT_EQ("", omissionsOf(yamlRefusal(kGoodYaml + "---\n" + kGoodYaml), {"e.yaml:7", "second"}));
  EXPECT_EQ("", omissionsOf(refusalOf([] { loadEnsemble("/no/such.yaml"); }), {"/no/such.yaml"}));
}

TEST(EnsembleIo, readsUprightFeaturesAndNamesTiltedOnes) {
  const CascadeFeatures cascade = parseCascade(kGoodXml, "c.xml");
  ASSERT_EQ(1U, cascade.upright.size());
  EXPECT_EQ(2, cascade.upright.features()[0].rectangles[1].weight);
  EXPECT_EQ(std::vector<std::string>{"feature_1"}, cascade.tilted);
}

TEST(EnsembleIo, refusesMalformedXmlWithLineAndReason) {
  const auto omissions = [](const std::string& what, const std::string& with,
                            const std::vector<std::string>& texts) {
    return omissionsOf(xmlRefusal(replaced(kGoodXml, what, with)), texts);
  };
  EXPECT_EQ("", omissions("</cascade>", "", {"c.xml:8", "cascade"}));
  EXPECT_EQ("", omissions("HAAR", "LBP", {"c.xml:3", "LBP"}));
  EXPECT_EQ("", omissions("0 0 4 8 -1.", "0 0 4 8", {"c.xml:5", "rectangle"}));
  EXPECT_EQ("", omissions("0 0 4 8 -1.", "0 0 4 8 -1.5", {"c.xml:5", "whole"}));
  EXPECT_EQ("", omissions("0 0 4 8 -1.", "0 0 4 8 nan", {"c.xml:5"}));
  EXPECT_EQ("", omissions("0 0 4 8 -1.", "0 0 -4 8 1.", {"c.xml:5", "'feature_0'", "area"}));
  EXPECT_EQ("", omissions("4 0 4 8 2.", "4 0 4 8 2. 7", {"c.xml:5", "rectangle"}));
  EXPECT_EQ("", omissions("<tilted>1", "<tilted>2", {"c.xml:6", "tilted"}));
  EXPECT_EQ("", omissions("<features>", "<parts>", {"c.xml:7", "features"}));
  EXPECT_EQ("", omissionsOf(xmlRefusal(""), {"c.xml:1", "root"}));
  EXPECT_EQ("", omissionsOf(xmlRefusal("<a"), {"c.xml:1", "does not end"}));
}

TEST(EnsembleIo, everyShippedEnsembleFileCanBePlanned) {
  const std::filesystem::path folder = std::string(CHAIN_TRACKER_SOURCE_DIR) + "/config/ensembles";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().string());
    const ConvolutionPlan plan(loadEnsemble(entry.path().string()));
    EXPECT_LT(plan.accesses(), plan.classicAccesses());
    ++files;
  }
  EXPECT_GT(files, 0);
}

/// Removes, repeats, overwrites and swaps bytes; seeded.
std::string mutated(RandomInputs& random, std::string text) {
  const std::string tempting = "<>/[]{}-0:9.,_ \n\"&#*!e";
  const int changes = random.integer(1, 6);
  for (int i = 0; i < changes && !text.empty(); ++i) {
    const auto last = static_cast<int>(text.size()) - 1;
    const auto place = static_cast<size_t>(random.integer(0, last));
    const auto length = static_cast<size_t>(random.integer(1, 12));
    switch (random.integer(0, 3)) {
      case 0:
        text.erase(place, length);
        break;
      case 1:
        text.insert(place, text.substr(place, length));
        break;
      case 2:
        text[place] =
            tempting[static_cast<size_t>(random.integer(0, static_cast<int>(tempting.size()) - 1))];
        break;
      default:
        text[place] = static_cast<char>(random.integer(0, 255));
    }
  }
  return text;
}

/// Whatever is read must be a usable ensemble; whatever is not must be refused with its place.
TEST(EnsembleIo, mutatedFilesAreReadOrRefused) {
  RandomInputs random(9);
  int refused = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::string yaml = yamlRefusal(mutated(random, kGoodYaml));
    const std::string xml = xmlRefusal(mutated(random, kGoodXml));
    EXPECT_TRUE(yaml.empty() || yaml.find("e.yaml:") == 0) << yaml;
    EXPECT_TRUE(xml.empty() || xml.find("c.xml:") == 0) << xml;
    refused += (yaml.empty() ? 0 : 1) + (xml.empty() ? 0 : 1);
  }
  EXPECT_GT(refused, 1000);
}

std::string textOf(const FeatureEnsemble& ensemble) {
  std::ostringstream text;
  for (const HaarFeature& feature : ensemble.features()) {
    text << feature.name << ":";
    for (const WeightedRectangle& r : feature.rectangles) {
      text << " " << r.x << "," << r.y << "," << r.width << "," << r.height << "," << r.weight;
    }
    text << "\n";
  }
  return text.str();
}

TEST(ShippedEnsembleFiles, areReadAndEqualTheGenerators) {
  const std::filesystem::path folder =
      std::filesystem::path(CHAIN_TRACKER_SOURCE_DIR) / "config" / "ensembles";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const FeatureEnsemble ensemble = loadEnsemble(entry.path().string());
    EXPECT_EQ(entry.path().stem().string(), ensemble.name());
    EXPECT_LT(ConvolutionPlan(ensemble).accesses(), classicAccesses(ensemble));
    ++files;
  }
  EXPECT_EQ(3, files);
  for (const std::string name : {"surf", "viola_jones"}) {
    EXPECT_EQ(textOf(shippedEnsemble(name)),
              textOf(loadEnsemble((folder / (name + ".yaml")).string())));
  }
}

}  // namespace
}  // namespace chain_tracker::haar
