// The march of one view ray through the clouds: highest empty ancestors are jumped over, a brick is integrated in analytic segments.
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/cloud_light.glsl.h"
#include "lib/walk.glsl"

struct CloudRay {
  float sun;            // in-scatter weights: times sun irradiance, times sky and ground irradiance
  float sky;
  float ground;
  float transmittance;
  float distance_m;     // from the camera, weighted by what each point adds to opacity; of the ground or the sky if nothing is met
  uint cells, samples;  // look-ups, brick samples
  bool hole;
};

const float kOpaqueTransmittance = 1.0 / 512.0;
const int kMaxCells = 4096;         // an opaque or left ray ends long before; software GL stops at 65535 turns in all
const float kSkyDistance_m = 1e12;     // what is not there moves with the camera: only rotation reprojects it
const float kThinBrick = 0.1;       // optical depth under which one segment serves a brick

struct Segment { float near, far; };

// Where the ray is between the lowest base and the highest top of resident data, and not behind the ground.
Segment cloudSegment(dvec3 position, double altitude, double r, double radius, vec3 dir, float ground_m) {
  double b = dot(position, dvec3(dir));
  double top = double(tree.bandTop_m), base = double(tree.bandBase_m);
  Interval outer = sphereInterval(b, (altitude - top) * (r + radius + top));
  if (outer.near > outer.far) return Segment(1.0, 0.0);
  float near = outer.near, far = outer.far;
  if (ground_m >= 0.0) far = min(far, ground_m);
  if (base > -radius) {
    Interval inner = sphereInterval(b, (altitude - base) * (r + radius + base));
    if (inner.near <= inner.far) {
      if (altitude < base) near = max(near, inner.far);           // below the clouds: they begin where the base is left
      else if (ground_m >= 0.0) far = min(far, inner.near);       // from above onto the ground: they end at the base
    }
  }
  return Segment(near, far);
}

CloudRay marchClouds(dvec3 position, double altitude, double r, double radius, vec3 dir, float ground_m, CloudPhases phases) {
  CloudRay ray = CloudRay(0.0, 0.0, 0.0, 1.0, 0.0, 0u, 0u, false);
  Segment segment = cloudSegment(position, altitude, r, radius, dir, ground_m);
  ray.distance_m = ground_m >= 0.0 ? ground_m : kSkyDistance_m;
  if (segment.near >= segment.far) return ray;
  Walk walk = startWalk(position + dvec3(dir) * double(segment.near), dir);
  float t = 0.0, end = segment.far - segment.near;
  float weight = 0.0, weighted = 0.0;
  for (int visit = 0; visit < kMaxCells && t < end; ++visit) {
    float rootOverDistance = tree.rootSize_m / max(segment.near + t, 1e-3);
    uvec3 p = walkTo(walk, t);
    DetailLevel detail = detailAt(tree.detail * rootOverDistance, tree.depth);
    uint mapLevel = mapLevelAt(rootOverDistance, tree.mapBase, tree.depth);
    uint word = lookUp(p, detail.level, mapLevel);
    ray.cells++;
    uint level = wordLevel(word);
    uint parent = kZeroBrick;
    uint parentLevel = level;
    bool empty = wordEmpty(word);
    uint maxCode = wordMaxCode(word);
    if (detail.parentWeight > 0.0 && level == detail.level && level > 0u) {
      uint parentWord = lookUp(p, level - 1u, mapLevel);
      ray.cells++;
      parent = wordBrick(parentWord);
      parentLevel = wordLevel(parentWord);
      empty = wordEmpty(parentWord);
      maxCode = wordMaxCode(parentWord);
      if (empty) level = parentLevel;
    }
    float next = min(t + nodeExit(p, level, walk.dirSteps, walk.metrePerStep) + pastExit(segment.near + t), end);
    if (!empty) {
      float span = next - t;
      float bound = maxCodeValue(maxCode) * tree.maxExtinction_per_m * span;
      float inverseSize = 7.0 / levelSteps(level);
      vec3 local = nodeLocal(p, level) * 7.0;
      vec3 slope = walk.dirSteps * inverseSize;
      uint brick = wordBrick(word);
      bool blend = parentLevel < level;
      float voxels = span * max(abs(slope.x), max(abs(slope.y), abs(slope.z)));
      float count = bound < kThinBrick && !blend ? 1.0 : clamp(ceil(min(voxels * tree.voxelSegments, bound / tree.segmentDepth)), 1.0, 16.0);
      float dt = span / count;
      vec3 parentLocal = vec3(0.0);
      if (blend) parentLocal = nodeLocal(p, parentLevel) * 7.0;
      for (float i = 0.5; i < count; i += 1.0) {
        float s = i * dt;
        vec2 data = sampleBrick(brick, local + slope * s);
        ray.samples++;
        if (blend) {
          float w = detailAt(tree.detail * tree.rootSize_m / (segment.near + t + s), tree.depth).parentWeight;
          vec2 coarse = sampleBrick(parent, parentLocal + slope * (0.5 * s));
          ray.samples++;
          // light belongs to the density it was stored with
          float fine = data.x * (1.0 - w), both = fine + coarse.x * w;
          data.y = both > 0.0 ? mix(data.y, coarse.y, coarse.x * w / both) : data.y;
          data.x = both;
        }
        if (data.x > 0.0) {
          float kept = exp2(data.x * tree.maxExtinction_per_m * dt * -1.44269504);
          float tau = decodeDepth(data.y);
          float gain = ray.transmittance * (1.0 - kept);
          ray.sun += gain * sunSource(phases, tau);
          ray.sky += gain * skySource(tau);
          ray.ground += gain * groundSource(tau);
          weighted += gain * (t + s);
          weight += gain;
          ray.transmittance *= kept;
        }
      }
      if (ray.transmittance < kOpaqueTransmittance) {
        float rest = 1.0 / (1.0 - ray.transmittance);
        ray.sun *= rest;
        ray.sky *= rest;
        ray.ground *= rest;
        ray.transmittance = 0.0;
        break;
      }
    }
    t = next;
  }
  if (weight > 0.0) ray.distance_m = segment.near + weighted / weight;
  return ray;
}
