#include "nodes/time/dynamic_time_warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

#include "nodes/time/dynamic_time_warp_kernels.h"

namespace kinegraph {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t rows_per_block =
    16;  // rows whose distances are made together: some 2 MB at 20,000 frames
constexpr std::size_t lane_round = 8;

std::size_t rounded_up(std::size_t n, std::size_t to) {
  return (n + to - 1) / to * to;
}

// Frames [first, last) that a row may show. Both ends never fall from row to row.
struct Reach {
  std::vector<std::uint32_t> first, last;
};

// What the limits alone leave open: half of all cells at max_step 3 and equal lengths.
Reach reach_of(std::size_t frames, std::size_t rows, std::size_t steps, std::size_t holds,
               std::size_t loose) {
  Reach reach{std::vector<std::uint32_t>(rows), std::vector<std::uint32_t>(rows)};
  const auto f = static_cast<std::int64_t>(frames), n = static_cast<std::int64_t>(rows);
  const auto k = static_cast<std::int64_t>(steps), h = static_cast<std::int64_t>(holds);
  const auto free = static_cast<std::int64_t>(loose);
  for (std::int64_t r = 0; r < n; ++r) {
    const std::int64_t left = n - 1 - r;
    const std::int64_t low = std::max(r / h, f - 1 - free - k * left);
    const std::int64_t high = std::min(free + k * r, f - 1 - left / h);
    reach.first[r] = static_cast<std::uint32_t>(std::max<std::int64_t>(low, 0));
    reach.last[r] = static_cast<std::uint32_t>(std::min(high, f - 1) + 1);
  }
  return reach;
}

// One code a cell in as few bits as the steps need, only for the cells that are searched.
class Codes {
 public:
  enum class Width { nibble, byte, word };
  Codes(const Reach& reach, std::size_t most)
      : width_(most <= 4    ? Width::nibble
               : most <= 16 ? Width::byte
                            : Width::word) {
    const std::size_t rows = reach.first.size();
    begin_.resize(rows);
    at_.resize(rows);
    std::size_t cells = 0;
    for (std::size_t r = 0; r < rows; ++r) {
      begin_[r] = reach.first[r] / lane_round * lane_round;
      at_[r] = cells;
      cells += rounded_up(reach.last[r], lane_round) - begin_[r];
    }
    bytes_ = width_ == Width::nibble ? cells / 2 : width_ == Width::byte ? cells : cells * 4;
  }
  std::size_t bytes() const { return bytes_; }
  int shift() const { return width_ == Width::nibble ? 2 : width_ == Width::byte ? 4 : 16; }
  bool narrow() const { return width_ != Width::word; }
  void allocate() { data_.reset(new std::uint8_t[bytes_]); }

  void store(std::size_t row, std::size_t begin, std::size_t end, const std::uint8_t* narrow,
             const std::uint32_t* wide) {
    const std::size_t at = at_[row];
    if (width_ == Width::word) {
      std::memcpy(data_.get() + at * 4, wide + begin, (end - begin) * 4);
    } else if (width_ == Width::byte) {
      std::memcpy(data_.get() + at, narrow + begin, end - begin);
    } else {
      std::uint8_t* out = data_.get() + at / 2;
      for (std::size_t f = begin; f < end; f += 8, out += 4) {
        for (std::size_t i = 0; i < 4; ++i)
          out[i] = static_cast<std::uint8_t>(narrow[f + 2 * i] | narrow[f + 2 * i + 1] << 4);
      }
    }
  }
  std::uint32_t at(std::size_t row, std::size_t frame) const {
    const std::size_t cell = at_[row] + frame - begin_[row];
    if (width_ == Width::word) {
      std::uint32_t code;
      std::memcpy(&code, data_.get() + cell * 4, 4);
      return code;
    }
    if (width_ == Width::byte) return data_[cell];
    return data_[cell / 2] >> (cell % 2 * 4) & 15u;
  }

 private:
  Width width_;
  std::vector<std::size_t> begin_, at_;
  std::size_t bytes_ = 0;
  std::unique_ptr<std::uint8_t[]> data_;
};

// Frames in tiles of 16, each dimension after dimension; what is past the end repeats 0 and is never reached.
std::vector<double> in_tiles(const Series& series, Work& work) {
  const std::size_t tiles = rounded_up(series.frames, warp_tile) / warp_tile;
  std::vector<double> packed(tiles * series.dims * warp_tile);
  for (std::size_t d = 0; d < series.dims; ++d) {
    work.check();
    const auto values = series.dim(d);
    for (std::size_t f = 0; f < series.frames; ++f)
      packed[(f / warp_tile * series.dims + d) * warp_tile + f % warp_tile] = values[f];
  }
  return packed;
}

class Search {
 public:
  Search(const Series& warped, const Series& clock, const WarpLimits& limits, Work& work)
      : clock_(clock), work_(work), frames_(warped.frames), rows_(clock.frames) {
    steps_ = std::max<std::size_t>(1, std::min(limits.max_step, frames_ - 1));
    holds_ = std::max<std::size_t>(2, std::min(limits.max_step, rows_));
    loose_ = limits.free_ends ? std::min(limits.max_step, frames_ - 1) : 0;
    tiles_ = in_tiles(warped, work);
  }
  Reach everywhere() const { return reach_of(frames_, rows_, steps_, holds_, loose_); }

  WarpPath within(const Reach& reach) {
    Codes codes(reach, std::max(steps_, holds_));
    const auto reserved = codes.bytes() > (std::size_t{16} << 20) ? work_.reserve(codes.bytes()) : nullptr;
    codes.allocate();
    const std::size_t stride = rounded_up(frames_, warp_tile);
    const std::size_t pad =
        rounded_up(steps_, lane_round);  // so that frames before the first one read as unreachable
    std::vector<double> distances(rows_per_block * stride);
    std::vector<double> block(rows_per_block * clock_.dims);
    std::vector<double> held((holds_ - 1) * stride, infinity);
    std::vector<double> before_store(pad + stride, infinity), best_store(pad + stride, infinity);
    std::vector<std::uint8_t> narrow(codes.narrow() ? stride : 0);
    std::vector<std::uint32_t> wide(codes.narrow() ? 0 : stride);
    double* before = before_store.data() + pad;
    double* best = best_store.data() + pad;

    for (std::size_t start = 0; start < rows_; start += rows_per_block) {
      work_.check();
      const std::size_t count = std::min(rows_per_block, rows_ - start);
      measure(start, count, reach, block, distances, stride);
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t r = start + i;
        const std::size_t first = reach.first[r], last = reach.last[r];
        const std::size_t begin = first / lane_round * lane_round, end = rounded_up(last, lane_round);
        double* cost = distances.data() + i * stride;
        std::fill(cost + begin, cost + first, infinity);
        std::fill(cost + last, cost + end, infinity);
        if (r == 0) {
          std::copy(cost + begin, cost + end, best + begin);
          std::copy(cost + begin, cost + end, held.data() + begin);
          std::fill(narrow.begin(), narrow.end(), std::uint8_t{0});
          std::fill(wide.begin(), wide.end(), 0u);
        } else {
          advance_row({begin, end, steps_, holds_, cost, held.data(), stride, before, best, wide.data(),
                       codes.narrow() ? narrow.data() : nullptr, codes.shift()});
        }
        codes.store(r, begin, end, narrow.data(), wide.data());
        // The next row looks back past this one's first frame: nothing can be there.
        std::fill(best + static_cast<std::ptrdiff_t>(begin) -
                      static_cast<std::ptrdiff_t>(std::min(begin + pad, pad + steps_)),
                  best + begin, infinity);
        std::swap(before, best);
      }
    }
    work_.check();
    WarpPath path = trace_back(codes, reach, before);
    work_.check();  // before hundreds of MiB of codes are let go
    return path;
  }

 private:
  void measure(std::size_t start, std::size_t count, const Reach& reach, std::vector<double>& block,
               std::vector<double>& distances, std::size_t stride) {
    const std::size_t dims = clock_.dims;
    for (std::size_t d = 0; d < dims; ++d)
      for (std::size_t i = 0; i < count; ++i) block[i * dims + d] = clock_.at(d, start + i);
    const std::size_t first = reach.first[start] / warp_tile;
    const std::size_t last = rounded_up(reach.last[start + count - 1], warp_tile) / warp_tile;
    const auto piece = [&](std::size_t begin, std::size_t end) {
      squared_distances(tiles_.data(), first + begin, first + end, dims, block.data(), count,
                        distances.data(), stride);
    };
    const std::size_t tile_work = warp_tile * count * std::max<std::size_t>(dims, 1);
    const std::size_t grain = std::max<std::size_t>(1, 1'000'000 / tile_work);
    if (last - first <= grain)
      piece(0, last - first);
    else
      work_.parallel(last - first, grain, piece);
  }

  WarpPath trace_back(const Codes& codes, const Reach& reach, const double* last_row) const {
    WarpPath path(rows_);
    std::size_t frame = reach.last[rows_ - 1] - 1;
    for (std::size_t f = frame; f-- > reach.first[rows_ - 1];)
      if (last_row[f] < last_row[frame]) frame = f;
    if (!(last_row[frame] < infinity)) throw std::logic_error("no path in the band");
    const std::uint32_t low = (1u << codes.shift()) - 1;
    std::size_t run = codes.at(rows_ - 1, frame) >> codes.shift();
    for (std::size_t r = rows_ - 1;; --r) {
      path[r] = static_cast<std::uint32_t>(frame);
      if (r == 0) return path;
      if (run > 0) {
        --run;
      } else {
        frame -= (codes.at(r, frame) & low) + 1;
        run = codes.at(r - 1, frame) >> codes.shift();
      }
    }
  }

  const Series& clock_;
  Work& work_;
  std::size_t frames_, rows_, steps_, holds_, loose_;
  std::vector<double> tiles_;
};

Reach narrowed(const Reach& open, const WarpBand& band, const std::vector<std::size_t>& radius) {
  Reach reach = open;
  const std::size_t rows = open.first.size();
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t at = band.path[r];
    const std::size_t low = at > radius[r] ? at - radius[r] : 0;
    reach.first[r] = static_cast<std::uint32_t>(std::max<std::size_t>(open.first[r], low));
    reach.last[r] = static_cast<std::uint32_t>(std::min<std::size_t>(open.last[r], at + radius[r] + 1));
  }
  for (std::size_t r = 1; r < rows; ++r) reach.last[r] = std::max(reach.last[r], reach.last[r - 1]);
  for (std::size_t r = rows - 1; r-- > 0;) reach.first[r] = std::min(reach.first[r], reach.first[r + 1]);
  return reach;
}

// Doubles the radius round every row where the path runs along an edge that the band made. False: it touches
// none.
bool widen(std::vector<std::size_t>& radius, const WarpPath& path, const Reach& open, const Reach& reach) {
  const std::size_t rows = path.size();
  std::vector<std::size_t> wider = radius;
  bool touched = false;
  for (std::size_t r = 0; r < rows; ++r) {
    const bool low = path[r] == reach.first[r] && reach.first[r] > open.first[r];
    const bool high = path[r] + 1 == reach.last[r] && reach.last[r] < open.last[r];
    if (!low && !high) continue;
    touched = true;
    const std::size_t spread = 2 * radius[r] + 1;
    for (std::size_t q = r > spread ? r - spread : 0; q < std::min(rows, r + spread + 1); ++q)
      wider[q] = std::max(wider[q], spread);
  }
  radius = std::move(wider);
  return touched;
}

}  // namespace

std::size_t least_max_step(std::size_t frames, std::size_t rows) {
  return (rows + frames - 1) / frames;
}

std::size_t default_max_step(std::size_t frames, std::size_t rows) {
  return std::max<std::size_t>(3, least_max_step(frames, rows) + 1);
}

WarpPath dynamic_time_warp(const Series& warped, const Series& clock, const WarpLimits& limits, Work& work,
                           const WarpBand* band) {
  if (warped.dims != clock.dims || warped.frames == 0 || warped.frames > clock.frames)
    throw std::logic_error(
        "dynamic_time_warp: the warped series must be the shorter one, of equal dimensions");
  const std::size_t least = least_max_step(warped.frames, clock.frames);
  if (limits.max_step < least)
    throw Failure(
        error("does-not-fit", fmt::format("{} frames can't fill {} rows when a frame is held for at most {}",
                                          warped.frames, clock.frames, limits.max_step))
            .at_param("max_step")
            .hinting(fmt::format("use max_step {} or more, or 0", least)));
  WarpPath path(clock.frames);
  if (warped.frames == 1) return path;
  if (limits.max_step == 1) {
    for (std::size_t r = 0; r < path.size(); ++r) path[r] = static_cast<std::uint32_t>(r);
    return path;
  }
  Search search(warped, clock, limits, work);
  const Reach open = search.everywhere();
  if (!band) return search.within(open);
  std::vector<std::size_t> radius(clock.frames, std::max<std::size_t>(band->radius, 1));
  for (;;) {
    const Reach reach = narrowed(open, *band, radius);
    path = search.within(reach);
    if (!widen(radius, path, open, reach)) return path;
  }
}

double path_cost(const Series& warped, const Series& clock, std::span<const std::uint32_t> path) {
  double total = 0;
  for (std::size_t d = 0; d < clock.dims; ++d) {
    const auto frames = warped.dim(d), rows = clock.dim(d);
    double sum = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double difference = frames[path[r]] - rows[r];
      sum += difference * difference;
    }
    total += sum;
  }
  return total;
}

Correspondence align(const Series& a, const Series& b, std::size_t max_step, bool free_ends, Work& work) {
  Correspondence result;
  result.a_is_clock = a.frames >= b.frames;
  const Series& clock = result.a_is_clock ? a : b;
  const Series& warped = result.a_is_clock ? b : a;
  if (max_step == 0) max_step = default_max_step(warped.frames, clock.frames);
  const WarpPath path = dynamic_time_warp(warped, clock, {max_step, free_ends}, work);
  result.pairs.reserve(path.size());
  for (std::uint32_t r = 0; r < path.size(); ++r) {
    if (result.a_is_clock)
      result.pairs.emplace_back(r, path[r]);
    else
      result.pairs.emplace_back(path[r], r);
  }
  return result;
}

}  // namespace kinegraph
