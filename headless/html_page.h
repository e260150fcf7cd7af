// The page of the HTML report around its data: style before, script after.
#pragma once
#include <string_view>

namespace kinegraph {

std::string_view html_page_start();  // up to where the data stand, as JSON
std::string_view html_page_end();

}  // namespace kinegraph
