// The march of one view ray through the clouds: highest empty ancestors are jumped over, of a brick only the altitudes that its data
// fills are integrated, in segments that are analytic for linear density.
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/cloud_light.glsl.h"
#include "welkin/shared/cloud_weights.glsl.h"
#include "welkin/shared/integrators.glsl.h"
#include "welkin/shared/step_rules.glsl.h"
#include "lib/walk.glsl"

struct CloudRay {
  float sun;            // in-scatter weights: times sun irradiance, times sky and ground irradiance
  float sky;
  float ground;
  float transmittance;
  float distance_m;     // from the camera, weighted by what each point adds to opacity; of the ground or the sky if nothing is met
  uint cells, samples;  // look-ups, brick samples
  bool hole;            // met data coarser than the streamer promised for the distance
};

const float kOpaqueTransmittance = 1.0 / 512.0;
const int kMaxCells = 4096;         // an opaque or left ray ends long before; software GL stops at 65535 turns in all

// Seen from outside, at the limb, a voxel's height is seen, not its width: cloud that coarse voxels carry above the source's top would
// stand out from the disc, and is left out. 1 past the limb, 0 away from it and inside the air, where voxels are small.
const float kLimbCosine = 0.12;                       // of a ray with the ground's normal: 7 degrees
const float kLimbFrom_m = 50e3, kLimbFull_m = 250e3;  // altitudes
float limbShare(dvec3 position, double altitude, double radius, vec3 dir, float ground_m) {
  float cosine = ground_m >= 0.0 ? -float(dot(position + dvec3(dir) * double(ground_m), dvec3(dir)) / radius) : 0.0;
  return (1.0 - smoothstep(0.0, kLimbCosine, cosine)) * smoothstep(kLimbFrom_m, kLimbFull_m, float(altitude));
}

struct Segment { float near, far; };

// Where the ray is between the lowest base and the highest top of resident data, and not behind the ground.
Segment cloudSegment(dvec3 position, double altitude, double r, double radius, vec3 dir, float ground_m) {
  double b = dot(position, dvec3(dir));
  float limb = limbShare(position, altitude, radius, dir, ground_m);
  double top = double(mix(tree.bandTop_m, min(tree.bandTop_m, tree.cloudTop_m), limb)), base = double(tree.bandBase_m);
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
  CloudRay ray = CloudRay(0.0, 0.0, 0.0, 1.0, ground_m >= 0.0 ? ground_m : kSkyDistance_m, 0u, 0u, false);
  Segment segment = cloudSegment(position, altitude, r, radius, dir, ground_m);
  if (segment.near >= segment.far) return ray;
  Walk walk = startWalk(position + dvec3(dir) * double(segment.near), dir);
  float t = 0.0, end = segment.far - segment.near;
  float cellsAlong = 7.0 * max(abs(walk.dirSteps.x), max(abs(walk.dirSteps.y), abs(walk.dirSteps.z)));  // times 1 / size: cells a metre
  float weighted = 0.0, open = 0.0;
  float lastLight = 0.0;  // sun depth at the last sample
  int visit = 0;
  // Every loop ends with its condition, and both sides of an `if` are cheap: software GL runs a loop's body once however it begins,
  // and both sides of every branch.
  do {
    // On to the next brick that is not empty.
    vec3 steps;
    uint level, brick, parent, bounding;
    float next, parentWeight;
    bool empty;
    do {
      float away = segment.near + t;
      uvec3 p = walkTo(walk, t);
      DetailLevel detail = detailAt(tree.detail * tree.rootSize_m / max(away, tree.sampleNear_m), tree.depth);
      uint mapLevel = mapLevelAt(tree.rootSize_m / max(away, 1e-3), tree.mapBase, tree.depth);
      uint word = 0u;
      uint want = detail.level;
      bool again = false;
      parent = kZeroBrick;
      parentWeight = 0.0;
      do {  // a second turn for the parent where it fades in
        uint found = lookUp(p, want, mapLevel);
        ray.cells++;
        parent = again ? wordBrick(found) : parent;
        parentWeight = again ? detail.parentWeight : parentWeight;
        word = again ? word : found;
        bounding = found;
        again = !again && detail.parentWeight > 0.0 && want > 0u && wordLevel(found) == want;
        want--;
      } while (again);
      empty = wordEmpty(bounding);
      ray.hole = ray.hole || (!wordEmpty(word) && wordLevel(word) < detail.level);
      brick = wordBrick(word);
      level = empty ? wordLevel(bounding) : wordLevel(word);
      steps = nodeSteps(p, level);
      next = min(t + nodeExit(steps, levelSteps(level), walk.ahead, walk.metrePerStep) + pastExit(away), end);
      t = empty ? next : t;
      visit++;
    } while (empty && t < end && visit < kMaxCells);
    // An empty brick left at the end of the ray is the zero brick, and adds nothing.
    float span = next - t;
    float perStep = levelStepsInverse(level);
    vec3 local = steps * (7.0 * perStep);
    vec3 slope = walk.dirSteps * (7.0 * perStep);
    // inside the parent: half the cells, from 0 or 3.5
    vec3 parentLocal = 0.5 * local + 3.5 * vec3(walkOctant(walk, t, level));
    float bound = maxCodeValue(wordMaxCode(bounding)) * tree.maxExtinction_per_m * span;
    float halves = span * cellsAlong * perStep * (2.0 / 7.0);
    float finer = mix(kLeastCount, 1.0, ray.transmittance) / tree.step;
    float count = max(ceil(min(halves, bound / kDepthShare) * finer), 1.0);
    float dt = span / count;
    float density = tree.maxExtinction_per_m;
    float i = 0.5;
    do {
      float s = i * dt;
      vec2 data = vec2(0.0);
      vec3 at = local + slope * s;
      uint from = brick;
      float share = 1.0 - parentWeight;
      bool coarse = false;
      do {  // a second turn for the parent; light belongs to the density it was stored with
        vec2 found = sampleBrick(from, at);
        float own = found.x * share, both = data.x + own;
        data = vec2(both, both > 0.0 ? mix(data.y, found.y, own / both) : found.y);
        ray.samples++;
        coarse = !coarse && parentWeight > 0.0;
        from = parent;
        at = parentLocal + slope * (0.5 * s);
        share = parentWeight;
      } while (coarse);
      float thickness = data.x * density * dt;
      float kept = ray.transmittance * exp2(thickness * -1.44269504);
      float gain = ray.transmittance - kept;
      // at the front of the segment the light is between the last midpoint's and this one's
      float encoded = mix(0.5 * (lastLight + data.y), data.y, 2.0 * emissionDepth(thickness));
      lastLight = data.y;
      ray.sun += gain * sunSource(phases, encoded);
      open += gain * skyShare(encoded);
      weighted += gain * (t + s);
      ray.transmittance = kept;
      i += 1.0;
    } while (i < count && ray.transmittance >= kOpaqueTransmittance);
    t = next;
  } while (t < end && ray.transmittance >= kOpaqueTransmittance && visit < kMaxCells);
  float opacity = 1.0 - ray.transmittance;
  if (opacity > 0.0) ray.distance_m = segment.near + weighted / opacity;
  // what little light passes an opaque cloud is given to what was seen
  float rest = ray.transmittance < kOpaqueTransmittance ? 1.0 / opacity : 1.0;
  ray.sun *= rest;
  ray.sky = skySource(open) * rest;
  ray.ground = groundSource(opacity, open) * rest;
  if (ray.transmittance < kOpaqueTransmittance) ray.transmittance = 0.0;
  return ray;
}
