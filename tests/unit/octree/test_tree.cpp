// The tree's life cycle by hand: what is told to rays, when, and what the validator catches.
#include <gtest/gtest.h>

#include "welkin/octree/tree.h"
#include "welkin/octree/validator.h"

namespace welkin {
namespace {

ChildBounds only(std::initializer_list<int> octants) {
  ChildBounds bounds;
  for (const int o : octants) bounds[o] = {0, 1};
  return bounds;
}
ResidentBounds full(float max) { return {0, max, 1000, 2000}; }

struct Fixture : testing::Test {
  Tree tree{10, 20};
  TreeChanges changes;
  void SetUp() override {
    tree.plantRoot({0, 1});
    tree.setGenerated(kRootNode, full(0.5f));
    tree.publish(kRootGroup, changes);
  }
  void TearDown() override { EXPECT_EQ(validateTree(tree), ""); }
  void finish(GroupIndex g, float max) {
    for (std::uint32_t o = 0; o < 8; ++o)
      if (tree.node(nodeOf(g, o)).pending) tree.setGenerated(nodeOf(g, o), full(max));
    tree.publish(g, changes);
  }
};

TEST_F(Fixture, AGroupIsSeenOnceItAndAllAboveAreComplete) {
  const GroupIndex a = tree.split(kRootNode, only({1, 6}));
  const GroupIndex b = tree.split(nodeOf(a, 6), only({0}));
  EXPECT_EQ(tree.brickPool().used(), 1u + 1 + 2 + 1);
  changes.clear();
  finish(b, 0.9f);
  EXPECT_TRUE(changes.dirty.empty() && changes.shown.empty());
  EXPECT_EQ(tree.words(kRootNode).group, shared::kNoGroup);
  EXPECT_EQ(tree.node(kRootNode).joined.max, 0.5f);
  finish(a, 0.25f);
  EXPECT_EQ(tree.words(kRootNode).group, a.value * 8);
  EXPECT_EQ(tree.node(kRootNode).joined.max, 0.9f);
  EXPECT_EQ(changes.shown.size(), 3u);
  EXPECT_EQ(changes.dirty, std::vector<NodeIndex>{kRootNode});
  EXPECT_EQ(tree.address(nodeOf(b, 0)), (NodeAddress{{0, 0x80000000u, 0x80000000u}, 2}));
}

TEST_F(Fixture, AMergeFreesAllBelowAndPoolsAreAsNew) {
  const GroupIndex a = tree.split(kRootNode, only({0, 1, 2, 3, 4, 5, 6, 7}));
  const GroupIndex b = tree.split(nodeOf(a, 2), only({3}));
  finish(a, 0.6f);
  finish(b, 0.8f);
  changes.clear();
  const BrickIndex brick = tree.node(nodeOf(b, 3)).brick;
  const std::uint32_t ticket = tree.ticket(brick);
  tree.merge(kRootNode, changes);
  EXPECT_EQ(tree.words(kRootNode).group, shared::kNoGroup);
  EXPECT_EQ(tree.node(kRootNode).joined.max, 0.5f);
  EXPECT_EQ(tree.brickPool().used(), 2u);
  EXPECT_TRUE(tree.groupPool().pristine());
  EXPECT_NE(tree.ticket(brick), ticket);
  EXPECT_EQ(changes.dirty, std::vector<NodeIndex>{kRootNode});
}

TEST_F(Fixture, AnEmptyBrickIsFreedAndItsNodeMayStillBeSplit) {
  const GroupIndex a = tree.split(kRootNode, only({0}));
  finish(a, 0);
  EXPECT_TRUE(tree.node(nodeOf(a, 0)).brick.isZero());
  EXPECT_EQ(shared::wordMaxCode(tree.words(nodeOf(a, 0)).word), 0u);
  EXPECT_EQ(tree.brickPool().used(), 2u);
  changes.clear();
  const GroupIndex b = tree.split(nodeOf(a, 0), only({5}));
  finish(b, 0.1f);
  EXPECT_GT(shared::wordMaxCode(tree.words(nodeOf(a, 0)).word), 0u);
  EXPECT_EQ(changes.dirty.size(), 2u);  // the split, and as the highest node that turned from empty
}

TEST_F(Fixture, SplitsThatCannotBeAreRefused) {
  tree.split(kRootNode, only({0}));
  EXPECT_THROW(tree.split(kRootNode, only({0})), std::logic_error);
  Tree small(2, 3);
  small.plantRoot({0, 1});
  EXPECT_THROW(small.split(kRootNode, only({0, 1})), std::logic_error);
  EXPECT_THROW(Tree(1, 1), std::invalid_argument);
}

TEST_F(Fixture, ThePromiseOfTheSourceIsHeld) {
  const GroupIndex a = tree.split(kRootNode, only({0}));
  finish(a, 0.6f);
  EXPECT_EQ(validateTree(tree, 1.0f), "");
  EXPECT_NE(validateTree(tree, 2.0f), "");  // stores 0.6 * 2 / m where at most 1 / m was promised
}

TEST_F(Fixture, TheValidatorFindsWhatIsWrong) {
  const GroupIndex a = tree.split(kRootNode, only({0, 1}));
  const auto broken = [&](auto change) {
    Group& g = tree.group(a);
    const Group before = g;
    change(g);
    const std::string wrong = validateTree(tree);
    g = before;
    return !wrong.empty();
  };
  EXPECT_TRUE(broken([](Group& g) { g.parent = {3}; }));
  EXPECT_TRUE(broken([](Group& g) { g.corner.x = 8; }));
  EXPECT_TRUE(broken([](Group& g) { g.level = 3; }));
  EXPECT_TRUE(broken([](Group& g) { g.pending = 1; }));
  EXPECT_TRUE(broken([](Group& g) { g.bricks = 1; }));
  EXPECT_TRUE(broken([](Group& g) { g.published = true; }));
  EXPECT_TRUE(broken([](Group& g) { g.reachable = true; }));
}

}  // namespace
}  // namespace welkin
