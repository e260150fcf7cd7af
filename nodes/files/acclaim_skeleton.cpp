#include "nodes/files/acclaim_skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "nodes/files/decimal.h"
#include "nodes/files/text_place.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

constexpr double largest_length = 1e9;
constexpr std::size_t most_bones = 100000;

// Lines without comments, cut into words.
struct Words {
  std::vector<std::string_view> words;
  const char* start = nullptr;
  std::string key() const { return words.empty() ? "" : lower_case(words[0]); }
};

class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
  }
  std::string_view text() const { return text_; }

  // The next line with something on it; empty words at the end.
  Words next() {
    while (at_ < text_.size()) {
      std::size_t end = text_.find_first_of("\n\r", at_);
      if (end == std::string_view::npos) end = text_.size();
      std::string_view line = text_.substr(at_, end - at_);
      at_ = end + 1;
      if (auto comment = line.find('#'); comment != std::string_view::npos) line = line.substr(0, comment);
      Words words = cut(line);
      if (!words.words.empty()) return words;
    }
    Words none;
    none.start = text_.data() + text_.size();
    return none;
  }
  void put_back(const Words& words) { at_ = static_cast<std::size_t>(words.start - text_.data()); }

 private:
  static Words cut(std::string_view line) {
    Words words;
    std::size_t at = 0;
    while (at < line.size()) {
      while (at < line.size() && (is_blank(line[at]) || line[at] == '(' || line[at] == ')')) ++at;
      std::size_t from = at;
      while (at < line.size() && !is_blank(line[at]) && line[at] != '(' && line[at] != ')') ++at;
      if (at > from) words.words.push_back(line.substr(from, at - from));
    }
    words.start = words.words.empty() ? nullptr : words.words[0].data();
    return words;
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

struct RawBone {
  std::string name;
  const char* place = nullptr;
  std::optional<Vec3> direction;
  std::optional<double> length;
  Vec3 axis;
  std::string axis_order = "XYZ";
  std::vector<std::string> dof;
};

class Reader {
 public:
  Reader(std::string_view text, Work& work) : lines_(text), work_(work) {}

  AcclaimSkeleton read() {
    Words line = lines_.next();
    if (line.key().empty() || line.key()[0] != ':')
      fail(line.start, "not-an-asf",
           fmt::format("an .asf starts with a section like :version, here is {}",
                       word_at(lines_.text(), line.start)));
    bool has_root = false;
    for (; !line.words.empty(); line = lines_.next()) {
      work_.check();
      const std::string section = line.key();
      if (section == ":units") {
        read_units();
      } else if (section == ":root") {
        read_root();
        has_root = true;
      } else if (section == ":bonedata") {
        read_bones();
      } else if (section == ":hierarchy") {
        read_hierarchy();
      }
    }
    if (!has_root) fail(line.start, "bad-asf", "there is no :root section");
    return build();
  }

 private:
  [[noreturn]] void fail(const char* at, const char* code, std::string message, std::string hint = {}) {
    fail_at(lines_.text(), at, code, std::move(message), std::move(hint));
  }

  double number(const Words& line, std::size_t i) {
    double value = 0;
    const char* at =
        i < line.words.size() ? line.words[i].data() : line.words.back().data() + line.words.back().size();
    if (i >= line.words.size()) fail(at, "bad-asf", fmt::format("{} needs {} numbers", line.words[0], i));
    if (!whole_number_text(line.words[i], value) || std::fabs(value) > largest_length)
      fail(at, "bad-asf", fmt::format("{} is no number of {}", word_at(lines_.text(), at), line.words[0]));
    return value;
  }
  Vec3 three(const Words& line) { return {number(line, 1), number(line, 2), number(line, 3)}; }

  std::string axis_order(const Words& line, std::size_t i) {
    if (i >= line.words.size()) return "XYZ";
    std::string order;
    for (char c : lower_case(line.words[i])) order += static_cast<char>(c - 32);
    std::string sorted = order;
    std::sort(sorted.begin(), sorted.end());
    if (sorted != "XYZ")
      fail(line.words[i].data(), "bad-asf", fmt::format("{} is no order of axes", line.words[i]),
           "such as XYZ");
    return order;
  }

  std::vector<std::string> dof_words(const Words& line) {
    static const std::array<std::string_view, 7> known = {"rx", "ry", "rz", "tx", "ty", "tz", "l"};
    std::vector<std::string> dof;
    for (std::size_t i = 1; i < line.words.size(); ++i) {
      dof.push_back(lower_case(line.words[i]));
      if (std::find(known.begin(), known.end(), dof.back()) == known.end() ||
          std::find(dof.begin(), dof.end() - 1, dof.back()) != dof.end() - 1)
        fail(line.words[i].data(), "bad-asf", fmt::format("{} is no degree of freedom here", line.words[i]),
             "rx, ry, rz, tx, ty, tz or l, each once");
    }
    return dof;
  }

  bool section_goes_on(Words& line) {
    line = lines_.next();
    if (line.words.empty()) return false;
    if (line.key()[0] != ':') return true;
    lines_.put_back(line);
    return false;
  }

  void read_units() {
    for (Words line; section_goes_on(line);) {
      if (line.key() == "length") {
        double length = number(line, 1);
        if (!(length > 1e-9)) fail(line.words[1].data(), "bad-asf", "a unit length must be over 0");
        out_.metres = 0.0254 / length;
      } else if (line.key() == "angle" && line.words.size() > 1) {
        out_.degrees = lower_case(line.words[1]).substr(0, 3) != "rad";
      }
    }
  }

  void read_root() {
    RawBone root;
    root.name = "root";
    root.length = 0;
    root.direction = Vec3{};
    for (Words line; section_goes_on(line);) {
      root.place = line.start;
      if (line.key() == "order") root.dof = dof_words(line);
      if (line.key() == "axis") root.axis_order = axis_order(line, 1);
      if (line.key() == "position") out_.root_position = three(line);
      if (line.key() == "orientation") root.axis = three(line);
    }
    if (root.dof.empty()) root.dof = {"tx", "ty", "tz", "rx", "ry", "rz"};
    raw_["root"] = std::move(root);
  }

  void read_bones() {
    RawBone bone;
    bool open = false;
    for (Words line; section_goes_on(line);) {
      const std::string key = line.key();
      if (key == "begin") {
        bone = {};
        bone.place = line.start;
        open = true;
      } else if (key == "end") {
        if (!open) fail(line.start, "bad-asf", "end without begin");
        open = false;
        close_bone(std::move(bone));
        bone = {};
      } else if (key == "name" && line.words.size() > 1) {
        bool changed = false;
        bone.name = as_utf8(line.words[1], changed);
      } else if (key == "direction") {
        bone.direction = three(line);
      } else if (key == "length") {
        bone.length = number(line, 1);
      } else if (key == "axis") {
        bone.axis = three(line);
        bone.axis_order = axis_order(line, 4);
      } else if (key == "dof") {
        bone.dof = dof_words(line);
      }
    }
    if (open) fail(bone.place, "bad-asf", "a begin without its end");
  }

  void close_bone(RawBone bone) {
    if (raw_.size() > most_bones) fail(bone.place, "bad-asf", "over 100000 bones");
    if (bone.name.empty()) fail(bone.place, "bad-asf", "a bone without a name");
    if (!bone.direction) fail(bone.place, "bad-asf", fmt::format("bone {} has no direction", bone.name));
    if (!bone.length) fail(bone.place, "bad-asf", fmt::format("bone {} has no length", bone.name));
    std::string name = bone.name;
    const char* place = bone.place;
    if (!raw_.emplace(name, std::move(bone)).second)
      fail(place, "bad-asf", fmt::format("bone {} stands there twice", name));
  }

  void read_hierarchy() {
    for (Words line; section_goes_on(line);) {
      if (line.key() == "begin" || line.key() == "end") continue;
      for (std::size_t i = 1; i < line.words.size(); ++i) links_.push_back({line.words[0], line.words[i]});
    }
  }

  const RawBone& bone_named(std::string_view name) {
    auto found = raw_.find(name);
    if (found != raw_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [key, bone] : raw_) names.push_back(key);
    std::string near = nearest(name, names);
    fail(name.data(), "bad-asf", fmt::format("the hierarchy names {}, which is no bone", name),
         near.empty() ? "" : "did you mean " + near + "?");
  }

  AcclaimSkeleton build() {
    std::map<std::string, int, std::less<>> index = {{"root", 0}};
    add(raw_["root"], -1);
    for (const auto& [parent, child] : links_) {
      bone_named(parent);
      const RawBone& bone = bone_named(child);
      auto known = index.find(parent);
      if (known == index.end())
        fail(parent.data(), "bad-asf", fmt::format("{} gets children before it has a parent", parent));
      if (!index.emplace(child, static_cast<int>(out_.bones.size())).second)
        fail(child.data(), "bad-asf", fmt::format("{} has a second parent", child));
      add(bone, known->second);
    }
    for (const auto& [name, bone] : raw_)
      if (!index.count(name))
        fail(bone.place, "bad-asf", fmt::format("bone {} is not in the hierarchy", name));
    return std::move(out_);
  }

  void add(const RawBone& raw, int parent) {
    AcclaimBone bone;
    bone.name = raw.name;
    bone.parent = parent;
    const double size = norm(*raw.direction);
    bone.tip = size > 0 ? (*raw.length / size) * *raw.direction : Vec3{};
    bone.dof = raw.dof;
    // "XYZ": about X first, then Y, then Z, so that C = Rz Ry Rx.
    const std::string axes(raw.axis_order.rbegin(), raw.axis_order.rend());
    double radians[3];
    for (int i = 0; i < 3; ++i)
      radians[i] = raw.axis[axes[i] - 'X'] / (out_.degrees ? degrees_per_radian : 1);
    bone.axis = normalized(from_euler(axes, radians));
    out_.bones.push_back(std::move(bone));
  }

  Lines lines_;
  Work& work_;
  AcclaimSkeleton out_;
  std::map<std::string, RawBone, std::less<>> raw_;
  std::vector<std::pair<std::string_view, std::string_view>> links_;
};

}  // namespace

AcclaimSkeleton read_asf(std::string_view text, Work& work) {
  return Reader(text, work).read();
}

}  // namespace kinegraph
