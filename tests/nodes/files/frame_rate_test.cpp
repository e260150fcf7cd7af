#include "nodes/files/frame_rate.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

TEST(FrameRate, IsTheIntegerWhosePeriodTheTextIs) {
  EXPECT_EQ(rate_of_frame_time(".0083333"), 120);
  EXPECT_EQ(rate_of_frame_time("0.008333"), 120);
  EXPECT_EQ(rate_of_frame_time("0.00833333"), 120);
  EXPECT_EQ(rate_of_frame_time(".03333"), 30);
  EXPECT_EQ(rate_of_frame_time("0.0333333"), 30);
  EXPECT_EQ(rate_of_frame_time("0.016667"), 60);
  EXPECT_EQ(rate_of_frame_time("0.016666666666666666"), 60);
  EXPECT_EQ(rate_of_frame_time("0.041667"), 24);
  EXPECT_EQ(rate_of_frame_time("0.04"), 25);
  EXPECT_EQ(rate_of_frame_time("0.010000"), 100);
  EXPECT_EQ(rate_of_frame_time("8.3333e-3"), 120);
  EXPECT_EQ(rate_of_frame_time("1"), 1);
}

TEST(FrameRate, OfTextsThatFitSeveralIsACustomaryOne) {
  EXPECT_EQ(rate_of_frame_time("0.017"), 60);   // 58 to 60 all print as 0.017
  EXPECT_EQ(rate_of_frame_time("0.008"), 125);  // exactly 1/125
}

TEST(FrameRate, IsNotSnappedWhereTheTextSaysOtherwise) {
  EXPECT_NEAR(rate_of_frame_time("0.033367"), 29.97, 1e-3);
  EXPECT_NE(rate_of_frame_time("0.033367"), 30);
  EXPECT_EQ(rate_of_frame_time("0.0083"), 120);  // as 1/120 prints
  EXPECT_NE(rate_of_frame_time("0.00834"), 120);
}

TEST(FrameRate, IsRefusedWhereItMakesNoSense) {
  for (const char* text : {"0", "-0.01", "nan", "inf", "", "fast", "0,0083333", "1e-320"})
    EXPECT_EQ(rate_of_frame_time(text), 0) << text;
}

TEST(FrameRate, GoesBackAsItWasReadWhileItIsTheSame) {
  EXPECT_EQ(frame_time_of_rate(120, ".0083333"), ".0083333");
  EXPECT_EQ(frame_time_of_rate(60, ".0083333"), "0.016666666666666666");
  for (double fps : {120.0, 60.0, 29.97, 65.05, 1000.0})
    EXPECT_DOUBLE_EQ(rate_of_frame_time(frame_time_of_rate(fps, "")), fps);
}

}  // namespace
}  // namespace kinegraph
