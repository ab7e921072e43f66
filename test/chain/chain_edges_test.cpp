// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_edges.h"

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

const EdgeStencil kRight = {{2, 0, 0.0F}};
const EdgeStencil kDown = {{0, 3, 0.5F}, {1, 3, 1.0F}};

/// Right, down, right.
ChainEdges someEdges() {
  ChainEdges edges;
  edges.addKind() = kRight;
  edges.addKind() = kDown;
  for (size_t kind : {0U, 1U, 0U}) edges.addEdge(kind);
  return edges;
}

TEST(ChainEdges, haveTheStencilsOfTheirKinds) {
  const ChainEdges edges = someEdges();
  ASSERT_EQ(3U, edges.size());
  EXPECT_EQ(1U, edges[0].size());
  EXPECT_EQ(2U, edges[1].size());
  EXPECT_EQ(1U, edges[2].size());
  EXPECT_TRUE(edges.areEqual(0, 2));
  EXPECT_FALSE(edges.areEqual(0, 1));
}

TEST(ChainEdges, ofSingleStencilsKeepTheirOrder) {
  const ChainEdges edges(std::vector<EdgeStencil>{kDown, kRight});
  ASSERT_EQ(2U, edges.size());
  EXPECT_EQ(2U, edges[0].size());
  EXPECT_EQ(1U, edges[1].size());
}

TEST(ChainEdges, appendedFollowWithKindsOfTheirOwn) {
  ChainEdges edges(std::vector<EdgeStencil>{kDown});
  edges.append(someEdges());
  ASSERT_EQ(4U, edges.size());
  EXPECT_EQ(2U, edges[0].size());
  EXPECT_EQ(1U, edges[1].size());
  EXPECT_EQ(2U, edges[2].size());
  EXPECT_EQ(1U, edges[3].size());
  EXPECT_TRUE(edges.areEqual(1, 3));
  EXPECT_FALSE(edges.areEqual(0, 2));
}

TEST(ChainEdges, reversedRunTheOtherWay) {
  ChainEdges edges = someEdges();
  edges.append(ChainEdges(std::vector<EdgeStencil>{kDown}));
  ChainEdges backward(std::vector<EdgeStencil>{kDown, kDown, kDown, kDown, kDown});
  backward.assignReversed(edges);
  ASSERT_EQ(edges.size(), backward.size());
  for (size_t k = 0; k < edges.size(); ++k) {
    const EdgeStencil& there = edges[edges.size() - 1 - k];
    const EdgeStencil& back = backward[k];
    ASSERT_EQ(there.size(), back.size()) << k;
    for (size_t i = 0; i < there.size(); ++i) {
      EXPECT_EQ(-there[i].columns, back[i].columns) << k;
      EXPECT_EQ(-there[i].rows, back[i].rows) << k;
      EXPECT_EQ(there[i].cost, back[i].cost) << k;
    }
  }
}

TEST(ChainEdges, clearedHaveNoTraceOfWhatWasThere) {
  ChainEdges edges = someEdges();
  edges.clear();
  EXPECT_EQ(0U, edges.size());
  EXPECT_EQ(0U, edges.kinds());
  edges.addEdge(edges.kinds());
  EXPECT_TRUE(edges.addKind().empty());
  EXPECT_EQ(1U, edges.kinds());
}

}  // namespace
}  // namespace chain_tracker
