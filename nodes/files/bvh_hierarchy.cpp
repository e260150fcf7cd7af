#include "nodes/files/bvh_hierarchy.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "nodes/files/decimal.h"
#include "nodes/files/frame_rate.h"
#include "nodes/files/text_place.h"

namespace kinegraph {

namespace {

constexpr double largest_length = 1e9;  // in the file's unit; past it sums of squares lose all sense
constexpr std::size_t most_joints =
    100000;  // a skeleton that doubles have to follow, not an attack on memory

class Reader {
 public:
  Reader(std::string_view text, Work& work)
      : text_(text), work_(work), at_(text.data()), end_(at_ + text.size()) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;
  }

  BvhHierarchy read() {
    skip_space();
    if (!take_keyword("hierarchy"))
      fail("not-a-bvh", fmt::format("a BVH starts with HIERARCHY, here is {}", word()),
           "check the file's format");
    skip_space();
    if (!take_keyword("root")) fail("bad-hierarchy", fmt::format("ROOT expected, found {}", word()));
    read_tree();
    read_motion_lines();
    make_names_unique();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const char* code, std::string message, std::string hint = {}) {
    fail_at(text_, at_, code, std::move(message), std::move(hint));
  }
  std::string word() { return word_at(text_, at_); }

  void skip_space() {
    while (at_ < end_ && (is_blank(*at_) || is_line_end(*at_) || *at_ == '\v' || *at_ == '\f')) ++at_;
  }
  void skip_blank() { at_ = skip_blanks(at_, end_); }

  // A keyword in any case that ends at a blank, a line's end or a brace.
  bool take_keyword(std::string_view keyword) {
    if (static_cast<std::size_t>(end_ - at_) < keyword.size()) return false;
    if (lower_case({at_, keyword.size()}) != keyword) return false;
    const char* after = at_ + keyword.size();
    if (after < end_ && !is_blank(*after) && !is_line_end(*after) && *after != '{' && *after != '}' &&
        keyword.back() != ':')
      return false;
    at_ = after;
    return true;
  }

  // Up to the brace or the line's end: names may hold blanks.
  std::string take_name() {
    skip_blank();
    const char* start = at_;
    while (at_ < end_ && !is_line_end(*at_) && *at_ != '{') ++at_;
    return as_utf8(trimmed({start, static_cast<std::size_t>(at_ - start)}), not_utf8_);
  }

  void take_brace(const std::string& after) {
    skip_space();
    if (at_ == end_ || *at_ != '{')
      fail("bad-hierarchy", fmt::format("{{ expected after {}, found {}",
                                        after.size() > 60 ? shown(after) + "…" : after, word()));
    ++at_;
  }

  double take_number(const char* of) {
    skip_space();
    double value = 0;
    const char* stop = parse_decimal(at_, end_, value);
    if (!stop) fail("bad-number", fmt::format("a number of {} expected, found {}", of, word()));
    if (stop < end_ && *stop == ',')
      fail("decimal-comma", fmt::format("{} holds the decimal comma {}", of, word()),
           "write numbers with a point");
    if (stop < end_ && !is_blank(*stop) && !is_line_end(*stop) && *stop != '-' && *stop != '}')
      fail("bad-number", fmt::format("{} of {} is no number", word(), of));
    if (std::fabs(value) > largest_length)
      fail("bad-number", fmt::format("{} of {} is too large", word(), of));
    at_ = stop;
    return value;
  }

  Vec3 take_offset() {
    double x = take_number("OFFSET"), y = take_number("OFFSET"), z = take_number("OFFSET");
    return {x, y, z};
  }

  void take_channels(BvhJoint& joint) {
    const char* start = at_;
    double count = take_number("CHANNELS");
    if (count < 0 || count > 1000 || count != std::floor(count)) {
      at_ = start;
      fail("bad-channel", fmt::format("{} channels can't be", count));
    }
    for (int i = 0; i < static_cast<int>(count); ++i) {
      skip_space();
      const char* from = at_;
      while (at_ < end_ && !is_blank(*at_) && !is_line_end(*at_) && *at_ != '{' && *at_ != '}') ++at_;
      std::string channel = lower_case({from, static_cast<std::size_t>(at_ - from)});
      static const std::set<std::string> known = {"xposition", "yposition", "zposition",
                                                  "xrotation", "yrotation", "zrotation"};
      if (!known.count(channel)) {
        at_ = from;
        fail("bad-channel",
             fmt::format("{} channels are announced; the {}. is {}", static_cast<int>(count), i + 1, word()),
             "channels are Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation");
      }
      channel[0] = static_cast<char>(channel[0] - 32);
      if (channel.find("position") != std::string::npos)
        for (const auto& other : joint.channels)
          if (other == channel) {
            at_ = from;
            fail("bad-channel", fmt::format("{} stands twice in one joint", channel));
          }
      joint.channels.push_back(std::move(channel));
    }
    out_.channels += joint.channels.size();
  }

  void open_joint(int parent) {
    if (out_.names.size() >= most_joints) fail("bad-hierarchy", "over 100000 joints");
    const char* at_name = at_;
    out_.names.push_back(take_name());
    name_places_.push_back(at_name);
    out_.parents.push_back(parent);
    out_.joints.emplace_back();
    has_offset_.push_back(false);
    take_brace(out_.names.back().empty() ? "JOINT" : out_.names.back());
  }

  void read_end_site(int joint) {
    take_name();  // some programs name it
    take_brace("End Site");
    skip_space();
    Vec3 offset;
    if (take_keyword("offset")) offset = take_offset();
    skip_space();
    if (take_keyword("channels")) {  // MotionBuilder writes "CHANNELS 0" here
      if (take_number("CHANNELS") != 0) fail("bad-channel", "an End Site can't have channels");
      skip_space();
    }
    if (at_ == end_ || *at_ != '}')
      fail("bad-hierarchy", fmt::format("}} of End Site expected, found {}", word()));
    ++at_;
    out_.ends.push_back({joint, offset});
  }

  void read_tree() {
    open_joint(-1);
    int joint = 0;  // the innermost open one
    while (joint >= 0) {
      skip_space();
      if (at_ == end_)
        fail("bad-hierarchy", fmt::format("the file ends inside {}", out_.names[joint]),
             "the file is cut short");
      if (*at_ == '}') {
        if (!has_offset_[joint])
          fail("bad-hierarchy", fmt::format("joint {} has no OFFSET", out_.names[joint]));
        ++at_;
        joint = out_.parents[joint];
      } else if (take_keyword("offset")) {
        out_.joints[joint].offset = take_offset();
        has_offset_[joint] = true;
      } else if (take_keyword("channels")) {
        if (!out_.joints[joint].channels.empty())
          fail("bad-channel", fmt::format("joint {} has CHANNELS twice", out_.names[joint]));
        take_channels(out_.joints[joint]);
      } else if (take_keyword("joint")) {
        open_joint(joint);
        joint = static_cast<int>(out_.names.size()) - 1;
      } else if (take_keyword("end")) {
        skip_blank();
        if (!take_keyword("site"))
          fail("bad-hierarchy", fmt::format("End Site expected, found End {}", word()));
        read_end_site(joint);
      } else {
        fail("bad-hierarchy",
             fmt::format("OFFSET, CHANNELS, JOINT, End Site or }} expected, found {}", word()));
      }
      if (out_.names.size() % 1024 == 0) work_.check();
    }
  }

  void read_motion_lines() {
    skip_space();
    const char* here = at_;
    if (take_keyword("root")) {
      at_ = here;
      fail("several-roots", "a second ROOT begins here", "split the file: one skeleton a file");
    }
    if (!take_keyword("motion")) {
      if (at_ < end_) fail("bad-hierarchy", fmt::format("MOTION expected, found {}", word()));
      fail("no-motion-section", "there is no MOTION section", "the file is cut short");
    }
    skip_space();
    if (!take_keyword("frames:")) {
      if (!take_keyword("frames")) fail("bad-frames", fmt::format("Frames: expected, found {}", word()));
      skip_blank();
      if (at_ == end_ || *at_ != ':') fail("bad-frames", fmt::format("Frames: expected, found {}", word()));
      ++at_;
    }
    skip_blank();
    double frames = 0;
    const char* stop = parse_decimal(at_, end_, frames);
    if (!stop || frames < 0 || frames > 1e12 || frames != std::floor(frames) ||
        (stop < end_ && !is_blank(*stop) && !is_line_end(*stop)))
      fail("bad-frames", fmt::format("{} is no number of frames", word()));
    at_ = stop;
    out_.frames = static_cast<std::size_t>(frames);
    skip_space();
    bool time = take_keyword("frame");
    if (time) {
      skip_blank();
      time = take_keyword("time:");
      if (!time && take_keyword("time")) {
        skip_blank();
        time = at_ < end_ && *at_ == ':';
        at_ += time;
      }
    }
    if (!time) fail("bad-frame-time", fmt::format("Frame Time: expected, found {}", word()));
    skip_blank();
    const char* from = at_;
    while (at_ < end_ && !is_blank(*at_) && !is_line_end(*at_)) ++at_;
    out_.frame_time.assign(from, at_);
    if (rate_of_frame_time(out_.frame_time) == 0) {
      at_ = from;
      if (out_.frame_time.find(',') != std::string::npos)
        fail("decimal-comma", fmt::format("Frame Time holds the decimal comma {}", word()),
             "write numbers with a point");
      fail("bad-frame-time", fmt::format("a Frame Time of {} gives no frame rate", word()),
           "it is the seconds from one frame to the next: 0.0083333 for 120 a second");
    }
    skip_blank();
    if (at_ < end_ && !is_line_end(*at_))
      fail("bad-frame-time", fmt::format("{} after the Frame Time", word()),
           "the numbers begin on the next line");
    if (at_ < end_ && *at_ == '\r') ++at_;
    if (at_ < end_ && *at_ == '\n') ++at_;
    out_.numbers = at_;
  }

  void make_names_unique() {
    std::set<std::string> taken(out_.names.begin(), out_.names.end());
    std::set<std::string> seen;
    std::map<std::string, int> next;  // number of a base's next double
    constexpr std::size_t told_one_by_one = 10;
    std::size_t changed = 0;
    for (std::size_t j = 0; j < out_.names.size(); ++j) {
      std::string& name = out_.names[j];
      bool empty = name.empty();
      if (!empty && seen.insert(name).second) continue;
      const std::string base = empty ? "joint" : name;
      int& number = next.try_emplace(base, 1).first->second;
      std::string unique;
      do unique = fmt::format("{}_{}", base, ++number);
      while (taken.count(unique));
      if (++changed <= told_one_by_one)
        work_.report(warning(empty ? "empty-name" : "duplicate-joint",
                             empty ? fmt::format("a joint without a name is called {}", unique)
                                   : fmt::format("a second joint {} is called {}", name, unique))
                         .in_file({}, place_in(text_, name_places_[j])));
      name = unique;
      taken.insert(unique);
      seen.insert(unique);
    }
    if (changed > told_one_by_one)
      work_.report(warning(
          "duplicate-joint",
          fmt::format("{} more joints without a name of their own got one so", changed - told_one_by_one)));
    if (not_utf8_) work_.report(warning("not-utf8", "joint names that aren't UTF-8 are taken as Latin-1"));
  }

  std::string_view text_;
  Work& work_;
  const char* at_;
  const char* end_;
  BvhHierarchy out_;
  std::vector<bool> has_offset_;
  std::vector<const char*> name_places_;
  bool not_utf8_ = false;
};

}  // namespace

BvhHierarchy read_bvh_hierarchy(std::string_view text, Work& work) {
  return Reader(text, work).read();
}

}  // namespace kinegraph
