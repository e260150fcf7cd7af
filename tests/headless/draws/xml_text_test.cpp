#include "headless/draws/xml_text.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

TEST(XmlText, KeepsWhatReadsAsTextAndNothingThatReadsAsMarkup) {
  EXPECT_EQ(xml_text("σ < 0.06° & \"x\" > 1"), "σ &lt; 0.06° &amp; &quot;x&quot; &gt; 1");
}
TEST(XmlText, KeepsLineEndsInAttributes) {
  EXPECT_EQ(xml_text("one\ntwo\tthree"), "one&#10;two\tthree");
}
TEST(XmlText, LeavesOutWhatXmlCannotHold) {
  EXPECT_EQ(xml_text(std::string("a\0b\x1b[1mc\r", 9)), "ab[1mc");
}

}  // namespace
}  // namespace kinegraph
