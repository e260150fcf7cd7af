#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/points/burst.h"

namespace kinegraph {

NodeType burst_node() {
  const BurstParams defaults;
  NodeType type;
  type.name = "Burst";
  type.category = "motion";
  type.help = "An explosion's particles that burst, rise and fold over like a mushroom. Needs no file.";
  type.source = "Cao et al., §7.3";
  type.keywords = {"explosion", "particles", "mushroom", "source", "generate"};
  type.output("points", "Points", "The particles.");
  type.param("particles", integer(defaults.particles).between(1, 100000).slider(10, 1000),
             "How many particles there are.");
  type.param("speed", number(defaults.speed).between(0.01, 1000).in("m/s").slider(1, 20),
             "Speed of the burst outwards.");
  type.param("girth", number(defaults.girth).between(0.01, 1000).in("m").slider(0.2, 5),
             "Radius that the cloud grows to.");
  type.param("rise", number(defaults.rise).between(0, 1000).in("m").slider(0, 10), "How high it climbs.");
  type.param("seconds", number(defaults.seconds).between(0, 600).in("s").slider(1, 10), "How long it lasts.");
  type.param("fps", number(defaults.fps).between(1, 1000).in("frames/s").slider(24, 120), "Frames a second.");
  type.param("seed", integer(0).between(0, 9007199254740991.0), "Another explosion of the same kind.");
  type.compute = [](Compute& compute) {
    const Params& params = compute.params();
    BurstParams burst_params;
    burst_params.particles = static_cast<int>(params.integer("particles"));
    burst_params.speed = params.number("speed");
    burst_params.girth = params.number("girth");
    burst_params.rise = params.number("rise");
    burst_params.seconds = params.number("seconds");
    burst_params.fps = params.number("fps");
    burst_params.seed = static_cast<std::uint64_t>(params.integer("seed"));
    compute.output("points", burst(burst_params, compute.work()));
  };
  return type;
}

}  // namespace kinegraph
