#include "headless/html_page.h"

namespace kinegraph {

namespace {

// Inside a script element nothing may look like its end.
std::string safe(std::string text) {
  for (auto at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3))
    text.replace(at, 2, "<\\/");
  for (auto at = text.find("<!--"); at != std::string::npos; at = text.find("<!--", at + 6))
    text.replace(at, 4, "\\u003c!--");
  return text;
}

}  // namespace

std::string html_page(const Json& data) {
  return std::string(html_page_start()) + safe(compact(data)) + std::string(html_page_end());
}

}  // namespace kinegraph
