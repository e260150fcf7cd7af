// Frame times as text files spell them, rounded as they are.
#pragma once
#include <string>
#include <string_view>

namespace kinegraph {

// Frames per second of a frame time's text. An integer exactly when that integer's period, printed with the
// text's number of decimals, is the text's number (".0083333" is 120); else 1 / time. Of several such
// integers the one whose period is the text exactly, else a customary one, else the nearest. 0 when the text
// is no number above 0.
double rate_of_frame_time(std::string_view text);
// The frame time to write for a rate: `as_read` while it still means that rate, else the shortest text of 1 /
// fps.
std::string frame_time_of_rate(double fps, std::string_view as_read);

}  // namespace kinegraph
