// Where this checkout and its programs are. Only places.cpp is compiled with these paths, so that a
// compiler's cache serves every checkout.
#pragma once
#include <string>

namespace kinegraph {

std::string source_folder();  // the checkout, absolute, without a slash at its end
std::string bin_folder();     // of the programs built

}  // namespace kinegraph
