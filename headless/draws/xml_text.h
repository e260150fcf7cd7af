// Text for XML: SVG pictures, JUnit reports.
#pragma once
#include <string>
#include <string_view>

namespace kinegraph {

// & < > " and line ends as entities, so that it may stand between tags and in an attribute; control
// characters, which XML can't hold, are left out.
std::string xml_text(std::string_view text);

}  // namespace kinegraph
