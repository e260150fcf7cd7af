#include "nodes/components/component_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "nodes/components/alignment.h"
#include "nodes/components/held_frames.h"
#include "nodes/components/rebuild.h"
#include "nodes/components/substitution.h"
#include "nodes/node_params.h"
#include "nodes/time/displacement.h"
#include "nodes/time/lowpass.h"

namespace kinegraph {
namespace {

constexpr double longest_hold = 0.25;  // s; a clip that rests for longer isn't held by a warp

// Values of a series at other times, linear.
double value_at(const std::vector<double>& series, double time) {
  const auto low = std::min(static_cast<std::size_t>(std::max(time, 0.0)), series.size() - 1);
  const auto high = std::min(low + 1, series.size() - 1);
  return series[low] + (time - static_cast<double>(low)) * (series[high] - series[low]);
}

// Position i of `count` spread over `length` of them, first on first and last on last.
double spread(std::size_t i, std::size_t count, std::size_t length) {
  if (count < 2) return 0;
  return static_cast<double>(i) * static_cast<double>(length - 1) / static_cast<double>(count - 1);
}

// The segment while it is edited.
class Editing {
 public:
  Editing(const Components& components, std::size_t segment, const ComponentEditParams& params,
          const ComponentEditInputs& inputs, Work& work)
      : now_(components), segment_(segment), params_(params), inputs_(inputs), work_(work) {
    u_ = signals_of(now_, base());
    added_ = base().added;
    cutoff_ = params_.lowpass *
              own_share_of_frames(u_, static_cast<std::size_t>(std::ceil(longest_hold * now_.fps)));
  }

  void at(std::size_t index) { where_ = fmt::format("edits[{}]", index); }

  void operator()(const edits::Scale& edit) {
    for (const ComponentTerm& term : terms(edit.component)) {
      double* u = u_.row(term.index);
      for (std::size_t t = 0; t < frames(); ++t) u[t] *= edit.factor;
    }
  }

  void operator()(const edits::Merge& edit) {
    if (edit.name.empty() || component_ref(Json(edit.name)).component > 0)
      throw fail("bad-edit", "name", fmt::format("'{}' is no name for a group", edit.name),
                 "give it a name that is not a component's");
    for (const ComponentGroup& group : now_.groups)
      if (group.name == edit.name)
        throw fail("name-taken", "name", fmt::format("there is a group '{}' already", edit.name),
                   "choose another name");
    if (edit.terms.empty())
      throw fail("bad-edit", "terms", "a group of nothing", "name the components that it holds");
    ComponentGroup group{edit.name, {}};
    std::set<std::size_t> seen;
    for (std::size_t i = 0; i < edit.terms.size(); ++i) {
      const auto& [ref, factor] = edit.terms[i];
      for (const ComponentTerm& term :
           terms_of(ref, now_.count(), now_.groups, field(fmt::format("terms[{}]", i)))) {
        if (!seen.insert(term.index).second)
          throw fail("bad-edit", fmt::format("terms[{}]", i),
                     fmt::format("u{} is in the group twice", term.index + 1), "name each component once");
        group.terms.emplace_back(static_cast<int>(term.index + 1), factor * term.weight);
        for (std::size_t t = 0; t < frames(); ++t) u_(term.index, t) *= factor;
        for (std::size_t t = 0; t < now_.frames(); ++t)
          now_.signals(term.index, t) *= factor;  // in every segment
      }
    }
    now_.groups.push_back(std::move(group));
  }

  void operator()(const edits::Translate& edit) {
    for (const ComponentTerm& term : terms(edit.component))
      for (std::size_t t = 0; t < frames(); ++t) u_(term.index, t) += term.weight * edit.value;
  }

  void operator()(const edits::Replace& edit) {
    const Frames to = checked_range(edit.frames, frames(), field("frames"));
    const Frames by = checked_range(edit.by_frames, frames(), field("by_frames"));
    const std::size_t count = to.end - to.start, length = by.end - by.start;
    const auto weight = window(to, edit.fade);
    for (const ComponentTerm& term : terms(edit.component)) {
      const std::vector<double> source(u_.row(term.index) + by.start, u_.row(term.index) + by.end);
      std::vector<double> change(frames());
      for (std::size_t i = 0; i < count; ++i) {
        const double wanted = edit.repeat ? source[i % length] : value_at(source, spread(i, count, length));
        change[to.start + i] = weight[to.start + i] * (wanted - u_(term.index, to.start + i));
      }
      change = smoothed(change);
      for (std::size_t t = 0; t < frames(); ++t) u_(term.index, t) += change[t];
    }
  }

  void operator()(const edits::CopyAdd& edit) {
    if (!inputs_.other)
      throw Failure(error("no-input", "this edit needs the input `other`")
                        .at_port("other")
                        .at_param(where_)
                        .hinting("link other Components"));
    const Components& other = *inputs_.other;
    if (other.space.representation != now_.space.representation ||
        other.space.channel_names() != now_.space.channel_names())
      throw Failure(
          error("wrong-channels", "the other components are of other channels")
              .at_port("other")
              .at_param(where_)
              .hinting("decompose both with the same `representation` and the same joints or points"));
    const ComponentSegment& source = segment_of(other, edit.segment, field("segment"));
    const auto range = checked_range(edit.frames, frames(), field("frames"));
    const auto weight = window(range, fade_seconds());
    Rows& added = make_added();
    for (const ComponentTerm& term :
         terms_of(edit.component, other.count(), other.groups, field("component"))) {
      const double* row = other.signals.row(term.index);
      const std::vector<double> v(row + source.start, row + source.end);
      for (std::size_t t = range.start; t < range.end; ++t) {
        const double value = weight[t] * edit.factor * value_at(v, spread(t, frames(), v.size()));
        for (std::size_t d = 0; d < added.rows; ++d) added(d, t) += value * other.mixing(d, term.index);
      }
    }
  }

  void operator()(const edits::Transfer& edit) {
    if (edit.from == edit.to)
      throw fail("bad-edit", "from", "a segment can't give to itself", "name two segments");
    const ComponentSegment& giver = segment_of(now_, edit.from, field("from"));
    const Rows given = signals_of(now_, giver);
    const Correspondence path = aligned_segments(now_, base(), giver, edit.align, field("align"), work_);
    const ClockMaps maps = clock_maps(path, frames(), giver.frames(), now_.fps, cutoff_);
    Rows b = given;
    if (edit.keep_timing_of_from)
      change_clock(maps.a_of_b);
    else
      b = smoothed(at_times(given, maps.b_of_a));
    const auto weight = window(checked_range(edit.frames, frames(), field("frames")), fade_seconds());
    std::set<std::size_t> entries;
    for (std::size_t i = 0; i < edit.components.size(); ++i)
      for (const ComponentTerm& term :
           terms_of(edit.components[i], now_.count(), now_.groups, field(fmt::format("components[{}]", i))))
        entries.insert(term.index);
    for (std::size_t i : entries)
      for (std::size_t t = 0; t < frames(); ++t) u_(i, t) += edit.amount * weight[t] * (b(i, t) - u_(i, t));
  }

  void operator()(const edits::Substitute& edit) {
    std::vector<std::size_t> entries;
    for (const ComponentTerm& term : terms(edit.component)) entries.push_back(term.index);
    const Rows change = substitution(now_, base(), u_, entries, inputs_, where_, work_);
    Rows& added = make_added();
    for (std::size_t i = 0; i < added.data.size(); ++i) added.data[i] += change.data[i];
  }

  void operator()(const edits::Warp& edit) {
    const auto all = terms(edit.component);
    double square = 0;
    for (const ComponentTerm& term : all) square += term.weight * term.weight;
    if (edit.keys.empty() || square == 0) return;
    std::map<std::size_t, Vec3> knots;
    for (std::size_t k = 0; k < edit.keys.size(); ++k) {
      const auto& [frame, value] = edit.keys[k];
      if (frame < 0 || static_cast<std::size_t>(frame) >= frames())
        throw fail("bad-frame", fmt::format("keys[{}]", k),
                   fmt::format("frame {} is outside the segment", frame),
                   fmt::format("it has {} frames", frames()));
      const auto at = static_cast<std::size_t>(frame);
      if (knots.count(at))
        throw fail("bad-edit", fmt::format("keys[{}]", k), fmt::format("frame {} has a key already", frame),
                   "keep one of the two");
      double present = 0;  // along the group's direction
      for (const ComponentTerm& term : all) present += term.weight * u_(term.index, at) / square;
      knots[at] = {value - present, 0, 0};
    }
    const auto curve = displacement_curve(knots, frames());
    for (const ComponentTerm& term : all)
      for (std::size_t t = 0; t < frames(); ++t) u_(term.index, t) += term.weight * curve[t].x;
  }

  ComponentEditResult finish() {
    ComponentEditResult out;
    out.channels = channels_from_signals(now_, u_);
    for (std::size_t i = 0; i < added_.data.size(); ++i) out.channels.data[i] += added_.data[i];
    if (params_.residual) {
      const Rows x = channels_of_segment(now_, base(), work_);
      const Rows kept = channels_from_signals(now_, signals_from_channels(now_, x));
      for (std::size_t i = 0; i < x.data.size(); ++i) out.channels.data[i] += x.data[i] - kept.data[i];
    }
    store();
    now_.segments[segment_].added = std::move(added_);
    out.components = std::move(now_);
    out.segment = segment_;
    return out;
  }

 private:
  const ComponentSegment& base() const { return now_.segments[segment_]; }
  std::size_t frames() const { return u_.columns; }
  std::string field(std::string_view name) const { return fmt::format("{}.{}", where_, name); }
  Failure fail(const char* code, std::string_view at_field, std::string message, std::string hint) const {
    return Failure(error(code, std::move(message)).at_param(field(at_field)).hinting(std::move(hint)));
  }
  std::vector<ComponentTerm> terms(const ComponentRef& ref) const {
    return terms_of(ref, now_.count(), now_.groups, field("component"));
  }
  Rows& make_added() {
    if (added_.data.empty()) added_ = Rows(now_.mixing.rows, frames());
    return added_;
  }

  double fade_seconds() const { return params_.lowpass > 0 ? 1 / params_.lowpass : 0; }
  std::vector<double> smoothed(const std::vector<double>& series) const {
    return cutoff_ > 0 && series.size() > 1 ? lowpass(series, now_.fps, cutoff_) : series;
  }
  Rows smoothed(Rows rows) const {
    for (std::size_t i = 0; i < rows.rows; ++i) {
      const auto row = smoothed(std::vector<double>(rows.row(i), rows.row(i) + rows.columns));
      std::copy(row.begin(), row.end(), rows.row(i));
    }
    return rows;
  }
  // 1 inside, 0 outside; fading over `seconds` inside, but not at the segment's own ends.
  std::vector<double> window(const Frames& range, double seconds) const {
    std::vector<double> weight(frames());
    const double length = std::min(seconds * now_.fps, static_cast<double>(range.end - range.start) / 2);
    for (std::size_t t = range.start; t < range.end; ++t) {
      double x = 1;
      if (range.start > 0 && length > 0)
        x = std::min(x, (static_cast<double>(t - range.start) + 1) / (length + 1));
      if (range.end < frames() && length > 0)
        x = std::min(x, static_cast<double>(range.end - t) / (length + 1));
      weight[t] = x * x * (3 - 2 * x);
    }
    return weight;
  }

  // Puts u_ back into the whole, whose segments after this one move when its length changed.
  void store() {
    ComponentSegment& segment = now_.segments[segment_];
    Rows joined(now_.count(), now_.frames() - segment.frames() + frames());
    for (std::size_t i = 0; i < joined.rows; ++i) {
      const double* before = now_.signals.row(i);
      double* row = joined.row(i);
      row = std::copy(before, before + segment.start, row);
      row = std::copy(u_.row(i), u_.row(i) + frames(), row);
      std::copy(before + segment.end, before + now_.frames(), row);
    }
    const std::size_t end = segment.start + frames(), old_end = segment.end;
    segment.end = end;
    for (ComponentSegment& other : now_.segments) {
      if (other.start < old_end || &other == &segment) continue;
      other.start = other.start + end - old_end;
      other.end = other.end + end - old_end;
    }
    now_.signals = std::move(joined);
  }

  // The base, its signals and what was added are laid on another clock: frame t shows the time `times[t]`.
  void change_clock(const std::vector<double>& times) {
    u_ = smoothed(at_times(u_, times));
    if (!added_.data.empty()) added_ = smoothed(at_times(added_, times));
    store();
    ComponentSegment& segment = now_.segments[segment_];
    if (segment.motion) segment.motion = std::make_shared<const Motion>(at_times(*segment.motion, times));
    if (segment.points) segment.points = std::make_shared<const Points>(at_times(*segment.points, times));
  }

  Components now_;
  std::size_t segment_;
  const ComponentEditParams& params_;
  const ComponentEditInputs& inputs_;
  Work& work_;
  std::string where_;
  Rows u_, added_;
  double cutoff_ = 0;  // Hz on the segment's clock: `lowpass` in the time of the frames that are its own
};

// The segment that is edited: `segment`, else the one that the transfers give to, else the first.
std::size_t edited_segment(const Components& components, const ComponentEditParams& params) {
  std::optional<std::int64_t> wanted = params.segment;
  for (std::size_t i = 0; i < params.edits.size(); ++i) {
    const auto* transfer = std::get_if<edits::Transfer>(&params.edits[i]);
    if (!transfer) continue;
    if (wanted && *wanted != transfer->to)
      throw Failure(error("bad-edit", fmt::format("this edit gives to segment {}, but segment {} is edited",
                                                  transfer->to, *wanted))
                        .at_param(fmt::format("edits[{}].to", i))
                        .hinting("leave `segment` open, and put edits of another segment in a further node"));
    wanted = transfer->to;
    segment_of(components, *wanted, fmt::format("edits[{}].to", i));
  }
  segment_of(components, wanted.value_or(0), "segment");
  return static_cast<std::size_t>(wanted.value_or(0));
}

}  // namespace

ComponentEditResult edit_components(const Components& components, const ComponentEditParams& params,
                                    const ComponentEditInputs& inputs, Work& work) {
  Editing editing(components, edited_segment(components, params), params, inputs, work);
  for (std::size_t i = 0; i < params.edits.size(); ++i) {
    work.check();
    editing.at(i);
    std::visit(editing, params.edits[i]);
  }
  return editing.finish();
}

}  // namespace kinegraph
