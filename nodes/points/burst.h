// Particles of an explosion that bursts, rises and folds over like a mushroom [Cao §7.3, Fig. 12]: a source
// that needs no file.
#pragma once
#include <cstdint>

#include "graph/work.h"
#include "nodes/motion/points.h"

namespace kinegraph {

struct BurstParams {
  int particles = 200;
  double speed = 6;    // m/s at which it bursts outwards
  double girth = 1.5;  // m, the cloud's final radius
  double rise = 4;     // m, how high the cloud's middle climbs
  double seconds = 4;
  double fps = 30;
  std::uint64_t seed = 0;
};
// World metres, from the origin upwards; y is never below 0. Particles of the cap circle round a ring that
// widens as the burst slows and rises by its heat: inside up, over the top outwards, outside down. Those of
// the stem follow between the ground and the cap. Smooth in time from the first frame, where all lie
// together; the same seed gives the same bits. Labels p1, p2, …
Points burst(const BurstParams& params, Work& work);

}  // namespace kinegraph
