#include "nodes/files/bvh_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nodes/files/bvh_channels.h"
#include "nodes/files/decimal.h"
#include "nodes/files/frame_rate.h"
#include "nodes/files/stretch.h"
#include "nodes/files/text_place.h"

namespace kinegraph {

namespace {

// Depth in tabs, as far as an eye follows; a chain of ten thousand joints would be all tabs.
std::string tabs_of(std::size_t depth) {
  return std::string(std::min<std::size_t>(depth, 64), '\t');
}

void append_offset(std::string& out, Vec3 offset) {
  out += "OFFSET ";
  append_shortest(out, offset.x);
  out += ' ';
  append_shortest(out, offset.y);
  out += ' ';
  append_shortest(out, offset.z);
  out += '\n';
}

std::string name_for_bvh(const std::string& name, Work& work) {
  std::string written(trimmed(name));
  for (char& c : written)
    if (c == '{' || c == '}' || static_cast<unsigned char>(c) < 0x20) c = '_';
  if (written.empty()) written = "_";
  if (written != name)
    work.report(warning("renamed-joint", fmt::format("{} is written as {}", name, written)).at_joint(name));
  return written;
}

void append_hierarchy(std::string& out, const BvhLayout& layout, Work& work) {
  std::vector<std::vector<int>> children(layout.joints.size());
  for (std::size_t j = 1; j < layout.joints.size(); ++j)
    children[layout.joints[j].parent].push_back(static_cast<int>(j));
  // Depth first without recursion: a chain may be as long as memory.
  struct Open {
    int joint;
    std::size_t next_child;
  };
  std::vector<Open> open;
  auto begin = [&](int j) {
    const BvhLayout::Joint& joint = layout.joints[j];
    const std::string tabs = tabs_of(open.size());
    out += tabs + (j == 0 ? "ROOT " : "JOINT ") + name_for_bvh(joint.name, work) + '\n' + tabs + "{\n" +
           tabs + '\t';
    append_offset(out, joint.offset);
    out += fmt::format("{}\tCHANNELS {}", tabs, joint.channels.size());
    for (const BvhChannel& channel : joint.channels) out += ' ' + channel.name;
    out += '\n';
    open.push_back({j, 0});
  };
  out += "HIERARCHY\n";
  begin(0);
  while (!open.empty()) {
    Open& top = open.back();
    if (top.next_child < children[top.joint].size()) {
      begin(children[top.joint][top.next_child++]);
      continue;
    }
    const std::string tabs = tabs_of(open.size());
    for (Vec3 end : layout.joints[top.joint].ends) {
      out += tabs + "End Site\n" + tabs + "{\n" + tabs + '\t';
      append_offset(out, end);
      out += tabs + "}\n";
    }
    open.pop_back();
    out += tabs_of(open.size()) + "}\n";
  }
}

void append_numbers(std::string& out, const BvhLayout& layout, std::size_t frames, int decimals, Work& work) {
  std::vector<const double*> channels;
  for (const auto& joint : layout.joints)
    for (const BvhChannel& channel : joint.channels) channels.push_back(channel.values.data());
  const std::size_t count = channels.size();
  // Series are gathered into rows a block at a time, so that memory is read along time.
  constexpr std::size_t most_rows = 64;
  const std::size_t rows =
      std::clamp<std::size_t>((64 << 10) / 8 / std::max<std::size_t>(count, 1), 8, most_rows);
  std::vector<double> block(rows * count);
  std::vector<char> line(count * fixed_room + 2);
  for (std::size_t first = 0; first < frames; first += rows) {
    const std::size_t last = std::min(first + rows, frames);
    for (std::size_t c = 0; c < count; ++c)
      for (std::size_t t = first; t < last; ++t) block[(t - first) * count + c] = channels[c][t];
    for (std::size_t t = first; t < last; ++t) {
      char* at = line.data();
      const double* values = block.data() + (t - first) * count;
      for (std::size_t c = 0; c < count; ++c) {
        if (c) *at++ = ' ';
        at = write_fixed(at, values[c], decimals);
      }
      *at++ = '\n';
      out.append(line.data(), at);
    }
    work.progress(static_cast<double>(last) / static_cast<double>(frames));
  }
}

}  // namespace

std::string write_bvh(const Motion& given, const WriteOptions& options, Work& work) {
  if (auto bad = given.non_finite()) {
    Diagnostic problem =
        error("not-finite", fmt::format("a {} of the motion is not a finite number", bad->what));
    problem.joint = bad->joint;
    problem.frame = bad->frame;
    throw Failure(problem);
  }
  if (given.joints() == 0)
    throw Failure(error("no-joints", "a motion without joints can't be a BVH").at_port("motion"));
  const bool keeps = options.stretch == "keep";
  const Motion without = keeps ? Motion() : without_stretch(given, options.stretch, work);
  const Motion& motion = keeps ? given : without;
  const SourceFacts& facts = motion.source();
  const LengthUnit unit = unit_from_param(options.unit, unit_of_metres(facts.unit));
  const BvhLayout layout = bvh_layout(motion, options, unit, work);
  std::string out;
  std::size_t channels = 0;
  for (const auto& joint : layout.joints) channels += joint.channels.size();
  const auto digits = static_cast<std::size_t>(options.precision);
  auto memory = work.reserve(motion.frames() * channels * (digits + 5));
  out.reserve(4096 + motion.frames() * channels * (digits + 5));
  append_hierarchy(out, layout, work);
  out += fmt::format("MOTION\nFrames: {}\nFrame Time: {}\n", motion.frames(),
                     frame_time_of_rate(motion.fps(), facts.frame_time_text));
  append_numbers(out, layout, motion.frames(), options.precision, work);
  return out;
}

}  // namespace kinegraph
