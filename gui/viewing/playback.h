// The clock of the editor: which moment of the clip is looked at, and how it moves while playing. Time is
// taken from a steady clock, never counted in pictures: where the machine can't draw them all, pictures are
// left out and the clip keeps its speed. Everything that shows a moment follows moved().
#pragma once
#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

namespace kinegraph {

class Playback : public QObject {
  Q_OBJECT

 public:
  explicit Playback(QObject* parent = nullptr);

  // The clip whose frames are counted: frames a second and how many. The moment is kept where it still lies
  // in the clip. Motions of another rate beside it are shown at the same time in seconds.
  void set_clip(double fps, int frames);
  double fps() const { return fps_; }
  int frames() const { return frames_; }

  double time() const { return time_; }  // s from frame 0
  int frame() const;                     // of the clip, 0 where there is none
  void set_time(double seconds);         // clamped to the clip
  void set_frame(int frame);

  bool is_playing() const { return playing_; }
  void play();  // from the start of the range where the moment is at its end
  void pause();
  void toggle();
  bool loops() const { return loops_; }
  void set_loops(bool loops);
  double speed() const { return speed_; }  // 1 = as recorded; negative plays backwards; never 0
  void set_speed(double speed);

  // The part that is played: frames [in, out). The whole clip by default.
  int in() const { return in_; }
  int out() const { return out_; }
  void set_range(int in, int out);
  void clear_range();
  bool has_range() const { return in_ > 0 || out_ < frames_; }

  void step(int frames);  // pauses
  void to_start();
  void to_end();

 signals:
  void moved();          // time() is new
  void state_changed();  // playing, loops, speed, range
  void clip_changed();   // fps, frames

 private:
  void tick();
  void restart_clock();
  double last_moment() const;  // of the range
  double first_moment() const;

  double fps_ = 120;
  int frames_ = 0, in_ = 0, out_ = 0;
  double time_ = 0, speed_ = 1;
  bool playing_ = false, loops_ = true;
  double started_at_ = 0;  // time_ when the clock was started
  QElapsedTimer clock_;
  QTimer timer_;
};

}  // namespace kinegraph
