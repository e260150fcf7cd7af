#include "nodes/time/segment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "nodes/time/features.h"

namespace kinegraph {
namespace {

constexpr double first_window = 2.0;   // s: Barbič's k, 240 frames at 120
constexpr double growth_window = 0.5;  // s: his l, 60 frames
constexpr double kept_spread = 0.95;
constexpr double usual_sigmas = 3;
constexpr double samples_per_second = 30;  // how often the plane is fitted
constexpr double stillness = 1e-4;         // rad² of growth that is no change of behaviour

// The spread of poses [start, now) about their mean, as it grows.
class Scatter {
 public:
  explicit Scatter(Eigen::Index dims)
      : sum_(Eigen::VectorXd::Zero(dims)), squares_(Eigen::MatrixXd::Zero(dims, dims)) {}
  void add(const Eigen::VectorXd& pose) {
    sum_ += pose;
    squares_.selfadjointView<Eigen::Lower>().rankUpdate(pose);
    ++count_;
  }
  // Sums of squares along the principal axes, smallest first.
  Eigen::VectorXd along_axes() const {
    Eigen::MatrixXd scatter = squares_;
    scatter.selfadjointView<Eigen::Lower>().rankUpdate(sum_, -1.0 / static_cast<double>(count_));
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scatter, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .cwiseMax(0);
  }

 private:
  Eigen::VectorXd sum_;
  Eigen::MatrixXd squares_;
  std::size_t count_ = 0;
};

Eigen::MatrixXd moving_dims(const Series& v) {
  std::vector<std::size_t> moving;
  for (std::size_t d = 0; d < v.dims; ++d)
    if (std::any_of(v.dim(d).begin(), v.dim(d).end(), [](double x) { return std::abs(x) > 1e-9; }))
      moving.push_back(d);
  Eigen::MatrixXd poses(static_cast<Eigen::Index>(moving.size()), static_cast<Eigen::Index>(v.frames));
  for (std::size_t d = 0; d < moving.size(); ++d)
    for (std::size_t f = 0; f < v.frames; ++f)
      poses(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(f)) = v.at(moving[d], f);
  return poses;
}

class Cutter {
 public:
  Cutter(const Eigen::MatrixXd& poses, double fps, double sensitivity, Work& work)
      : poses_(poses),
        frames_(static_cast<std::size_t>(poses.cols())),
        sigmas_(usual_sigmas / sensitivity),
        work_(work) {
    const auto frames_in = [&](double seconds) {
      return static_cast<std::size_t>(std::lround(seconds * fps));
    };
    step_ = std::max<std::size_t>(1, frames_in(1 / samples_per_second));
    least_ = std::max(frames_in(first_window), 2 * step_);
    lag_ = std::max<std::size_t>(1, frames_in(growth_window) / step_);
  }

  // Where the behaviour that begins at `start` ends, if it does.
  std::optional<std::size_t> next_cut(std::size_t start) {
    if (start + 2 * least_ > frames_) return {};
    Scatter scatter(poses_.rows());
    std::size_t now = start;
    for (; now < start + least_; ++now) scatter.add(pose(now));
    const Eigen::Index dims = dims_of(scatter.along_axes());
    std::vector<double> error, growth;  // one a sample, from the first window on
    std::vector<std::size_t> at;
    double sum = 0, squares = 0;
    for (;;) {
      work_.check();
      work_.progress(static_cast<double>(now) / static_cast<double>(frames_));
      const Eigen::VectorXd axes = scatter.along_axes();
      error.push_back(axes.head(axes.size() - dims).sum());
      at.push_back(now);
      if (error.size() > lag_) {
        const double grown = error.back() - error[error.size() - 1 - lag_];
        const auto count = static_cast<double>(growth.size());
        const double mean = growth.empty() ? 0 : sum / count;
        const double deviation = growth.empty() ? 0 : std::sqrt(std::max(0.0, squares / count - mean * mean));
        // A mean needs half a second of growth before it says what is usual.
        if (growth.size() >= lag_ && grown > mean + sigmas_ * deviation && grown > 1.5 * mean + stillness) {
          std::size_t rise = growth.size();
          while (rise > 0 && growth[rise - 1] > mean) --rise;
          const std::size_t cut = at[std::min(rise + lag_, at.size() - 1)];
          return std::clamp(cut, start + least_, frames_ - least_);
        }
        growth.push_back(grown);
        sum += grown;
        squares += grown * grown;
      }
      if (now + step_ > frames_) return {};
      for (std::size_t i = 0; i < step_; ++i) scatter.add(pose(now++));
    }
  }

 private:
  Eigen::VectorXd pose(std::size_t frame) const { return poses_.col(static_cast<Eigen::Index>(frame)); }

  static Eigen::Index dims_of(const Eigen::VectorXd& axes) {
    const double whole = axes.sum();
    double kept = 0;
    Eigen::Index dims = 0;
    while (dims < axes.size() && kept < kept_spread * whole) kept += axes(axes.size() - 1 - dims++);
    return dims;
  }

  const Eigen::MatrixXd& poses_;
  std::size_t frames_;
  double sigmas_;
  Work& work_;
  std::size_t step_, least_, lag_;
};

}  // namespace

std::vector<Piece> behaviour_pieces(const Motion& motion, double sensitivity, Work& work) {
  std::vector<Piece> pieces;
  std::size_t start = 0;
  if (motion.frames() > 0) {
    const Eigen::MatrixXd poses = moving_dims(rotation_vectors(motion, encode_root(motion, work), work).v);
    Cutter cutter(poses, motion.fps(), sensitivity, work);
    while (poses.rows() > 0) {
      const std::optional<std::size_t> cut = cutter.next_cut(start);
      if (!cut) break;
      pieces.push_back({start, *cut});
      start = *cut;
    }
  }
  pieces.push_back({start, motion.frames()});
  return pieces;
}

Motion piece_of(const Motion& motion, const Piece& piece) {
  Motion out = motion.empty_like(piece.end - piece.start);
  const auto copy = [&](std::span<const double> from, std::span<double> to) {
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(piece.start),
              from.begin() + static_cast<std::ptrdiff_t>(piece.end), to.begin());
  };
  for (int j = 0; j < motion.joints(); ++j) {
    const ConstQuatTrack from = motion.rotation(j);
    const QuatTrack to = out.rotation(j);
    copy(from.x, to.x);
    copy(from.y, to.y);
    copy(from.z, to.z);
    copy(from.w, to.w);
    if (!motion.translates(j)) continue;
    const ConstVec3Track offset = motion.translation(j);
    const Vec3Track track = out.translation(j);
    copy(offset.x, track.x);
    copy(offset.y, track.y);
    copy(offset.z, track.z);
  }
  if (motion.source().read) {
    auto facts = std::make_shared<SourceFacts>(motion.source());
    if (facts->read_frames == motion.frames()) {
      facts->first_read += piece.start;
      facts->read_frames = out.frames();
    } else {
      facts->read.reset();
      facts->read_frames = 0;
    }
    out.set_source(facts);
  }
  return out;
}

}  // namespace kinegraph
