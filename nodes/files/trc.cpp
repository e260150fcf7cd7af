#include "nodes/files/trc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nodes/files/decimal.h"
#include "nodes/files/points_units.h"
#include "nodes/files/reserve_like.h"
#include "nodes/files/text_lines.h"
#include "nodes/files/text_place.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// Words between tabs, or between blanks where a line has no tab.
std::vector<std::string_view> words_of(std::string_view line) {
  if (line.find('\t') != std::string_view::npos) return cells_of(line, '\t');
  std::vector<std::string_view> words;
  for (std::string_view word : cells_of(line, ' '))
    if (!trimmed(word).empty()) words.push_back(word);
  return words;
}

struct Header {
  double rate = 0;
  std::size_t frames = 0;
  std::size_t markers = 0;
  std::string_view unit;
};

Header read_header(TextLines& lines) {
  auto end_of_file = [&]() -> std::string_view {
    fail_at(lines.text(), lines.here(), "truncated", "the file ends within the header",
            "a TRC has five lines of header");
  };
  auto next = [&] { return lines.at_end() ? end_of_file() : lines.next(); };
  const std::string_view first = next();
  if (lower_case(trimmed(first)).compare(0, 12, "pathfiletype") != 0)
    fail_at(lines.text(), first.data(), "bad-header", "the first line doesn't begin with PathFileType",
            "check that this is a TRC");
  const std::vector<std::string_view> keys = words_of(next());
  const std::string_view values_line = next();
  const std::vector<std::string_view> values = words_of(values_line);
  Header header;
  auto value_of = [&](std::string_view key) {
    for (std::size_t i = 0; i < keys.size() && i < values.size(); ++i)
      if (lower_case(trimmed(keys[i])) == key) return trimmed(values[i]);
    fail_at(lines.text(), values_line.data(), "bad-header",
            fmt::format("the header has no value for {}", key),
            "a TRC's second line names what its third line says");
  };
  auto number = [&](std::string_view key, double most) {
    const std::string_view word = value_of(key);
    double value = 0;
    if (!whole_number_text(word, value) || value < 0 || value > most)
      fail_at(lines.text(), word.data(), "bad-header",
              fmt::format("{} is {}", key, word_at(lines.text(), word.data())));
    return value;
  };
  header.rate = number("datarate", 1e6);
  header.frames = static_cast<std::size_t>(number("numframes", 1e9));
  header.markers = static_cast<std::size_t>(number("nummarkers", 1e6));
  header.unit = value_of("units");
  return header;
}

std::vector<std::string> read_labels(TextLines& lines, const Header& header) {
  const char* at = lines.here();
  if (lines.at_end()) fail_at(lines.text(), at, "truncated", "the file ends before the markers' names");
  std::vector<std::string> labels;
  std::size_t column = 0;
  bool changed = false;
  for (std::string_view word : words_of(lines.next()))
    if (column++ >= 2 && !trimmed(word).empty()) labels.push_back(as_utf8(trimmed(word), changed));
  if (labels.size() != header.markers)
    fail_at(lines.text(), at, "bad-header",
            fmt::format("{} markers are named, NumMarkers is {}", labels.size(), header.markers));
  return labels;
}

struct Rows {
  std::vector<double> times;
  int decimals = 0;  // most digits after the point of a time
};

std::size_t lines_left(TextLines lines, Work& work) {
  std::size_t count = 0;
  for (; !lines.at_end(); ++count) {
    if (count % 256 == 0) work.check();
    lines.next();
  }
  return count;
}

// A cell's number; false where it is empty or NaN.
bool read_cell(std::string_view text, std::string_view cell, double& value) {
  cell = trimmed(cell);
  if (cell.empty() || lower_case(cell) == "nan") return false;
  if (!whole_number_text(cell, value) || !std::isfinite(value)) fail_no_number(text, cell);
  return true;
}

// Into `points`, as far as that has frames.
Rows read_rows(TextLines& lines, const Header& header, Points& points, Work& work) {
  Rows rows;
  double place[3] = {};
  const std::size_t wanted = 3 * header.markers;
  while (!lines.at_end()) {
    const std::string_view line = lines.next();
    if (trimmed(line).empty()) continue;
    const std::vector<std::string_view> cells = words_of(line);
    double frame = 0, time = 0;
    if (rows.times.empty() && trimmed(cells[0]).empty()) continue;  // the line X1 Y1 Z1 …
    if (!read_cell(lines.text(), cells[0], frame) || cells.size() < 2 ||
        !read_cell(lines.text(), cells[1], time))
      fail_at(lines.text(), line.data(), "bad-number", "a line begins with no frame number and time");
    const std::string_view word = trimmed(cells[1]);
    if (const std::size_t dot = word.find('.'); dot != std::string_view::npos)
      rows.decimals = std::max(rows.decimals, static_cast<int>(word.size() - dot - 1));
    rows.times.push_back(time);
    std::size_t count = cells.size() - 2;
    while (count > wanted && trimmed(cells[2 + count - 1]).empty()) --count;
    if (count != wanted)
      fail_at(lines.text(), count < wanted ? line.data() + line.size() : cells[2 + wanted].data(),
              count < wanted ? "too-few-values" : "too-many-values",
              fmt::format("frame {:g} has {} values for {} markers", frame, count, header.markers),
              "the file is cut short or damaged there");
    const std::size_t t = rows.times.size() - 1;
    for (std::size_t i = 0; i < wanted; i += 3) {
      bool missing = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
        missing |= !read_cell(lines.text(), cells[2 + i + axis], place[axis]);
      if (t >= points.frames) continue;
      const int label = static_cast<int>(i / 3);
      if (missing) {
        points.set_missing(label, t);
      } else {
        points.track(label).set(t, {place[0], place[1], place[2]});
      }
    }
    if (rows.times.size() % 16 == 0) work.check();
  }
  if (rows.times.size() != header.frames)
    fail_at(lines.text(), lines.here(), rows.times.size() < header.frames ? "truncated" : "too-many-frames",
            fmt::format("NumFrames is {}, the file has {} frames", header.frames, rows.times.size()),
            "check whether the file is whole");
  return rows;
}

double rate_of(const Header& header, const Rows& rows, Work& work) {
  const double told = rows.times.size() < 2 ? 0 : rate_of_times(rows.times, rows.decimals);
  if (header.rate <= 0 && told <= 0)
    throw Failure(error("bad-header", "neither DataRate nor the times tell a frame rate")
                      .hinting("write DataRate into the file's third line"));
  if (told <= 0 || (header.rate > 0 && std::fabs(told / header.rate - 1) < 0.01)) return header.rate;
  // Times that were rounded coarsely mean DataRate where it fits them.
  const double steps = static_cast<double>(rows.times.size() - 1);
  const double span = rows.times.back() - rows.times.front();
  if (header.rate > 0 && std::fabs(steps / header.rate - span) <= power(10.0, -rows.decimals))
    return header.rate;
  if (header.rate > 0)
    work.report(warning("rate-differs", fmt::format("DataRate is {:g}, the times are those of {:g} frames a "
                                                    "second, which is taken",
                                                    header.rate, told)));
  return told;
}

}  // namespace

Points read_trc(std::string_view text, const ReadOptions& options, Work& work) {
  TextLines lines(text);
  const Header header = read_header(lines);
  const LengthUnit unit = unit_of_file(header.unit, options);
  std::vector<std::string> labels = read_labels(lines, header);
  make_labels_unique(labels, work);
  // No more frames than there are lines and bytes for, whatever the header says.
  const std::size_t most = std::min(lines_left(lines, work), text.size() / (3 * header.markers + 1) + 1);
  Points points(std::move(labels), 0, std::min(header.frames, most));
  const Rows rows = read_rows(lines, header, points, work);
  points.fps = rate_of(header, rows, work);
  return settled(std::move(points), unit, UpAxis::y, options, work);
}

std::string write_trc(const Points& points, std::string_view name, const WriteOptions& options, Work& work) {
  const LengthUnit unit = unit_to_write(points, options, true);
  if (points.up == UpAxis::z)
    work.report(warning("up-untold", "Z is up in the file, as in the source, and a TRC can't say so")
                    .hinting("read it with up set to z"));
  std::string rate;
  append_shortest(rate, points.fps);
  std::string out = fmt::format("PathFileType\t4\t(X/Y/Z)\t{}\n", name);
  out +=
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n";
  out += fmt::format("{0}\t{0}\t{1}\t{2}\t{3}\t{0}\t1\t{1}\n", rate, points.frames, points.labels.size(),
                     unit.name);
  out += "Frame#\tTime";
  const auto ends_cell = [](char c) { return c == '\t' || is_line_end(c); };
  for (std::string label : points.labels) {
    if (std::any_of(label.begin(), label.end(), ends_cell)) {
      std::replace_if(label.begin(), label.end(), ends_cell, ' ');
      work.report(warning("label-changed", "a TRC's labels hold no tabs and no line ends: now " + label));
    }
    out += '\t' + label + "\t\t";
  }
  out += "\n\t";
  for (std::size_t i = 1; i <= points.labels.size(); ++i) out += fmt::format("\tX{0}\tY{0}\tZ{0}", i);
  out += "\n\n";
  for (std::size_t t = 0; t < points.frames; ++t) {
    if (t % 16 == 0) work.check();
    if (t == 64) reserve_like(out, t, points.frames);
    out += fmt::format("{}\t", t + 1);
    append_fixed(out, static_cast<double>(t) / points.fps, std::max(6, options.precision));
    for (int label = 0; label < static_cast<int>(points.labels.size()); ++label) {
      if (points.is_missing(label, t)) {
        out += "\t\t\t";
        continue;
      }
      const Vec3 place = in_file(points.track(label)[t], unit, points.up);
      for (int axis = 0; axis < 3; ++axis) {
        out += '\t';
        append_fixed(out, place[axis], options.precision);
      }
    }
    out += '\n';
  }
  return out;
}

}  // namespace kinegraph
