#include "gui/canvas/clear_wires.h"

#include <QLineF>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace kinegraph {
namespace {

constexpr double apart = 30;         // between the nodes of a column
constexpr double clearance = 8;      // between a wire and a node that it passes
constexpr double behind_cost = 300;  // of a wire behind a node, and 1 for each unit of it
constexpr double crossing_cost = 60;
constexpr double slope_cost = 0.35;   // for each unit of height that a wire climbs or falls
constexpr double height_cost = 0.15;  // for each unit of the whole graph's height
constexpr double work = 8e7;          // pairs of boxes compared; about a tenth of a second

struct Box {
  std::string name;
  QRectF rect;
  bool moves = false;
};

struct Wire {
  int from = 0, to = 0;
  QPointF out, in;  // relative to the nodes' top left
  QPolygonF line;
  QRectF bounds;
};

bool cross(const QPolygonF& a, const QPolygonF& b) {
  for (qsizetype i = 0; i + 1 < a.size(); ++i)
    for (qsizetype j = 0; j + 1 < b.size(); ++j)
      if (QLineF(a[i], a[i + 1]).intersects(QLineF(b[j], b[j + 1])) == QLineF::BoundedIntersection)
        return true;
  return false;
}

class Layout {
 public:
  Layout(const GraphScene& scene, const std::map<std::string, QPointF>& positions) {
    std::map<std::string, int> index;
    for (const SceneNode& node : scene.nodes()) {
      index[node.name] = int(boxes_.size());
      auto moved = positions.find(node.name);
      QRectF rect = node.rect;
      if (moved != positions.end()) rect.moveTopLeft(moved->second);
      boxes_.push_back({node.name, rect, moved != positions.end()});
    }
    for (const SceneWire& wire : scene.wires()) {
      if (wire.from == wire.to) continue;
      const SceneNode *from = scene.node(wire.from), *to = scene.node(wire.to);
      wires_.push_back({index[wire.from],
                        index[wire.to],
                        scene.port_position({wire.from, wire.from_port, false}) - from->rect.topLeft(),
                        scene.port_position({wire.to, wire.to_port, true}) - to->rect.topLeft(),
                        {},
                        {}});
    }
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      if (boxes_[i].moves) columns_[boxes_[i].rect.left()].push_back(int(i));
    for (Wire& wire : wires_) lead(wire);
    const double pairs = double(wires_.size()) * double(wires_.size() + boxes_.size()) + 1;
    tries_ = int(work / pairs);
  }

  void improve() {
    constexpr int least_tries = 400;  // with fewer nothing is gained
    if (tries_ < least_tries || wires_.empty()) return;
    cost_ = cost();
    climb();
    // Where a wire still runs behind a node, a few nodes are thrown elsewhere and all settle anew.
    auto best = tops();
    double least = cost_;
    while (tries_ > 0 && is_any_behind()) {
      shake();
      climb();
      if (cost_ < least) {
        least = cost_;
        best = tops();
      } else {
        put_back(best);
      }
    }
  }

  std::map<std::string, QPointF> positions() const {
    std::map<std::string, QPointF> found;
    for (const Box& box : boxes_)
      if (box.moves) found[box.name] = box.rect.topLeft();
    return found;
  }

 private:
  double top(int box) const { return boxes_[std::size_t(box)].rect.top(); }

  void lead(Wire& wire) const {
    const QPointF from = boxes_[std::size_t(wire.from)].rect.topLeft() + wire.out;
    const QPointF to = boxes_[std::size_t(wire.to)].rect.topLeft() + wire.in;
    wire.line = wire_curve(from, to);
    wire.bounds = wire.line.boundingRect();
  }

  void climb() {
    while (tries_ > 0) {
      const double before = cost_;
      for (auto& [x, column] : columns_) {
        std::sort(column.begin(), column.end(), [&](int a, int b) { return top(a) < top(b); });
        for (double by : {160., 80., 40., 20., 10.})
          for (double way : {-by, by})
            for (std::size_t i = 0; i < column.size(); ++i) {
              const auto here = column.begin() + std::ptrdiff_t(i);
              try_shift({column[i]}, way);
              try_shift({here, column.end()}, way);
              try_shift({column.begin(), here + 1}, way);
              try_shift(with_successors(column[i]), way);
            }
        for (std::size_t i = 0; i < column.size(); ++i)
          for (std::size_t j = i + 1; j < column.size(); ++j) try_swap(column, i, j);
        for (std::size_t i = 0; i < column.size(); ++i)
          for (std::size_t j = 0; j < column.size(); ++j)
            if (i != j) try_insert(column, i, j);
      }
      if (cost_ > before - 0.5) break;
    }
  }

  // Three nodes that can move go some hundred units up or down, where nothing lies.
  void shake() {
    for (int i = 0; i < 3; ++i) {
      chance_ = chance_ * 6364136223846793005ull + 1442695040888963407ull;  // Knuth's MMIX
      const std::size_t one = std::size_t(chance_ >> 33) % boxes_.size();
      chance_ = chance_ * 6364136223846793005ull + 1442695040888963407ull;
      const double by = double(int((chance_ >> 33) % 49) - 24) * GraphScene::step;
      if (!boxes_[one].moves) continue;
      boxes_[one].rect.translate(0, by);
      if (!lies_free({int(one)})) boxes_[one].rect.translate(0, -by);
      lead_all({int(one)});
    }
    cost_ = cost();
  }

  std::vector<double> tops() const {
    std::vector<double> all;
    for (const Box& box : boxes_) all.push_back(box.rect.top());
    return all;
  }
  void put_back(const std::vector<double>& tops) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_[i].rect.moveTop(tops[i]);
    for (Wire& wire : wires_) lead(wire);
    cost_ = cost();
  }

  bool is_any_behind() const {
    for (const Wire& wire : wires_)
      for (std::size_t b = 0; b < boxes_.size(); ++b)
        if (int(b) != wire.from && int(b) != wire.to && wire.bounds.intersects(boxes_[b].rect) &&
            length_inside(wire.line, boxes_[b].rect) > 0)
          return true;
    return false;
  }

  // The node and all that follow it, to the right.
  std::vector<int> with_successors(int box) const {
    std::vector<int> all{box};
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const Wire& wire : wires_)
        if (wire.from == all[i] && boxes_[std::size_t(wire.to)].moves &&
            std::find(all.begin(), all.end(), wire.to) == all.end())
          all.push_back(wire.to);
    return all;
  }

  double cost() const {
    double sum = 0, highest = 1e300, lowest = -1e300;
    for (const Box& box : boxes_) {
      highest = std::min(highest, box.rect.top());
      lowest = std::max(lowest, box.rect.bottom());
    }
    sum += height_cost * (lowest - highest);
    for (std::size_t i = 0; i < wires_.size(); ++i) {
      const Wire& wire = wires_[i];
      sum += slope_cost * std::abs(wire.line.last().y() - wire.line.first().y());
      for (std::size_t b = 0; b < boxes_.size(); ++b) {
        if (int(b) == wire.from || int(b) == wire.to) continue;
        const QRectF room = boxes_[b].rect.adjusted(-clearance, -clearance, clearance, clearance);
        if (wire.bounds.right() < room.left() || wire.bounds.left() > room.right() ||
            wire.bounds.bottom() < room.top() || wire.bounds.top() > room.bottom())
          continue;
        if (const double inside = length_inside(wire.line, room); inside > 0) sum += behind_cost + inside;
      }
      for (std::size_t j = i + 1; j < wires_.size(); ++j) {
        const Wire& other = wires_[j];
        if (wire.from == other.from || wire.to == other.to || wire.bounds.right() < other.bounds.left() ||
            wire.bounds.left() > other.bounds.right() || wire.bounds.bottom() < other.bounds.top() ||
            wire.bounds.top() > other.bounds.bottom())
          continue;
        if (cross(wire.line, other.line)) sum += crossing_cost;
      }
    }
    return sum;
  }

  bool lies_free(const std::vector<int>& moved) const {
    for (int one : moved) {
      const QRectF room = boxes_[std::size_t(one)].rect.adjusted(-apart / 2, 1 - apart, apart / 2, apart - 1);
      for (std::size_t b = 0; b < boxes_.size(); ++b)
        if (int(b) != one && room.intersects(boxes_[b].rect)) return false;
    }
    return true;
  }

  // Keeps the new heights where they make the picture better.
  void try_heights(const std::vector<int>& moved, const std::vector<double>& tops) {
    if (tries_-- <= 0) return;
    std::vector<double> before;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      before.push_back(top(moved[i]));
      boxes_[std::size_t(moved[i])].rect.moveTop(tops[i]);
    }
    if (lies_free(moved)) {
      lead_all(moved);
      const double after = cost();
      if (after < cost_ - 1e-6) {
        cost_ = after;
        return;
      }
    }
    for (std::size_t i = 0; i < moved.size(); ++i) boxes_[std::size_t(moved[i])].rect.moveTop(before[i]);
    lead_all(moved);
  }

  void lead_all(const std::vector<int>& moved) {
    for (Wire& wire : wires_)
      if (std::find(moved.begin(), moved.end(), wire.from) != moved.end() ||
          std::find(moved.begin(), moved.end(), wire.to) != moved.end())
        lead(wire);
  }

  void try_shift(const std::vector<int>& moved, double by) {
    std::vector<double> tops;
    for (int one : moved) tops.push_back(top(one) + by);
    try_heights(moved, tops);
  }

  // Two nodes of a column change places; those between them make room.
  void try_swap(std::vector<int>& column, std::size_t i, std::size_t j) {
    std::vector<int> order = column;
    std::swap(order[i], order[j]);
    try_order(column, order);
  }
  void try_insert(std::vector<int>& column, std::size_t from, std::size_t to) {
    std::vector<int> order = column;
    const int one = order[from];
    order.erase(order.begin() + std::ptrdiff_t(from));
    order.insert(order.begin() + std::ptrdiff_t(to), one);
    try_order(column, order);
  }
  // The gaps between the nodes stay, from the top down.
  void try_order(std::vector<int>& column, const std::vector<int>& order) {
    std::vector<double> tops;
    double y = top(column.front());
    for (std::size_t i = 0; i < order.size(); ++i) {
      tops.push_back(y);
      const double gap =
          i + 1 < column.size() ? top(column[i + 1]) - boxes_[std::size_t(column[i])].rect.bottom() : 0;
      y += boxes_[std::size_t(order[i])].rect.height() + gap;
    }
    try_heights(order, tops);
    std::sort(column.begin(), column.end(), [&](int a, int b) { return top(a) < top(b); });
  }

  std::vector<Box> boxes_;
  std::vector<Wire> wires_;
  std::map<double, std::vector<int>> columns_;
  double cost_ = 0;
  int tries_ = 0;
  std::uint64_t chance_ = 1;
};

}  // namespace

double length_inside(const QPolygonF& line, const QRectF& box) {
  double sum = 0;
  for (qsizetype i = 0; i + 1 < line.size(); ++i) {
    const QPointF from = line[i], way = line[i + 1] - from;
    double enter = 0, leave = 1;  // Liang and Barsky's clipping
    const auto clip = [&](double speed, double distance) {
      if (speed == 0) {
        if (distance < 0) leave = -1;
      } else if (speed < 0) {
        enter = std::max(enter, distance / speed);
      } else {
        leave = std::min(leave, distance / speed);
      }
    };
    clip(-way.x(), from.x() - box.left());
    clip(way.x(), box.right() - from.x());
    clip(-way.y(), from.y() - box.top());
    clip(way.y(), box.bottom() - from.y());
    if (leave > enter) sum += (leave - enter) * std::hypot(way.x(), way.y());
  }
  return sum;
}

std::map<std::string, QPointF> clear_wires(const GraphScene& scene,
                                           std::map<std::string, QPointF> positions) {
  Layout layout(scene, positions);
  layout.improve();
  return layout.positions();
}

}  // namespace kinegraph
