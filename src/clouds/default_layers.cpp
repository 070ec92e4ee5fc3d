#include "welkin/clouds/default_layers.h"

namespace welkin {

// Heights and thicknesses: WMO cloud atlas, middle latitudes. Extinctions: visible optical depths of 5-30 for low cloud, 20-60 and more
// for towers, 2-8 for altocumulus, 0.2-2 for cirrus, over the thickness.
std::vector<CloudLayer> defaultEarthLayers() {
  std::vector<CloudLayer> layers;
  {
    CloudLayer l;  // decks of rounded cells with dark cracks between them
    l.name = "stratocumulus";
    l.base_m = 650, l.top_m = 2000, l.baseFade_m = 150, l.topFade_m = 250;
    l.extinction_per_m = 0.03;
    l.coverGain = 1.1, l.coverBias = -0.06;
    l.typeLow = 0, l.typeHigh = 0.6;
    l.cell_m = 12500, l.octaves = 8, l.gain = 0.62, l.billow = 0.7;
    l.softness = 0.2, l.taper = 0.6, l.topFollowsCover = 0.2;
    layers.push_back(l);
  }
  {
    CloudLayer l;  // fair-weather heaps: flat crisp bases, cauliflower tops
    l.name = "cumulus";
    l.base_m = 950, l.top_m = 3600, l.baseFade_m = 70, l.topFade_m = 500;
    l.extinction_per_m = 0.045;
    l.coverGain = 0.85, l.coverBias = -0.02;
    l.typeLow = 0.35, l.typeHigh = 1;
    l.cell_m = 6200, l.octaves = 8, l.gain = 0.55, l.billow = 0.6;
    l.softness = 0.08, l.taper = 0.6, l.topFollowsCover = 0.3;
    layers.push_back(l);
  }
  {
    CloudLayer l;  // towers where cover is thick
    l.name = "cumulonimbus";
    l.base_m = 900, l.top_m = 9200, l.baseFade_m = 150, l.topFade_m = 900;
    l.extinction_per_m = 0.035;
    l.coverGain = 0.8, l.coverBias = -0.36;
    l.typeLow = 0.4, l.typeHigh = 1;
    l.cell_m = 12500, l.octaves = 9, l.gain = 0.52, l.billow = 0.55;
    l.softness = 0.08, l.taper = 0.55, l.topFollowsCover = 0.2;
    layers.push_back(l);
  }
  {
    CloudLayer l;  // the grey body of fronts
    l.name = "nimbostratus";
    l.base_m = 1800, l.top_m = 5400, l.baseFade_m = 500, l.topFade_m = 900;
    l.extinction_per_m = 0.011;
    l.coverGain = 1.0, l.coverBias = -0.5;
    l.typeLow = 0, l.typeHigh = 0.6;
    l.cell_m = 25000, l.octaves = 8, l.gain = 0.58, l.billow = 0.4;
    l.softness = 0.25, l.taper = 0.5, l.topFollowsCover = 0.5;
    layers.push_back(l);
  }
  {
    CloudLayer l;  // small rows of puffs
    l.name = "altocumulus";
    l.base_m = 4400, l.top_m = 5100, l.baseFade_m = 120, l.topFade_m = 200;
    l.extinction_per_m = 0.01;
    l.coverGain = 0.7, l.coverBias = -0.25;
    l.typeLow = 0.2, l.typeHigh = 0.85;
    l.cell_m = 6200, l.octaves = 6, l.gain = 0.7, l.billow = 0.5;
    l.softness = 0.2, l.taper = 0.3;
    layers.push_back(l);
  }
  {
    CloudLayer l;  // ice: thin wisps drawn out by the wind
    l.name = "cirrus";
    l.base_m = 9700, l.top_m = 11300, l.baseFade_m = 600, l.topFade_m = 700;
    l.extinction_per_m = 0.0008;
    l.coverGain = 0.55, l.coverBias = -0.05;
    l.cell_m = 50000, l.octaves = 6, l.gain = 0.62, l.billow = 0.0;
    l.softness = 0.7, l.taper = 0.2;
    l.streak = 2, l.warp_m = 5000;
    layers.push_back(l);
  }
  return layers;
}

}  // namespace welkin
