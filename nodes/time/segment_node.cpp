#include <fmt/format.h>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/metrics.h"
#include "nodes/time/segment.h"

namespace kinegraph {
namespace {

void compute(Compute& node) {
  const auto& motion = node.input<Motion>("motion");
  const auto pieces = behaviour_pieces(motion, node.params().number("sensitivity"), node.work());
  const auto wanted = static_cast<std::size_t>(node.params().integer("piece"));
  if (node.wanted("motion")) {
    if (wanted > pieces.size())
      throw Failure(error("no-such-piece",
                          fmt::format("there is no piece {}: the motion has {}", wanted, pieces.size()))
                        .at_param("piece")
                        .hinting("choose a smaller one, or raise sensitivity for more cuts"));
    node.output("motion", piece_of(motion, pieces[wanted - 1]));
  }
  Metrics metrics;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    metrics.all.push_back(
        {fmt::format("piece{}.start", k + 1), static_cast<double>(pieces[k].start), "frames"});
    metrics.all.push_back({fmt::format("piece{}.end", k + 1), static_cast<double>(pieces[k].end), "frames"});
  }
  node.output("pieces", std::move(metrics));
}

}  // namespace

NodeType segment_node() {
  NodeType type;
  type.name = "Segment";
  type.category = "time";
  type.help =
      "Cuts a motion where its behaviour changes, so that each piece has one style, and passes on one piece.";
  type.source = "Barbič et al., Segmenting Motion Capture Data into Distinct Behaviors, 2004, §3.1";
  type.keywords = {"cut", "split", "behaviour", "clip"};
  type.input("motion", {"Motion"}, "The motion to cut.");
  type.output("motion", "Motion", "The chosen piece.", "motion");
  type.output("pieces", "Metrics",
              "First frame of each piece and the frame after its last: piece1.start, piece1.end …");
  type.param("piece", integer(1).between(1, 1e6).slider(1, 10), "Which piece to pass on, counted from 1.");
  type.param("sensitivity", number(1).between(0.05, 20).slider(0.2, 3), "Larger: more cuts.");
  type.code_version = 2;
  type.compute = compute;
  return type;
}

}  // namespace kinegraph
