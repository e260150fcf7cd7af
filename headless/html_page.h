// The page of the HTML report around its data: headless/page/, put together when the project is configured.
#pragma once
#include <string>
#include <string_view>

#include "graph/json.h"

namespace kinegraph {

std::string_view html_page_start();  // up to where the data stand, as JSON
std::string_view html_page_end();

// The page with these data in it.
std::string html_page(const Json& data);

}  // namespace kinegraph
