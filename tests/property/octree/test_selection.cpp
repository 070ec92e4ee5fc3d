#include <gtest/gtest.h>

#include <map>

#include "random32.h"
#include "welkin/octree/selection.h"

namespace welkin {
namespace {

constexpr double kRadius_m = 6'371'000, kBase_m = 1000, kTop_m = 9000;
const RootFrame kRoot = RootFrame::enclosing(kRadius_m, kTop_m);

SourceBounds shell(glm::uvec3 corner, std::uint32_t level) {
  const double half = kRoot.nodeSize_m(level) / 2;
  const glm::dvec3 c = glm::abs(kRoot.toPlanet(corner) + half);
  const double nearest = glm::length(glm::max(c - half, 0.0)), farthest = glm::length(c + half);
  return farthest < kRadius_m + kBase_m || nearest > kRadius_m + kTop_m ? SourceBounds{} : SourceBounds{0, 1};
}

SelectionView viewAt(test::Random32& random) {
  std::normal_distribution<> normal;
  SelectionView v;
  const glm::dvec3 up = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  v.position_m = up * (kRadius_m + std::exp(std::uniform_real_distribution<>(std::log(2.0), std::log(2e7))(random)));
  v.forward = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)) - up);
  v.right = glm::normalize(glm::cross(v.forward, up));
  v.up = glm::cross(v.right, v.forward);
  v.cloudBase_m = kBase_m;
  v.cloudTop_m = kTop_m;
  return v;
}

// Makes the tree what the selection says, all bricks generated.
void obey(Tree& tree, const Selection& s, ResidentBounds found = {0, 1, 1000, 2000}) {
  TreeChanges changes;
  for (std::uint32_t g = 1; g < s.keep.size(); ++g) {
    if (!tree.isLive({g}) || s.keep[g]) continue;
    GroupIndex top{g};
    while (!s.keep[groupOf(tree.group(top).parent).value]) top = groupOf(tree.group(top).parent);
    tree.merge(tree.group(top).parent, changes);
  }
  std::vector<GroupIndex> made;
  for (const NewGroup& a : s.added) {
    const GroupIndex g = tree.split(a.parent.valid() ? a.parent : nodeOf(made[a.parentAdded], a.octant), a.bounds);
    made.push_back(g);
    for (std::uint32_t o = 0; o < 8; ++o)
      if (tree.node(nodeOf(g, o)).pending) tree.setGenerated(nodeOf(g, o), found);
    tree.publish(g, changes);
  }
}

using Address = std::array<std::uint32_t, 4>;
std::map<Address, float> groupsOf(const Tree& tree) {
  std::map<Address, float> all;
  for (std::uint32_t g = 1; g < tree.groupPool().highWater(); ++g) {
    if (!tree.isLive({g})) continue;
    const Group& group = tree.group(GroupIndex{g});
    all[{group.level, group.corner.x, group.corner.y, group.corner.z}] = 0;
  }
  return all;
}

class SelectionOf : public testing::TestWithParam<std::uint32_t> {
 protected:
  test::Random32 random{GetParam()};
  SelectionSettings settings{14, 500 + static_cast<std::uint32_t>(random() % 1500), 200 + static_cast<std::uint32_t>(random() % 800), 0,
                             1024};
  Tree tree{settings.groupCapacity, settings.brickCapacity};
  BoundsFunction bounds = shell;
  void SetUp() override {
    TreeChanges changes;
    tree.plantRoot(bounds({}, 0));
    tree.setGenerated(kRootNode, {0, 1, 1000, 2000});
    tree.publish(kRootGroup, changes);
  }
};
INSTANTIATE_TEST_SUITE_P(Seeds, SelectionOf, testing::Range(1u, 13u));

TEST_P(SelectionOf, IsWithinThePoolsAndBestFirst) {
  Selection s;
  for (int jump = 0; jump < 4; ++jump) {
    const SelectionView view = viewAt(random);
    for (int i = 0; i < 4; ++i) {
      select(tree, kRoot, view, settings, bounds, s);
      obey(tree, s);  // throws if the pools do not hold it
      // No visible node that is left whole may want a split more than K says.
      ASSERT_GE(s.residentDetail * 1.000001, i == 0 || !s.complete ? 0.0 : s.detail);
      for (std::size_t k = 1; k < s.added.size(); ++k) ASSERT_GE(s.added[k].key, s.added[k - 1].key);
    }
    ASSERT_TRUE(s.added.empty()) << "does not come to rest";
  }
}

TEST_P(SelectionOf, DependsOnTreeAndCameraAlone) {
  // Two trees with the same nodes at different places in their pools, and selections with different histories.
  Tree other{settings.groupCapacity, settings.brickCapacity};
  TreeChanges changes;
  other.plantRoot(bounds({}, 0));
  other.setGenerated(kRootNode, {0, 1, 1000, 2000});
  other.publish(kRootGroup, changes);
  Selection a, b, stranger;
  select(other, kRoot, viewAt(random), settings, bounds, stranger);
  obey(other, stranger);
  SelectionSettings nothing = settings;
  nothing.detailLimit = 1e-9;
  select(other, kRoot, viewAt(random), nothing, bounds, stranger);  // merges almost all again, in another order
  stranger.keep.assign(stranger.keep.size(), 0);
  stranger.keep[0] = 1;
  stranger.added.clear();
  obey(other, stranger);
  for (int i = 0; i < 3; ++i) {
    const SelectionView view = viewAt(random);
    select(tree, kRoot, view, settings, bounds, a);
    select(other, kRoot, view, settings, bounds, b);
    ASSERT_EQ(a.detail, b.detail);
    ASSERT_EQ(a.added.size(), b.added.size());
    for (std::size_t k = 0; k < a.added.size(); ++k) ASSERT_EQ(a.added[k].key, b.added[k].key);
    obey(tree, a);
    obey(other, b);
    ASSERT_EQ(groupsOf(tree), groupsOf(other));
  }
}

TEST_P(SelectionOf, ATremblingCameraChangesNothing) {
  Selection s;
  SelectionView view = viewAt(random);
  for (int i = 0; i < 6; ++i) {
    select(tree, kRoot, view, settings, bounds, s);
    obey(tree, s);
  }
  const glm::dvec3 rest = view.position_m;
  // What is on the edge is at least K * (finest child) / 8 away (penalties of 2 and 4). A step of 0.00045 of K * child on each axis is
  // under 0.63 % of that; the key changes by as much, and by ten times it where the penalty doubles over a tenth of the distance: 7 % for a
  // node, 14 % between two, and the hysteresis is 15 %.
  const double tremble_m = 0.00045 * s.detail * kRoot.nodeSize_m(settings.depth);
  for (int i = 0; i < 30; ++i) {
    std::uniform_real_distribution<> unit(-tremble_m, tremble_m);
    view.position_m = rest + glm::dvec3(unit(random), unit(random), unit(random));
    select(tree, kRoot, view, settings, bounds, s);
    ASSERT_TRUE(s.added.empty());
    for (std::uint32_t g = 1; g < s.keep.size(); ++g) ASSERT_EQ(s.keep[g] != 0, tree.isLive({g}));
  }
}

TEST_P(SelectionOf, AGroupStaysUntilItsKeyIsOverTheHysteresis) {
  const SelectionView view = viewAt(random);
  settings.detailLimit = 1.5;
  settings.brickCapacity = settings.groupCapacity = 60000;
  Tree wide{settings.groupCapacity, settings.brickCapacity};
  wide.plantRoot(bounds({}, 0));
  Selection s;
  for (int i = 0; i < 20 && (i == 0 || !s.added.empty()); ++i) {
    select(wide, kRoot, view, settings, bounds, s);
    obey(wide, s);
  }
  ASSERT_TRUE(s.complete && s.added.empty());
  const auto dropped = [&](double limit) {
    settings.detailLimit = limit;
    select(wide, kRoot, view, settings, bounds, s);
    EXPECT_TRUE(s.added.empty());
    bool any = false;
    for (std::uint32_t g = 1; g < s.keep.size(); ++g) {
      if (wide.isLive({g}) && s.keep[g]) {
        EXPECT_LT(s.key[g], limit * kHysteresis * 1.0001);  // float keys
      }
      if (wide.isLive({g}) && !s.keep[g]) any = true;
    }
    return any;
  };
  EXPECT_FALSE(dropped(1.5 / 1.14));  // all have keys under 1.5
  EXPECT_TRUE(dropped(1.5 / 2));
}

// A node whose brick came back empty is split above the level from which that speaks for all below it, and not from there on.
TEST_P(SelectionOf, DoesNotSplitWhatWasFoundEmpty) {
  SelectionView view = viewAt(random);
  view.position_m = glm::normalize(view.position_m) * (kRadius_m + 10'000);
  settings.detailLimit = 2;
  settings.brickCapacity = settings.groupCapacity = 60000;
  const auto deepest = [&](std::uint32_t emptyFrom) {
    settings.emptyFrom = emptyFrom;
    Tree thin{settings.groupCapacity, settings.brickCapacity};
    thin.plantRoot(bounds({}, 0));
    thin.setGenerated(kRootNode, {});
    Selection s;
    for (int i = 0; i < 20; ++i) {
      select(thin, kRoot, view, settings, bounds, s);
      obey(thin, s, {});
    }
    EXPECT_TRUE(s.complete && s.added.empty()) << "does not come to rest";
    std::uint32_t level = 0;
    for (std::uint32_t g = 1; g < thin.groupPool().highWater(); ++g)
      if (thin.isLive({g})) level = std::max(level, thin.group(GroupIndex{g}).level + 1u);
    return level;
  };
  EXPECT_EQ(deepest(9), 9u);
  EXPECT_GT(deepest(shared::kMaxDepth + 1), 9u);
}

// Hidden and outside are promises: no ray of the picture may reach cloud in such a node.
TEST_P(SelectionOf, NoRayReachesWhatIsCalledHiddenOrOutside) {
  for (int n = 0; n < 3000; ++n) {
    const SelectionView view = viewAt(random);
    const NodeView look(kRoot, view);
    std::uniform_real_distribution<> unit(-1, 1);
    const glm::dvec3 d =
        glm::normalize(view.forward + view.right * (unit(random) * view.tanHalfFovX) + view.up * (unit(random) * view.tanHalfFovY));
    // Where the ray meets a random altitude in the shell, before the ground.
    const double b = glm::dot(view.position_m, d), r2 = glm::dot(view.position_m, view.position_m);
    const double ground = b * b - r2 + kRadius_m * kRadius_m;
    const double hit = ground >= 0 && b < 0 ? -b - std::sqrt(ground) : 1e30;
    const double q = kRadius_m + kBase_m + (kTop_m - kBase_m) * (unit(random) * 0.5 + 0.5);
    const double shellAt = b * b - r2 + q * q;
    if (shellAt < 0) continue;
    for (const double t : {-b - std::sqrt(shellAt), -b + std::sqrt(shellAt)}) {
      if (t <= 0 || t >= hit) continue;
      const std::uint32_t level = random() % 15;
      const glm::uvec3 p = kRoot.toFixed(view.position_m + d * t);
      const NodeView::Seen seen = look.look({shared::nodeCorner(p, level), level}, {});
      ASSERT_TRUE(seen.visible()) << "level " << level << " at " << t << " m";
      // One part in 1e6 for the 3 mm steps.
      ASSERT_LE(seen.distance_m, t * 1.000001 + 0.01);
      ASSERT_GE(look.farDistance_m({shared::nodeCorner(p, level), level}) * 1.000001 + 0.01, t);
    }
  }
}

}  // namespace
}  // namespace welkin
