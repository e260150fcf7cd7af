#include "nodes/files/points_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "nodes/files/decimal.h"
#include "nodes/files/json_fields.h"
#include "nodes/files/points_units.h"
#include "nodes/files/reserve_like.h"
#include "nodes/files/text_lines.h"
#include "nodes/files/text_place.h"

namespace kinegraph {

namespace {

// The cells of a line; quotes may hold separators.
std::vector<std::string> table_cells(std::string_view line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"') {
        cells.back() += c;
        ++i;
      } else {
        quoted = !quoted;
      }
    } else if (c == separator && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

struct Columns {
  std::vector<std::string> labels;
  std::vector<std::array<std::size_t, 3>> of_label;
  std::optional<std::size_t> frame, time;
  std::size_t count = 0;
  bool ours = true;  // columns are spelled as Export does
  char separator = ',';
};

char separator_of(std::string_view header) {
  for (char c : {',', ';', '\t'})
    if (header.find(c) != std::string_view::npos) return c;
  return ',';
}

Columns read_columns(std::string_view text, std::string_view header) {
  Columns columns;
  columns.separator = separator_of(header);
  const std::vector<std::string> cells = table_cells(header, columns.separator);
  columns.count = cells.size();
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    bool changed = false;
    const std::string cell = as_utf8(trimmed(cells[i]), changed), lower = lower_case(cell);
    if (lower == "frame" || lower == "frame#") {
      columns.frame = i;
      continue;
    }
    if (lower == "time") {
      columns.time = i;
      continue;
    }
    const char axis = lower.empty() ? ' ' : lower.back();
    const char mark = lower.size() < 3 ? ' ' : lower[lower.size() - 2];
    if (axis < 'x' || axis > 'z' || (mark != '.' && mark != '_' && mark != ' ' && mark != ':'))
      fail_at(text, header.data(), "bad-header",
              fmt::format("column {} is {}, none of frame, time, NAME.x, NAME.y, NAME.z", i + 1, shown(cell)),
              "points are tables with three columns a point");
    columns.ours &= mark == '.';
    const std::string label = cell.substr(0, cell.size() - 2);
    auto [at, added] = known.emplace(label, columns.labels.size());
    if (added) {
      columns.labels.push_back(label);
      columns.of_label.push_back({none, none, none});
    }
    std::size_t& column = columns.of_label[at->second][static_cast<std::size_t>(axis - 'x')];
    if (column != none)
      fail_at(text, header.data(), "bad-header", fmt::format("the column {} comes twice", cell));
    column = i;
  }
  for (std::size_t i = 0; i < columns.labels.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (columns.of_label[i][axis] == none)
        fail_at(text, header.data(), "bad-header",
                fmt::format("{} has no column {}", columns.labels[i], "xyz"[axis]));
  if (columns.labels.empty()) fail_at(text, header.data(), "bad-header", "the table has no points");
  return columns;
}

int decimals_of(std::string_view word) {
  const std::size_t dot = word.find('.');
  if (word.find_first_of("eE") != std::string_view::npos) return 17;
  return dot == std::string_view::npos ? 0 : static_cast<int>(word.size() - dot - 1);
}

}  // namespace

Points read_points_table(std::string_view text, const ReadOptions& options, Work& work) {
  TextLines lines(text);
  std::string_view header;
  while (!lines.at_end() && trimmed(header).empty()) header = lines.next();
  if (trimmed(header).empty()) fail_at(text, text.data(), "bad-header", "the file is empty");
  Columns columns = read_columns(text, header);
  std::vector<double> times;
  int decimals = 0;
  std::size_t rows = 0, frames = 0;
  for (TextLines ahead = lines; !ahead.at_end();) {
    frames += !trimmed(ahead.next()).empty();
    if (frames % 256 == 0) work.check();
  }
  frames = std::min(frames, text.size() / columns.count + 1);  // a row has a byte a cell
  make_labels_unique(columns.labels, work);
  Points points(columns.labels, options.rate, frames);
  while (!lines.at_end()) {
    const std::string_view line = lines.next();
    if (trimmed(line).empty()) continue;
    const std::vector<std::string_view> cells = cells_of(line, columns.separator);
    if (cells.size() != columns.count)
      fail_at(text, cells.size() < columns.count ? line.data() + line.size() : cells[columns.count].data(),
              cells.size() < columns.count ? "too-few-values" : "too-many-values",
              fmt::format("the row has {} cells, the header {}", cells.size(), columns.count),
              "the file is cut short or damaged there");
    std::vector<double> row(cells.size());
    std::vector<bool> empty(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string_view cell = trimmed(cells[i]);
      empty[i] = cell.empty() || lower_case(cell) == "nan";
      if (!empty[i] && (!whole_number_text(cell, row[i]) || !std::isfinite(row[i])))
        fail_no_number(text, cell);
    }
    if (columns.time) {
      const std::string_view cell = trimmed(cells[*columns.time]);
      if (empty[*columns.time]) fail_at(text, line.data(), "bad-times", "the row has no time");
      times.push_back(row[*columns.time]);
      decimals = std::max(decimals, decimals_of(cell));
    }
    for (int label = 0; label < static_cast<int>(columns.of_label.size()); ++label) {
      const auto& of = columns.of_label[static_cast<std::size_t>(label)];
      if (empty[of[0]] || empty[of[1]] || empty[of[2]]) {
        points.set_missing(label, rows);
      } else {
        points.track(label).set(rows, {row[of[0]], row[of[1]], row[of[2]]});
      }
    }
    if (++rows % 16 == 0) work.check();
  }
  if (times.size() >= 2) {
    points.fps = rate_of_times(times, decimals);
    if (points.fps <= 0)
      throw Failure(error("bad-times", "the times don't rise evenly from row to row")
                        .hinting("resample the table, or leave out the column time and set rate"));
  }
  if (!columns.ours && !names_a_unit(options.unit))
    work.report(warning("unit-unknown", "a table doesn't tell its unit; it is taken as metres")
                    .hinting("tell it by Load's unit or convert's --unit"));
  return settled(std::move(points), unit_of_metres(1), UpAxis::y, options, work);
}

std::string write_points_table(const Points& points, Work& work) {
  std::string out = "frame,time";
  for (const std::string& label : points.labels)
    for (const char* axis : {".x", ".y", ".z"}) out += ',' + csv_cell(label + axis);
  out += '\n';
  for (std::size_t t = 0; t < points.frames; ++t) {
    if (t % 16 == 0) work.check();
    if (t == 64) reserve_like(out, t, points.frames);
    out += fmt::format("{},", t);
    append_shortest(out, static_cast<double>(t) / points.fps);
    for (int label = 0; label < static_cast<int>(points.labels.size()); ++label)
      for (int axis = 0; axis < 3; ++axis) {
        out += ',';
        if (!points.is_missing(label, t)) append_shortest(out, points.track(label)[t][axis]);
      }
    out += '\n';
  }
  return out;
}

}  // namespace kinegraph
