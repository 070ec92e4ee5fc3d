// What the debug views see of a ray that is marched (lib/cloud_march.glsl).
struct Watched {
  float way_m, empty_m;     // within the clouds' band, as far as the ray went; of it in empty nodes
  float greatest_per_m;     // extinction sampled
  float transmittance;      // so far
  float most;               // opacity that one brick added, at most
  uint level;               // of that brick
};
Watched watched = Watched(0.0, 0.0, 0.0, 1.0, 0.0, 0u);

void watchNode(bool empty, float way_m) {
  watched.way_m += way_m;
  watched.empty_m += empty ? way_m : 0.0;
}

void watchSample(float extinction_per_m) { watched.greatest_per_m = max(watched.greatest_per_m, extinction_per_m); }

void watchBrick(uint level, float transmittance) {
  float added = watched.transmittance - transmittance;
  watched.level = added > watched.most ? level : watched.level;
  watched.most = max(added, watched.most);
  watched.transmittance = transmittance;
}
