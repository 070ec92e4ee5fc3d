#include <gtest/gtest.h>

#include <set>

#include "random32.h"
#include "welkin/octree/index.h"
#include "welkin/octree/index_pool.h"
#include "welkin/octree/tree.h"
#include "welkin/octree/validator.h"

namespace welkin {
namespace {

class Pools : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Pools, testing::Range(1u, 9u));

TEST_P(Pools, APoolHandsOutEachIndexOnceAndReturnsToPristine) {
  test::Random32 random(GetParam());
  const std::uint32_t capacity = 1 + random() % 300, first = random() % 2;
  IndexPool<BrickIndex> pool(capacity, first);
  std::set<std::uint32_t> live;
  for (int i = 0; i < 5000; ++i) {
    if (random() % 1000 < (i / 500 % 2 ? 350u : 650u)) {
      const auto got = pool.allocate();
      ASSERT_EQ(got.has_value(), live.size() + first < capacity);
      if (!got) continue;
      ASSERT_TRUE(got->value >= first && got->value < capacity);
      ASSERT_TRUE(live.insert(got->value).second);
    } else if (!live.empty()) {
      auto it = live.begin();
      std::advance(it, random() % live.size());
      pool.release({*it});
      ASSERT_FALSE(pool.isLive({*it}));
      live.erase(it);
    }
    ASSERT_EQ(pool.used(), live.size() + first);
    ASSERT_EQ(pool.available(), capacity - first - live.size());
  }
  for (const std::uint32_t index : live) pool.release({index});
  EXPECT_TRUE(pool.pristine());
}

// Random splits, results, publications and merges, the validator after each.
TEST_P(Pools, ATreeStaysSoundUnderRandomOperations) {
  test::Random32 random(GetParam() * 77);
  Tree tree(40, 120);
  TreeChanges changes;
  tree.plantRoot({0, 1});
  std::set<NodeIndex> nodes{kRootNode};
  const auto alive = [&](NodeIndex n) { return tree.isLive(groupOf(n)) && (n == kRootNode || groupOf(n) != kRootGroup); };
  for (int i = 0; i < 1500; ++i) {
    std::erase_if(nodes, [&](NodeIndex n) { return !alive(n); });
    auto it = nodes.begin();
    std::advance(it, random() % nodes.size());
    const Node& n = tree.node(*it);
    const std::uint32_t dice = random() % 20;
    if (n.pending && dice < 14) {
      const float max = random() % 3 ? static_cast<float>(random() % 1000) / 1000 : 0.0f;
      tree.setGenerated(*it, {max / 2, max, 1000, 2000});
      if (tree.group(groupOf(*it)).pending == 0) tree.publish(groupOf(*it), changes);
    } else if (n.children.valid() && dice == 0) {
      tree.merge(*it, changes);
    } else if (!n.children.valid() && !n.source.empty() && tree.address(*it).level < shared::kMaxDepth &&
               tree.groupPool().available() > 0 && tree.brickPool().available() >= 8) {
      ChildBounds bounds;
      for (auto& b : bounds) b.hi = random() % 2 ? 1.0f : 0.0f;
      const GroupIndex g = tree.split(*it, bounds);
      if (tree.group(g).pending == 0) tree.publish(g, changes);
      for (std::uint32_t o = 0; o < 8; ++o) nodes.insert(nodeOf(g, o));
    }
    ASSERT_EQ(validateTree(tree, 1), "") << "seed " << GetParam() << " operation " << i;
  }
  if (tree.node(kRootNode).children.valid()) tree.merge(kRootNode, changes);
  EXPECT_TRUE(tree.groupPool().pristine());
  EXPECT_LE(tree.brickPool().used(), 2u);
}

}  // namespace
}  // namespace welkin
