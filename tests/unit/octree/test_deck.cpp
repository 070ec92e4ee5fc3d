// Clouds below a deck without a gap are hidden from above, and only from above.
#include <gtest/gtest.h>

#include "welkin/octree/node_view.h"

namespace welkin {
namespace {

TEST(Deck, HidesWhatIsBelowItFromAboveAlone) {
  const RootFrame root = RootFrame::enclosing(6'360'000, 20'000);
  SelectionView view;
  view.deckTop_m = 8000, view.deckFloor_m = 7500, view.cloudTop_m = 8000;
  // Nodes of about 100 m below the camera, which looks straight down; its slack is less than its height over the deck.
  const std::uint32_t level = 17;
  const auto seen = [&](double camera_m, double node_m, double slack_m) {
    view.position_m = {0, 0, 6'360'000 + camera_m};
    view.slack_m = view.drawnSlack_m = slack_m;
    const glm::dvec3 at{10, 10, 6'360'000 + node_m};
    const glm::dvec3 steps = (at + root.half_m) * root.stepsPerMetre();
    glm::uvec3 corner{std::uint32_t(steps.x), std::uint32_t(steps.y), std::uint32_t(steps.z)};
    corner &= ~((1u << (32 - level)) - 1);
    return NodeView(root, view).look({corner, level}, {});
  };
  EXPECT_TRUE(seen(9000, 5000, 0).hidden);
  EXPECT_TRUE(seen(9000, 5000, 0).deep) << "and so are its children";
  EXPECT_FALSE(seen(9000, 7700, 0).hidden) << "in what shows of the deck";
  EXPECT_FALSE(seen(9000, 7450, 0).hidden) << "cloud leaks by a few voxels out of a node";
  EXPECT_FALSE(seen(6000, 5000, 0).hidden) << "from below its top";
  EXPECT_FALSE(seen(9000, 5000, 1500).hidden) << "the camera may be below when it is drawn";
}

}  // namespace
}  // namespace welkin
