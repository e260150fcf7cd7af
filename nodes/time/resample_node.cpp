#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/resample.h"

namespace kinegraph {

NodeType resample_node() {
  NodeType type;
  type.name = "Resample";
  type.category = "time";
  type.help = "Gives a motion another frame rate; it keeps its speed and length in seconds.";
  type.keywords = {"fps", "rate", "frames per second", "convert"};
  type.input("motion", {"Motion"}, "The motion.");
  type.output("motion", "Motion", "The same movement at the new rate.", "motion");
  type.param("fps", number(120).between(0.01, 100000).in("frames/s").slider(24, 240),
             "The new rate. Rotations go by Slerp, translations by a cubic.");
  type.compute = [](Compute& compute) {
    compute.output(
        "motion", resampled(compute.input<Motion>("motion"), compute.params().number("fps"), compute.work()));
  };
  return type;
}

}  // namespace kinegraph
