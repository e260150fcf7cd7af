#include "gui/viewer/motion_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinegraph {
namespace {

QVector3D vector_of(const ShownMotion::Point3& p) {
  return QVector3D(p.x, p.y, p.z);
}

QRgb mixed(const QColor& from, const QColor& to, double share) {
  const auto part = [&](int a, int b) { return static_cast<int>(std::lround(a + (b - a) * share)); };
  return qRgb(part(from.red(), to.red()), part(from.green(), to.green()), part(from.blue(), to.blue()));
}

QRgb side_color(ShownMotion::Side side, const SceneLooks& looks, const Theme& theme) {
  const QColor plain = side == ShownMotion::Side::left    ? theme.left
                       : side == ShownMotion::Side::right ? theme.right
                                                          : theme.bone;
  return looks.tint.isValid() ? mixed(looks.tint, plain, 0.2) : plain.rgb();
}

// Of how much longer or shorter a link is than at rest; a tenth is full colour. Sides pale before it: what
// is stretched is told by hue.
QRgb stretched_color(QRgb side, float stretch, const Theme& theme) {
  constexpr double full = 0.1, paled = 0.02;
  const double much = std::clamp((static_cast<double>(stretch) - 1) / full, -1.0, 1.0);
  const double pale = std::clamp(std::abs(static_cast<double>(stretch) - 1) / paled, 0.0, 1.0);
  const QColor ground = QColor::fromRgb(mixed(QColor::fromRgb(side), theme.bone, 0.9 * pale));
  return mixed(ground, much > 0 ? theme.stretch_long : theme.stretch_short, std::pow(std::abs(much), 0.8));
}

SceneFigure figure_of(const ShownMotion& motion, int frame, const SceneLooks& looks, const Theme& theme) {
  SceneFigure figure;
  figure.opacity = looks.opacity;
  const auto at = [&](int point) { return vector_of(motion.at(frame, point)) + looks.shift; };
  const QRgb joint_color = looks.tint.isValid() ? mixed(looks.tint, theme.joint, 0.4) : theme.joint.rgb();
  for (std::size_t i = 0; i < motion.bones.size(); ++i) {
    const ShownMotion::Bone& bone = motion.bones[i];
    const QVector3D from = at(bone.from), to = at(bone.to);
    if (std::isnan(from.x()) || std::isnan(to.x())) continue;
    // Lines between markers stand back behind them.
    QRgb color = motion.markers ? mixed(QColor::fromRgb(joint_color), theme.ground, 0.45)
                                : side_color(bone.side, looks, theme);
    QRgb ball = joint_color;
    if (looks.stretch && !motion.stretch.empty()) {
      const float stretch = motion.stretch[static_cast<std::size_t>(frame) * motion.bones.size() + i];
      color = stretched_color(color, stretch, theme);
      // The balls of a chain of many joints would cut its colour to pieces.
      if (std::abs(stretch - 1) >= ShownMotion::least_stretch)
        ball = mixed(QColor::fromRgb(joint_color), QColor::fromRgb(color),
                     std::min(0.85, 20.0 * std::abs(static_cast<double>(stretch) - 1)));
    }
    const bool tip = bone.joint < 0;
    if (bone.beyond > 0) {
      const QVector3D way = (to - from).normalized();
      if (way.isNull()) continue;
      const float round = 0.88f * bone.radius;
      figure.capsules.push_back(
          {to + 0.7f * round * way, to + (bone.beyond - bone.radius) * way, round, bone.radius, color});
      continue;
    }
    if (bone.head) {
      const QVector3D way = to - from;
      const float inside = std::min(0.3f * way.length(), 0.8f * bone.radius);
      figure.capsules.push_back(
          {from + 0.3f * way, to - inside * way.normalized(), 0.88f * bone.radius, bone.radius, color});
      continue;
    }
    figure.capsules.push_back({from, to, bone.radius, bone.radius * (tip ? 0.8f : 0.68f), color});
    if (!motion.markers && !tip) {
      // A joint is a ball a little thicker than the bones that meet in it.
      figure.capsules.push_back({to, to, bone.radius * 0.98f, bone.radius * 0.98f, ball});
    }
  }
  if (motion.markers) {
    const float radius = static_cast<float>(std::clamp(motion.size * 0.012, 0.002, 0.05));
    for (int point = 0; point < motion.points; ++point) {
      const QVector3D p = at(point);
      if (!std::isnan(p.x()))
        figure.capsules.push_back({p, p, radius, radius, side_color(ShownMotion::Side::left, looks, theme)});
    }
  }
  return figure;
}

// Points that move most are at the ends: hands, feet and head, and the root.
std::vector<int> trailed_points(const ShownMotion& motion) {
  std::vector<int> all;
  if (motion.markers) {
    for (int point = 0; point < motion.points; point += std::max(1, motion.points / 8)) all.push_back(point);
    return all;
  }
  all.push_back(0);
  for (const char* name : {"LeftHand", "RightHand", "LeftToeBase", "RightToeBase", "Head", "lhand", "rhand",
                           "ltoes", "rtoes", "head"})
    for (std::size_t i = 0; i < motion.names.size(); ++i)
      if (motion.names[i] == name) all.push_back(static_cast<int>(i));
  if (all.size() > 1) return all;
  for (const ShownMotion::Bone& bone : motion.bones)
    if (bone.joint < 0) all.push_back(bone.to);
  return all;
}

void add_trails(Scene& scene, const ShownMotion& motion, int frame, const SceneLooks& looks,
                const Theme& theme) {
  const int back = std::max(2, static_cast<int>(motion.fps * 1.5)), step = std::max(1, back / 90);
  for (int point : trailed_points(motion)) {
    ScenePath path;
    path.width = static_cast<float>(0.009 * motion.size);
    path.color = point == 0 ? theme.accent.rgb()
                            : side_color(motion.sides[static_cast<std::size_t>(point)], looks, theme);
    ScenePath ahead = path;
    ahead.width *= 0.6f;
    ahead.strength = 0.45f;
    const auto add = [&](ScenePath& to, int t) {
      const QVector3D at = vector_of(motion.at(t, point)) + looks.shift;
      if (!std::isnan(at.x())) to.points.push_back(at);
    };
    for (int t = std::max(0, frame - back); t <= frame; t += step) add(path, t);
    for (int t = std::min(motion.frames - 1, frame + back); t >= frame; t -= step) add(ahead, t);
    scene.paths.push_back(std::move(path));
    scene.paths.push_back(std::move(ahead));
  }
}

void add_ghosts(Scene& scene, const ShownMotion& motion, int frame, const SceneLooks& looks,
                const Theme& theme) {
  constexpr int most = 24;
  std::vector<int> frames;
  for (int t = frame % looks.ghosts; t < motion.frames; t += looks.ghosts)
    if (t != frame) frames.push_back(t);
  std::sort(frames.begin(), frames.end(),
            [&](int a, int b) { return std::abs(a - frame) < std::abs(b - frame); });
  if (frames.size() > most) frames.resize(most);
  for (int t : frames) {
    SceneLooks ghost = looks;
    ghost.opacity = 0.22f * looks.opacity;
    ghost.stretch = false;
    SceneFigure figure = figure_of(motion, t, ghost, theme);
    figure.shadow = false;
    scene.figures.push_back(std::move(figure));
  }
}

// Where a point of a foot is: known exactly where it is one of those that were looked for, else its joint.
ShownMotion::Point3 spot_of(const ShownMotion& motion, const FootPoint& point, std::size_t frame) {
  const auto& known = motion.contacts.points;
  for (std::size_t i = 0; i < known.size() && i < motion.contact_spots.size(); ++i)
    if (known[i].joint == point.joint && known[i].left == point.left && known[i].part == point.part)
      return motion.contact_spots[i][frame];
  const float none = std::numeric_limits<float>::quiet_NaN();
  if (point.joint < 0 || point.joint >= motion.points) return {none, none, none};
  return motion.at(static_cast<int>(frame), point.joint);
}

void add_contacts(Scene& scene, const ShownMotion& motion, int frame, const SceneLooks& looks,
                  const Theme& theme) {
  const Contacts& contacts = looks.contacts_of ? *looks.contacts_of : motion.contacts;
  const std::size_t now = static_cast<std::size_t>(frame);
  for (const FootPoint& point : contacts.points) {
    if (now >= point.planted.size() || !point.planted[now]) continue;
    const QVector3D at = vector_of(spot_of(motion, point, now)) + looks.shift;
    if (std::isnan(at.x())) continue;
    QColor color = point.left ? theme.left : theme.right;
    color = theme.dark ? color.lighter(112) : color.darker(112);
    const float radius = static_cast<float>((point.part == "heel" ? 0.042 : 0.05) * motion.size);
    scene.marks.push_back({QVector3D(at.x(), scene.floor, at.z()), radius, color.rgb()});
  }
}

}  // namespace

void add_motion(Scene& scene, const ShownMotion& motion, double seconds, const SceneLooks& looks,
                const Theme& theme, ValuePtr character) {
  const int frame = motion.frame_at(seconds);
  scene.floor = scene.figures.empty() ? static_cast<float>(motion.floor)
                                      : std::min(scene.floor, static_cast<float>(motion.floor));
  if (scene.figures.empty()) {
    // Lines a metre apart, or powers of ten nearer or farther for small and for large things.
    const double power = std::log10(motion.size) - (motion.size > 1 ? 0.7 : 0);
    scene.grid = motion.size > 0.5 && motion.size < 5
                     ? 1.0f
                     : static_cast<float>(std::pow(10.0, std::ceil(power) - (motion.size > 1 ? 0 : 1)));
  }
  SceneFigure figure = figure_of(motion, frame, looks, theme);
  if (character) {
    figure.character = std::move(character);
    figure.motion = motion.value;
    figure.frame = static_cast<std::size_t>(frame);
    figure.mesh_color = looks.tint.isValid() ? looks.tint.rgb() : theme.skin.rgb();
    figure.capsules.clear();
  }
  scene.figures.push_back(std::move(figure));
  if (looks.contacts) add_contacts(scene, motion, frame, looks, theme);
  if (looks.trails) add_trails(scene, motion, frame, looks, theme);
  if (looks.ghosts > 0) add_ghosts(scene, motion, frame, looks, theme);
}

SceneColors colors_of(const Theme& theme) {
  return {theme.sky.rgb(), theme.ground.rgb(), theme.ground_line.rgb(), theme.shadow.rgba()};
}

QColor color_of_shown(const Theme& theme, std::size_t index) {
  const QColor colors[] = {theme.accent,
                           theme.second,
                           theme.warning,
                           theme.missing,
                           theme.port("Contacts"),
                           theme.error,
                           theme.port("Character"),
                           theme.port("Metrics"),
                           theme.port("Components")};
  return colors[index % std::size(colors)];
}

SceneBox box_of(const ShownMotion& motion) {
  return {vector_of(motion.low), vector_of(motion.high)};
}

SceneBox box_at(const ShownMotion& motion, int frame) {
  SceneBox box;
  bool first = true;
  for (int point = 0; point < motion.points; ++point) {
    const QVector3D p = vector_of(motion.at(frame, point));
    if (std::isnan(p.x())) continue;
    if (first) box = {p, p};
    first = false;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  return box;
}

QVector3D ground_under(const ShownMotion& motion, int frame) {
  const ShownMotion::Point3 root = motion.root(frame);
  return QVector3D(root.x, static_cast<float>(motion.floor), root.z);
}

}  // namespace kinegraph
