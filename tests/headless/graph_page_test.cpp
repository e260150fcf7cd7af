// The graph in docs/graph_file.md is one that runs, and stands in canonical form.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "graph/file/read.h"
#include "graph/file/write.h"
#include "nodes/all_nodes.h"
#include "tests/places.h"

namespace kinegraph {
namespace {

TEST(GraphPage, ShowsAGraphThatIsValidAndCanonical) {
  std::ifstream file(std::string(source_folder()) + "/docs/graph_file.md");
  std::stringstream page;
  page << file.rdbuf();
  const std::string text = page.str(), fence = "```json\n";
  const std::size_t start = text.find(fence);
  ASSERT_NE(start, text.npos);
  const std::size_t from = start + fence.size();
  const std::string graph = text.substr(from, text.find("```", from) - from);
  const Registry registry = all_nodes();
  const ReadResult read = read_document(graph, "graph_file.md", registry);
  for (const Diagnostic& problem : read.problems) ADD_FAILURE() << problem.message;
  EXPECT_EQ(write_document(read.document, registry), graph);
}

}  // namespace
}  // namespace kinegraph
