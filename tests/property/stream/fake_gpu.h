#pragma once
// A GPU that counts instead of drawing: it keeps the node buffer and which bricks are generated, and answers as late as it is told.
#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "fake_source.h"
#include "welkin/octree/max_code.h"
#include "welkin/octree/tree.h"
#include "welkin/stream/streamer.h"

namespace welkin::test {

class FakeGpu {
 public:
  FakeGpu(const FakeSource& source, const RootFrame& root, StreamSettings settings)
      : source_(source), root_(root), settings_(settings), words_(settings.groupCapacity * 8, {0xFFFFFFFFu, 0}) {}

  // Executes edits in their order. Results are due `delay` frames later. An error message, or empty.
  std::string apply(const FrameEdits& edits, std::uint64_t frame, std::uint64_t delay, std::uint32_t maxBricks, glm::dvec3 toSun = {}) {
    if (edits.generate.size() > maxBricks) return "more bricks to generate than asked for";
    for (const NodeWrite& w : edits.nodes) {
      if (w.node >= words_.size()) return "a node write beyond the buffer";
      words_[w.node] = w.words;
    }
    std::set<std::uint32_t> lit;
    for (const BrickJob& job : edits.light) {
      const auto made = made_.find(job.brick);
      if (made == made_.end() || made->second.corner != job.corner || made->second.level != job.level)
        return "light for a brick that holds something else";
      if (!lit.insert(job.brick).second) return "a brick lit twice in a frame";
    }
    for (const std::uint32_t brick : lit) litAt_[brick] = frame, litFor_[brick] = toSun;
    if (std::string wrong = descend(lit, edits.dirty, frame); !wrong.empty()) return wrong;
    for (const BrickJob& job : edits.generate) {
      if (job.brick == 0 || job.brick >= settings_.brickCapacity) return "a job for a brick that is none";
      if (shown_.contains(job.brick)) return "a brick generated over one that rays see";
      made_[job.brick] = job;
      due_.push_back({frame + delay, result(job)});
    }
    return {};
  }

  std::vector<BrickResult> results(std::uint64_t frame) {
    std::vector<BrickResult> out;
    while (!due_.empty() && due_.front().first <= frame) {
      out.push_back(due_.front().second);
      due_.pop_front();
    }
    return out;
  }
  std::vector<BrickResult> lose(std::mt19937& random, double share, std::vector<BrickResult> all) {
    std::erase_if(all, [&](const BrickResult&) { return std::uniform_real_distribution<>(0, 1)(random) < share; });
    return all;
  }

  BrickResult result(const BrickJob& job) const {
    BrickResult r{job.brick, 1, 0, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for (std::uint32_t i = 0; i < 512; ++i) {
      const glm::uvec3 p = shared::brickSample(job.corner, job.level, {i % 8, i / 8 % 8, i / 64});
      const float v = source_.density(p, job.level) / source_.maxExtinction();
      r.min = std::min(r.min, v);
      r.max = std::max(r.max, v);
      if (v > 0) {
        const auto h = static_cast<float>(glm::length(root_.toPlanet(p)) - root_.planetRadius_m);
        const auto voxel = static_cast<float>(root_.nodeSize_m(job.level) / 7);
        r.minAltitude_m = std::min(r.minAltitude_m, h - voxel);
        r.maxAltitude_m = std::max(r.maxAltitude_m, h + voxel);
      }
    }
    return r;
  }

  // The node that a ray at p which wants `level` reads: (level, brick).
  NodeAddress descendTo(glm::uvec3 p, std::uint32_t level, std::uint32_t* brick = nullptr) const {
    std::uint32_t node = 0, at = 0;
    while (at < level && words_[node].group != shared::kNoGroup) {
      node = words_[node].group + shared::childOctant(p, at);
      ++at;
    }
    if (brick) *brick = shared::wordBrick(words_[node].word);
    return {shared::nodeCorner(p, at), at};
  }
  const std::map<std::uint32_t, BrickJob>& shown() const { return shown_; }
  // Of all bricks: how many frames a neighbour towards the sun has been there, at most, that its light has not seen.
  std::uint64_t latestLight(glm::ivec3 toSun, std::uint64_t frame) const {
    std::map<std::array<std::uint64_t, 4>, std::uint32_t> at;
    for (const auto& [brick, job] : shown_) at[{job.level, job.corner.x, job.corner.y, job.corner.z}] = brick;
    std::uint64_t lag = 0;
    for (const auto& [brick, job] : shown_) {
      const std::uint64_t size = 1ull << (32 - job.level);
      for (int mask = 1; mask < 8; ++mask) {
        const glm::ivec3 o = toSun * glm::ivec3(mask & 1, (mask >> 1) & 1, mask >> 2);
        const auto found = at.find({job.level, job.corner.x + o.x * size, job.corner.y + o.y * size, job.corner.z + o.z * size});
        if (found != at.end() && cameAt_.at(found->second) > litAt_.at(brick)) lag = std::max(lag, frame - cameAt_.at(found->second));
      }
    }
    return lag;
  }
  bool allLitSinceTheLastCame() const {
    return std::all_of(shown_.begin(), shown_.end(), [this](const auto& s) { return litAt_.at(s.first) >= lastCame_; });
  }
  // How far, as a chord, the sun is from where it stood when a brick was lit; of all that rays can reach, the greatest.
  double light_rad(std::uint32_t brick, glm::dvec3 toSun) const { return glm::length(litFor_.at(brick) - toSun); }
  double oldestLight_rad(glm::dvec3 toSun) const {
    double most = 0;
    for (const auto& [brick, job] : shown_) most = std::max(most, light_rad(brick, toSun));
    return most;
  }
  std::size_t reachableGroups() const { return reachableGroups_; }

 private:
  // Walks all that rays can reach: bricks are generated for that very node, owned once, lit when they appeared, changes are dirty.
  std::string descend(const std::set<std::uint32_t>& lit, const std::vector<DirtyNode>& dirty, std::uint64_t frame) {
    std::map<std::uint32_t, BrickJob> now;
    std::set<std::uint32_t> groups;
    reachableGroups_ = 0;
    emptyNow_.clear();
    float unused = 0;
    std::string wrong = visit(0, glm::uvec3(0), 0, now, groups, unused);
    if (!wrong.empty()) return wrong;
    for (const auto& [brick, job] : now) {
      const auto old = shown_.find(brick);
      const bool fresh = old == shown_.end() || old->second.corner != job.corner || old->second.level != job.level;
      if (fresh) cameAt_[brick] = lastCame_ = frame;
      if (fresh && !lit.contains(brick)) return "a brick appeared and was not lit";
      if (fresh && !covered(job, dirty)) return "a brick appeared and no node above it is dirty";
    }
    for (const auto& [brick, job] : shown_) {
      const auto same = now.find(brick);
      const bool gone = same == now.end() || same->second.corner != job.corner || same->second.level != job.level;
      if (gone && !covered(job, dirty)) return "a brick went and no node above it is dirty";
    }
    // A map may name a node as the highest empty ancestor of any place in it: when that changes, all of it is dirty.
    for (const auto& [address, empty] : emptyNow_) {
      const auto old = empty_.find(address);
      if (old == empty_.end() || old->second == empty) continue;
      if (!covered({0, {address[1], address[2], address[3]}, address[0]}, dirty))
        return "a node turned empty, or stopped being so, and is not dirty";
    }
    empty_.swap(emptyNow_);
    for (const std::uint32_t brick : lit) {
      if (!now.contains(brick)) return "a brick is lit that no ray can reach";
    }
    shown_ = std::move(now);
    return {};
  }

  static bool covered(const BrickJob& job, const std::vector<DirtyNode>& dirty) {
    for (const DirtyNode& d : dirty) {
      if (d.level <= job.level && shared::nodeCorner(job.corner, d.level) == d.corner) return true;
    }
    return false;
  }

  std::string visit(std::uint32_t node, glm::uvec3 corner, std::uint32_t level, std::map<std::uint32_t, BrickJob>& now,
                    std::set<std::uint32_t>& groups, float& greatest) {
    const shared::NodeWords w = words_[node];
    if (w.word == 0xFFFFFFFFu) return "a node that was never written is reachable";
    const std::uint32_t brick = shared::wordBrick(w.word);
    const Bounds bounds = source_.bounds(corner, level);
    greatest = 0;
    if (brick != 0) {
      const auto made = made_.find(brick);
      if (made == made_.end() || made->second.corner != corner || made->second.level != level)
        return "a node has a brick that holds another";
      if (!now.emplace(brick, made->second).second) return "a brick is owned twice";
      greatest = maxima(made->second);
      if (greatest <= 0) return "an empty brick is kept";
      if (bounds.empty()) return "a node that is empty by its source has a brick";
    }
    if (w.group != shared::kNoGroup) {
      if (bounds.empty()) return "a node that is empty by its source has children";
      if (w.group % 8 != 0 || w.group + 8 > words_.size() || !groups.insert(w.group).second) return "a bad or doubled child group";
      ++reachableGroups_;
      for (std::uint32_t octant = 0; octant < 8; ++octant) {
        float below = 0;
        if (std::string wrong = visit(w.group + octant, shared::childCorner(corner, level, octant), level + 1, now, groups, below);
            !wrong.empty())
          return wrong;
        greatest = std::max(greatest, below);
      }
    }
    const std::uint32_t code = shared::wordMaxCode(w.word);
    if (code != maxCodeFor(greatest)) return "the maximum of a node is not that of what is reachable below it";
    emptyNow_[{level, corner.x, corner.y, corner.z}] = code == 0;
    return {};
  }

  float maxima(const BrickJob& job) {
    const auto [it, fresh] = maxima_.try_emplace({job.level, job.corner.x, job.corner.y, job.corner.z}, 0.0f);
    if (fresh) it->second = result(job).max;
    return it->second;
  }

  const FakeSource& source_;
  RootFrame root_;
  StreamSettings settings_;
  std::vector<shared::NodeWords> words_;
  std::map<std::uint32_t, BrickJob> made_, shown_;
  std::map<std::array<std::uint32_t, 4>, float> maxima_;
  std::map<std::array<std::uint32_t, 4>, bool> empty_, emptyNow_;  // by address
  std::deque<std::pair<std::uint64_t, BrickResult>> due_;
  std::map<std::uint32_t, std::uint64_t> litAt_, cameAt_;  // frames, by brick
  std::map<std::uint32_t, glm::dvec3> litFor_;
  std::uint64_t lastCame_ = 0;
  std::size_t reachableGroups_ = 0;
};

}  // namespace welkin::test
