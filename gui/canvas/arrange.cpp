#include "gui/canvas/arrange.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gui/canvas/clear_wires.h"

namespace kinegraph {
namespace {

constexpr double between_columns = 70;
constexpr double between_rows = 30;

// A node, or the room that a wire takes in a column which it passes.
struct Item {
  const SceneNode* node = nullptr;
  double height = 14, width = 0;
  std::vector<int> before, after;  // indices of neighbours along the links
  int column = 0;
  double wish = 0, y = 0;
};

// Longest way from a source; what only feeds later columns moves right next to them.
void find_columns(std::vector<Item>& items) {
  const int count = static_cast<int>(items.size());
  for (int round = 0; round < count; ++round) {
    bool moved = false;
    for (Item& item : items)
      for (int earlier : item.before)
        if (item.column < items[std::size_t(earlier)].column + 1 && item.column + 1 < count) {
          item.column = items[std::size_t(earlier)].column + 1;
          moved = true;
        }
    if (!moved) break;
  }
  for (int round = 0; round < count; ++round) {
    bool moved = false;
    for (Item& item : items) {
      if (item.after.empty()) continue;
      int nearest = count;
      for (int later : item.after) nearest = std::min(nearest, items[std::size_t(later)].column);
      if (item.before.empty() && nearest - 1 > item.column) {
        item.column = nearest - 1;
        moved = true;
      }
    }
    if (!moved) break;
  }
}

double centre(const Item& item) {
  return item.y + item.height / 2;
}

// A wire over several columns goes past the nodes in between and not behind them.
void make_room_for_wires(std::vector<Item>& items) {
  const int nodes = static_cast<int>(items.size());
  for (int from = 0; from < nodes; ++from) {
    std::vector<int> after = items[std::size_t(from)].after;
    std::sort(after.begin(), after.end());
    after.erase(std::unique(after.begin(), after.end()), after.end());
    for (int to : after) {
      int before = from;
      const int last = items[std::size_t(to)].column;
      for (int column = items[std::size_t(from)].column + 1; column < last; ++column) {
        Item room;
        room.column = column;
        room.wish = (centre(items[std::size_t(from)]) + centre(items[std::size_t(to)])) / 2;
        room.before = {before};
        items.push_back(room);
        const int made = static_cast<int>(items.size()) - 1;
        std::replace(items[std::size_t(before)].after.begin(), items[std::size_t(before)].after.end(), to,
                     made);
        items[std::size_t(made)].after = {to};
        before = made;
      }
      if (before != from)
        std::replace(items[std::size_t(to)].before.begin(), items[std::size_t(to)].before.end(), from,
                     before);
    }
  }
}

// Puts a column's nodes in the order of their wishes, each as near to its wish as the others let it be.
void pack(std::vector<Item>& items, std::vector<int>& column) {
  std::stable_sort(column.begin(), column.end(),
                   [&](int a, int b) { return items[std::size_t(a)].wish < items[std::size_t(b)].wish; });
  double total = 0, wished = 0;
  for (int i : column) {
    total += items[std::size_t(i)].height + between_rows;
    wished += items[std::size_t(i)].wish;
  }
  total -= between_rows;
  double y = wished / double(column.size()) - total / 2;
  for (int i : column) {
    Item& item = items[std::size_t(i)];
    item.y = y;
    y += item.height + between_rows;
  }
}

}  // namespace

std::map<std::string, QPointF> arranged(const GraphScene& scene, const std::set<std::string>& nodes) {
  std::vector<Item> items;
  std::map<std::string, int> index;
  for (const SceneNode& node : scene.nodes())
    if (nodes.empty() || nodes.count(node.name)) {
      index[node.name] = static_cast<int>(items.size());
      items.push_back(
          {&node, node.rect.height(), node.rect.width(), {}, {}, 0, node.rect.center().y(), node.rect.top()});
    }
  if (items.empty()) return {};
  for (const SceneWire& wire : scene.wires())
    if (index.count(wire.from) && index.count(wire.to) && wire.from != wire.to) {
      items[std::size_t(index[wire.from])].after.push_back(index[wire.to]);
      items[std::size_t(index[wire.to])].before.push_back(index[wire.from]);
    }
  find_columns(items);
  make_room_for_wires(items);
  std::map<int, std::vector<int>> columns;
  for (std::size_t i = 0; i < items.size(); ++i) columns[items[i].column].push_back(static_cast<int>(i));
  for (auto& [number, column] : columns) pack(items, column);
  // Back and forth: each node wishes to stand at the mean height of its neighbours.
  for (int round = 0; round < 6; ++round) {
    const bool forth = round % 2 == 0;
    const auto settle = [&](std::vector<int>& column) {
      for (int i : column) {
        Item& item = items[std::size_t(i)];
        const std::vector<int>& neighbours = forth ? item.before : item.after;
        if (neighbours.empty()) {
          item.wish = centre(item);
          continue;
        }
        double sum = 0;
        for (int other : neighbours) sum += centre(items[std::size_t(other)]);
        item.wish = sum / double(neighbours.size());
      }
      pack(items, column);
    };
    if (forth)
      for (auto& [number, column] : columns) settle(column);
    else
      for (auto column = columns.rbegin(); column != columns.rend(); ++column) settle(column->second);
  }
  const QRectF before = nodes.empty() ? scene.bounds_of([&] {
    std::set<std::string> all;
    for (const SceneNode& node : scene.nodes()) all.insert(node.name);
    return all;
  }())
                                      : scene.bounds_of(nodes);
  double top = 1e300;
  for (const Item& item : items)
    if (item.node) top = std::min(top, item.y);
  std::map<std::string, QPointF> positions;
  double x = before.left();
  for (const auto& [number, column] : columns) {
    double width = 0;
    for (int i : column) {
      const Item& item = items[std::size_t(i)];
      if (!item.node) continue;
      positions[item.node->name] = QPointF(x, before.top() + item.y - top);
      width = std::max(width, item.width);
    }
    x += width + between_columns;
  }
  for (auto& [name, at] : positions)
    at = QPointF(std::round(at.x() / GraphScene::step) * GraphScene::step,
                 std::round(at.y() / GraphScene::step) * GraphScene::step);
  positions = clear_wires(scene, std::move(positions));
  if (!nodes.empty()) return positions;
  top = 1e300;
  for (const auto& [name, at] : positions) top = std::min(top, at.y());
  for (auto& [name, at] : positions) at.ry() += before.top() - top;
  return positions;
}

}  // namespace kinegraph
