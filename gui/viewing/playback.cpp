#include "gui/viewing/playback.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {
namespace {
constexpr int tick_ms = 8;  // finer than a screen's pictures; ticks that find the same frame say nothing
}

Playback::Playback(QObject* parent) : QObject(parent) {
  timer_.setTimerType(Qt::PreciseTimer);
  timer_.setInterval(tick_ms);
  connect(&timer_, &QTimer::timeout, this, &Playback::tick);
}

void Playback::set_clip(double fps, int frames) {
  if (!(fps > 0)) fps = 120;
  frames = std::max(frames, 0);
  if (fps == fps_ && frames == frames_) return;
  const bool whole = !has_range();
  fps_ = fps;
  frames_ = frames;
  if (whole || in_ >= frames_) {
    in_ = 0;
    out_ = frames_;
  }
  out_ = std::min(out_, frames_);
  const double before = time_;
  time_ = std::clamp(time_, 0.0, std::max(0, frames_ - 1) / fps_);
  restart_clock();
  if (frames_ == 0 && playing_) pause();
  emit clip_changed();
  if (time_ != before) emit moved();
}

int Playback::frame() const {
  // Half a millionth: so that the time of a frame, k / fps, is that frame after rounding.
  const int frame = static_cast<int>(std::floor(time_ * fps_ + 1e-6));
  return std::clamp(frame, 0, std::max(0, frames_ - 1));
}

void Playback::set_time(double seconds) {
  const double clamped = std::clamp(seconds, 0.0, std::max(0, frames_ - 1) / fps_);
  if (clamped == time_) return;
  time_ = clamped;
  restart_clock();
  emit moved();
}

void Playback::set_frame(int frame) {
  set_time(frame / fps_);
}

double Playback::first_moment() const {
  return in_ / fps_;
}

double Playback::last_moment() const {
  return std::max(in_, out_ - 1) / fps_;
}

void Playback::play() {
  if (playing_ || frames_ < 2) return;
  const bool at_end = speed_ > 0 ? time_ >= last_moment() : time_ <= first_moment();
  const bool outside = time_ < first_moment() || time_ > last_moment();
  if (at_end || outside) set_time(speed_ > 0 ? first_moment() : last_moment());
  playing_ = true;
  restart_clock();
  timer_.start();
  emit state_changed();
}

void Playback::pause() {
  if (!playing_) return;
  playing_ = false;
  timer_.stop();
  // A paused clip rests on a frame, not between two.
  time_ = frame() / fps_;
  emit state_changed();
  emit moved();
}

void Playback::toggle() {
  playing_ ? pause() : play();
}

void Playback::set_loops(bool loops) {
  if (loops == loops_) return;
  loops_ = loops;
  emit state_changed();
}

void Playback::set_speed(double speed) {
  if (speed == speed_ || speed == 0 || !std::isfinite(speed)) return;
  speed_ = speed;
  restart_clock();
  emit state_changed();
}

void Playback::set_range(int in, int out) {
  in = std::clamp(in, 0, std::max(0, frames_ - 1));
  out = std::clamp(out, std::min(in + 1, frames_), frames_);
  if (in == in_ && out == out_) return;
  in_ = in;
  out_ = out;
  emit state_changed();
}

void Playback::clear_range() {
  set_range(0, frames_);
}

void Playback::step(int frames) {
  pause();
  set_frame(frame() + frames);
}

void Playback::to_start() {
  set_frame(frame() > in_ ? in_ : 0);
}

void Playback::to_end() {
  set_frame(frame() < out_ - 1 ? out_ - 1 : frames_ - 1);
}

void Playback::restart_clock() {
  started_at_ = time_;
  clock_.start();
}

void Playback::tick() {
  double now = started_at_ + speed_ * static_cast<double>(clock_.nsecsElapsed()) * 1e-9;
  const double first = first_moment(), last = last_moment();
  const double length = last - first + 1 / fps_;  // the last frame is held for its time as well
  bool ended = false;
  if (now >= first + length || now < first) {
    if (loops_) {
      now = first + std::fmod(now - first, length);
      if (now < first) now += length;
      started_at_ = now;
      clock_.start();
    } else {
      now = speed_ > 0 ? last : first;
      ended = true;
    }
  }
  const int before = frame();
  time_ = std::clamp(now, 0.0, std::max(0, frames_ - 1) / fps_);
  if (ended)
    pause();
  else if (frame() != before)
    emit moved();
}

}  // namespace kinegraph
