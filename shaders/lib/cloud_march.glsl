// The march of one view ray through the clouds: highest empty ancestors are jumped over (SKIP_EMPTY), bricks are added up by the rule
// INTEGRATOR in segments by the rule STEP_RULE; the last one of a ray ends at the ground or where the clouds do.
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/cloud_light.glsl.h"
#include "welkin/shared/cloud_weights.glsl.h"
#include "welkin/shared/integrators.glsl.h"
#include "welkin/shared/step_rules.glsl.h"
#include "lib/walk.glsl"
#ifdef DEBUG_VIEW
#include "lib/watch.glsl"
#else
#define watchNode(empty, way_m)
#define watchSample(extinction_per_m)
#define watchBrick(level, transmittance)
#endif

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

// The part of one brick that a ray crosses, with its parent where that fades in.
struct BrickPath {
  uint brick, parent;
  float parentWeight;
  vec3 local, parentLocal;  // where the ray enters, in cells
  vec3 slope;               // cells a metre; half as many in the parent
  float cell_m;             // a voxel's edge
};

// Density fraction, encoded sun depth and chords, a distance s into the brick; light belongs to the density that it was stored with.
vec4 sampleField(BrickPath path, float s) {
  vec4 data = vec4(0.0);
  uint from = path.brick;
  float share = 1.0 - path.parentWeight;
  vec3 at = path.local + path.slope * s;
  bool coarse = false;
  do {  // a second turn for the parent
    vec4 found = vec4(sampleBrick(from, at), sampleChords(from, at));
    float own = found.x * share, both = data.x + own;
    data = vec4(both, both > 0.0 ? mix(data.yzw, found.yzw, own / both) : found.yzw);
    coarse = !coarse && path.parentWeight > 0.0;
    from = path.parent;
    at = path.parentLocal + path.slope * (0.5 * s);
    share = path.parentWeight;
  } while (coarse);
  return data;
}

// What a ray has gathered: in-scatter, what of it the open sky lights, what of it there is, the same times distance.
struct Gathered { float sun, open, all, weighted; };

// A sample as its rule weighs it: extinction [1/m], source of sunlight and share of the sky's.
struct Node { float extinction_per_m; float sun, sky; };

// The point where a ray meets the clouds' shell, times the sun's direction, the ray's, and itself; cosine between sun and ray: what zenith
// angles along it follow from.
struct Zenith { float sunAt_m, viewAt_m, square_m2, cosine; };

Node nodeAt(BrickPath path, float s, float distance_m, Zenith zenith, CloudPhases phases, out CloudSlab slab) {
  vec4 data = sampleField(path, s);
  watchSample(data.x * tree.maxExtinction_per_m);
  float upwards = inversesqrt(zenith.square_m2 + distance_m * (2.0 * zenith.viewAt_m + distance_m));
  float muSun = (zenith.sunAt_m + distance_m * zenith.cosine) * upwards, muView = (zenith.viewAt_m + distance_m) * upwards;
  float own = ownChord(data.x * tree.maxExtinction_per_m, path.cell_m);
  slab = cloudSlab(max(decodeDepth(data.z), own), max(decodeDepth(data.w), own), muSun, muView, zenith.cosine);
  float tau = decodeDepth(data.y);
  return Node(data.x * tree.maxExtinction_per_m, sunSource(phases, tau, slab), openShare(tau, slab));
}

void gather(inout Gathered sum, float gain, Node node, float distance_m) {
  sum.sun += gain * node.sun;
  sum.open += gain * node.sky;
  sum.all += gain;
  sum.weighted += gain * distance_m;
}

const float kErrorShare = 0.03;  // kAdaptive: what a segment may err in opacity, times step cubed: its error falls with the cube of its length
const float kMostHalvings = 64.0;

CloudRay marchClouds(dvec3 position, double altitude, double r, double radius, vec3 dir, float ground_m, CloudPhases phases) {
  CloudRay ray = CloudRay(0.0, 0.0, 0.0, 1.0, ground_m >= 0.0 ? ground_m : kSkyDistance_m, 0u, 0u, false);
  Segment segment = cloudSegment(position, altitude, r, radius, dir, ground_m);
  if (segment.near >= segment.far) return ray;
  dvec3 entry = position + dvec3(dir) * double(segment.near);
  Walk walk = startWalk(entry, dir);
  float t = 0.0, end = segment.far - segment.near;
  float cellsAlong = 7.0 * max(abs(walk.dirSteps.x), max(abs(walk.dirSteps.y), abs(walk.dirSteps.z)));  // times 1 / size: cells a metre
  float entryHalf_m = 0.5 * max(segment.near, tree.sampleNear_m) / tree.detail;
  Gathered sum = Gathered(0.0, 0.0, 0.0, 0.0);
  // The last midpoint. At first: from above lit through nothing; else none, for a camera may be inside a cloud, or see its dark side first.
  bool fromAbove = altitude > double(tree.bandTop_m);
  Node before = Node(-1.0, 0.0, 0.0);
  vec3 sun = tree.sunDir.xyz;
  Zenith zenith = Zenith(float(dot(entry, dvec3(sun))), float(dot(entry, dvec3(dir))), float(dot(entry, entry)), dot(dir, sun));
  CloudSlab slab;
  int visit = 0;
  // Every loop ends with its condition, and both sides of an `if` are cheap: software GL runs a loop's body once however it begins,
  // and both sides of every branch.
  do {
    // On to the next brick that is not empty.
    BrickPath path;
    vec3 steps;
    uint level, bounding;
    float next, away;
    bool empty;
    do {
      away = segment.near + t;
      uvec3 p = walkTo(walk, t);
      DetailLevel detail = detailAt(tree.detail * tree.rootSize_m / max(away, tree.sampleNear_m), tree.depth);
      uint mapLevel = mapLevelAt(tree.rootSize_m / max(away, 1e-3), tree.mapBase, tree.depth);
      bool fades = detail.parentWeight > 0.0 && detail.level > 0u;
      Found found = lookUp(p, detail.level, detail.level - (fades ? 1u : 0u), mapLevel);
      ray.cells++;
      uint word = found.word;
      fades = fades && wordLevel(word) == detail.level;
      path.parent = fades ? wordBrick(found.parent) : kZeroBrick;
      path.parentWeight = fades ? detail.parentWeight : 0.0;
      bounding = fades ? found.parent : word;
      empty = wordEmpty(bounding);
      ray.hole = ray.hole || (!wordEmpty(word) && wordLevel(word) < detail.level);
      path.brick = wordBrick(word);
      level = empty ? wordLevel(bounding) : wordLevel(word);
      steps = nodeSteps(p, level);
      next = min(t + leaveNode(walk, steps, levelSteps(level), away), end);
      watchNode(empty, next - t);
#if SKIP_EMPTY
      t = empty ? next : t;
#else
      empty = false;
#endif
      visit++;
    } while (empty && t < end && visit < kMaxCells);
    // An empty brick left at the end of the ray is the zero brick, and adds nothing.
    float span = next - t;
    float perStep = levelStepsInverse(level);
    path.local = steps * (7.0 * perStep);
    path.slope = walk.dirSteps * (7.0 * perStep);
    path.cell_m = levelSteps(level) * tree.stepLength_m / 7.0;
    // inside the parent: half the cells, from 0 or 3.5
    path.parentLocal = 0.5 * path.local + 3.5 * vec3(walkOctant(walk, t, level));
    uint perSample = path.parentWeight > 0.0 ? 2u : 1u;
    float upright = min(abs(zenith.viewAt_m + t) / float(radius), 1.0);  // zenith cosine of the ray, either way
    StepPlace place = StepPlace(span, 0.5 * levelSteps(level) * tree.stepLength_m, span * cellsAlong * perStep * (2.0 / 7.0), path.parentWeight, upright,
                                maxCodeValue(wordMaxCode(bounding)) * tree.maxExtinction_per_m * span, ray.transmittance, t, end, entryHalf_m,
                                0.5 * max(away, tree.sampleNear_m) / tree.pixelDetail);
#if INTEGRATOR == 4 || INTEGRATOR == 5 || INTEGRATOR == 0
    // one sample a segment
    float count = segmentCount(STEP_RULE, tree.step, place), dt = span / count;
    float i = integratorNode(INTEGRATOR, 0u);
    do {
      float s = i * dt;
      Node node = nodeAt(path, s, t + s, zenith, phases, slab);
      ray.samples += perSample;
      SegmentGains g = segmentGains(INTEGRATOR, vec4(node.extinction_per_m, 0.0, 0.0, 0.0), dt);
      gather(sum, ray.transmittance * g.gain.x, node, t + s);
#if INTEGRATOR == 5
      if (before.extinction_per_m < 0.0) before = fromAbove ? Node(0.0, sunSource(phases, 0.0, slab), openShare(0.0, slab)) : node;
      gather(sum, ray.transmittance * g.gain.y, before, t + s);
      before = node;
#endif
      ray.transmittance *= g.transmittance;
      i += 1.0;
    } while (i < count && ray.transmittance >= kOpaqueTransmittance);
#else
    // Samples at both ends: the front's is the back's of the segment before.
#if INTEGRATOR == 6
    float dt = span / segmentCount(STEP_RULE, 1.0, place), least = span / kMostHalvings;
    float allowed = kErrorShare * tree.step * tree.step * tree.step;
#else
    float dt = span / segmentCount(STEP_RULE, tree.step, place);
#endif
    Node front = nodeAt(path, 0.0, t, zenith, phases, slab);
    ray.samples += perSample;
    float s = 0.0;
    bool more;
    do {
      float length_m = min(dt, span - s);
      const uint last = integratorNodes(INTEGRATOR) - 1u;
      Node nodes[4];
      nodes[0] = front;
      for (uint i = 1u; i < 4u; ++i) {
        float along = s + integratorNode(INTEGRATOR, i) * length_m;
        if (i <= last) nodes[i] = nodeAt(path, along, t + along, zenith, phases, slab);
        else nodes[i] = Node(0.0, 0.0, 0.0);
      }
      ray.samples += last * perSample;
      SegmentGains g = segmentGains(INTEGRATOR, vec4(nodes[0].extinction_per_m, nodes[1].extinction_per_m, nodes[2].extinction_per_m, nodes[3].extinction_per_m), length_m);
#if INTEGRATOR == 6
      float error = ray.transmittance * segmentError(g, vec4(nodes[0].extinction_per_m, nodes[1].extinction_per_m, nodes[2].extinction_per_m, 0.0),
                                                     vec4(nodes[0].sky, nodes[1].sky, nodes[2].sky, 0.0));
      bool taken = error <= allowed || length_m <= least;
      dt = max(length_m * clamp(0.9 * pow(allowed / max(error, 1e-12), 0.33333333), 0.25, 4.0), least);
#else
      const bool taken = true;
#endif
      float weight = taken ? ray.transmittance : 0.0;
      for (uint i = 0u; i < 4u; ++i) {
        if (i <= last) gather(sum, weight * g.gain[i], nodes[i], t + s + integratorNode(INTEGRATOR, i) * length_m);
      }
      ray.transmittance *= taken ? g.transmittance : 1.0;
      front.extinction_per_m = taken ? nodes[last].extinction_per_m : front.extinction_per_m;
      front.sun = taken ? nodes[last].sun : front.sun;
      front.sky = taken ? nodes[last].sky : front.sky;
      s += taken ? length_m : 0.0;
      more = span - s > 1e-6 * span;
    } while (more && ray.transmittance >= kOpaqueTransmittance);
#endif
    watchBrick(level, ray.transmittance);
    t = next;
  } while (t < end && ray.transmittance >= kOpaqueTransmittance && visit < kMaxCells);
  float opacity = 1.0 - ray.transmittance;
  if (sum.all > 0.0) ray.distance_m = segment.near + sum.weighted / sum.all;
  // what little light passes an opaque cloud is given to what was seen
  float rest = ray.transmittance < kOpaqueTransmittance ? 1.0 / opacity : 1.0;
  ray.sun = sum.sun * rest;
  ray.sky = skySource(sum.open) * rest;
  ray.ground = groundSource(sum.all, sum.open) * rest;
  if (ray.transmittance < kOpaqueTransmittance) ray.transmittance = 0.0;
  return ray;
}
