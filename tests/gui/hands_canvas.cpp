// The gestures of the canvas.
#include <QApplication>
#include <QCursor>
#include <QTest>

#include "gui/canvas/canvas_edits.h"
#include "tests/gui/hands.h"

namespace kinegraph::editor_test {
namespace {

std::size_t steps(Hands& hands) {
  return hands.session().history().position();
}

bool add_by_search(Hands& hands) {
  if (!hands.few()) return false;
  const std::vector<QString> names{"gait", "footskate",      "metrics", "mirror",
                                   "trim", "detectcontacts", "switch"};
  QTest::mouseMove(&hands.canvas(), hands.empty_place());
  Hands::settle();
  hands.canvas().setFocus();
  hands.key(Qt::Key_Tab);
  hands.type(hands.one_of(names));
  hands.key(Qt::Key_Return);
  return true;
}

// A pair of ports that fit and can be reached.
bool drag_wire(Hands& hands) {
  for (const std::string& from : hands.shuffled(hands.all()))
    for (const ScenePort& output : hands.canvas().scene().node(from)->outputs)
      for (const std::string& to : hands.shuffled(hands.own())) {
        const PortAt a{from, output.name, false};
        for (const ScenePort& input : hands.canvas().scene().node(to)->inputs) {
          const PortAt b{to, input.name, true};
          if (input.linked || !hands.reaches(a) || !hands.reaches(b) ||
              !objection(hands.document(), hands.session().registry(), a, b).isEmpty())
            continue;
          const auto place = [&](const PortAt& port) {
            return hands.canvas().to_view(hands.canvas().scene().port_position(port)).toPoint();
          };
          if (hands.below(2))
            hands.drag(place(a), place(b));
          else
            hands.drag(place(b), place(a));
          return true;
        }
      }
  return false;
}

bool drag_wire_to_empty(Hands& hands) {
  if (!hands.few()) return false;
  for (const std::string& from : hands.shuffled(hands.all()))
    for (const ScenePort& output : hands.canvas().scene().node(from)->outputs) {
      const PortAt port{from, output.name, false};
      const QPoint to = hands.empty_place();
      if (output.type != "Motion" || !hands.reaches(port) || to.isNull()) continue;
      hands.drag(hands.canvas().to_view(hands.canvas().scene().port_position(port)).toPoint(), to);
      hands.type(hands.below(2) ? "foot" : "metr");
      hands.key(Qt::Key_Return);
      return true;
    }
  return false;
}

bool take_link_off(Hands& hands) {
  for (const SceneWire& wire : hands.wires()) {
    const PortAt port{wire.to, wire.to_port, true};
    const QPoint to = hands.empty_place();
    if (hands.given.count(wire.to) || !hands.reaches(port) || to.isNull()) continue;
    hands.drag(hands.canvas().to_view(hands.canvas().scene().port_position(port)).toPoint(), to);
    hands.key(Qt::Key_Escape);  // of a list the link stays and a node is offered
    return true;
  }
  return false;
}

// The end of a link, taken off and put on another input that fits.
bool move_link(Hands& hands) {
  const auto place = [&](const PortAt& port) {
    return hands.canvas().to_view(hands.canvas().scene().port_position(port)).toPoint();
  };
  for (const SceneWire& wire : hands.wires()) {
    const PortAt end{wire.to, wire.to_port, true}, start{wire.from, wire.from_port, false};
    const auto& inputs = hands.document().nodes.at(wire.to).inputs.at(wire.to_port);
    if (hands.given.count(wire.to) || inputs.list || !hands.reaches(end)) continue;
    for (const std::string& to : hands.shuffled(hands.own()))
      for (const ScenePort& input : hands.canvas().scene().node(to)->inputs) {
        const PortAt other{to, input.name, true};
        if (input.linked || other == end || !hands.reaches(other) ||
            !objection(hands.document(), hands.session().registry(), start, other).isEmpty())
          continue;
        hands.drag(place(end), place(other));
        return true;
      }
  }
  return false;
}

// A place of a wire where nothing else lies.
QPoint on_wire(Hands& hands, const SceneWire& wire) {
  for (qsizetype i = wire.line.size() / 2; i + 2 < wire.line.size(); ++i) {
    const QPointF at = wire.line[i];
    const SceneWire* found = hands.canvas().scene().wire_at(at, 4);
    const QPoint view = hands.canvas().to_view(at).toPoint();
    if (found && found->to == wire.to && found->to_port == wire.to_port && found->index == wire.index &&
        !hands.canvas().scene().node_at(at) && !hands.canvas().scene().note_at(at) &&
        hands.canvas().rect().contains(view) &&
        !(view.x() > hands.canvas().width() - 180 && view.y() > hands.canvas().height() - 130))
      return view;
  }
  return {};
}

bool drop_on_wire(Hands& hands) {
  for (const std::string& node : hands.shuffled(hands.own())) {
    const SceneNode& one = *hands.canvas().scene().node(node);
    if (one.inputs.empty() || one.outputs.empty() || one.outputs[0].type != "Motion" || !hands.reaches(node))
      continue;
    for (const SceneWire& wire : hands.wires()) {
      const QPoint at = on_wire(hands, wire);
      if (wire.type != "Motion" || at.isNull() || wire.from == node || wire.to == node || wire.to == "ica")
        continue;
      const QPoint grip = hands.title(node);
      const QPoint middle = hands.canvas().to_view(one.rect.center()).toPoint();
      hands.drag(grip, at + (grip - middle));
      return true;
    }
  }
  return false;
}

bool alt_drag_out(Hands& hands) {
  for (const SceneWire& wire : hands.wires()) {
    const QPoint to = hands.empty_place();
    if (hands.given.count(wire.to) || !hands.reaches(wire.to) || to.isNull()) continue;
    hands.drag(hands.title(wire.to), to, Qt::AltModifier);
    return true;
  }
  return false;
}

bool cut_wires(Hands& hands) {
  for (const SceneWire& wire : hands.wires()) {
    const QPoint at = on_wire(hands, wire);
    if (hands.given.count(wire.to) || at.isNull()) continue;
    for (const QPoint& by : {QPoint(0, 26), QPoint(0, -26), QPoint(26, 26), QPoint(26, -26)}) {
      // Links between the nodes that were given stay.
      bool others = false;
      for (const SceneWire* crossed : hands.canvas().scene().wires_crossing(hands.canvas().to_graph(at - by),
                                                                            hands.canvas().to_graph(at + by)))
        others = others || hands.given.count(crossed->to);
      if (others || !hands.is_empty(at - by)) continue;
      hands.drag(at - by, at + by, Qt::ControlModifier);
      return true;
    }
  }
  return false;
}

bool dot_on_wire(Hands& hands) {
  if (!hands.few()) return false;
  for (const SceneWire& wire : hands.wires()) {
    const QPoint at = on_wire(hands, wire);
    if (at.isNull() || wire.to == "ica") continue;
    hands.click(hands.canvas(), at, Qt::ControlModifier);
    return true;
  }
  return false;
}

bool disable(Hands& hands) {
  if (!hands.choose_some(1)) return false;
  hands.key(Qt::Key_D);
  return true;
}

bool color(Hands& hands) {
  if (!hands.choose_some(1)) return false;
  hands.when_asked([&](QWidget& menu) {
    for (int i = hands.below(9); i >= 0; --i) QTest::keyClick(&menu, Qt::Key_Down);
    QTest::keyClick(&menu, Qt::Key_Return);
  });
  hands.key(Qt::Key_C);
  return true;
}

bool write_note(Hands& hands) {
  if (hands.document().ui.notes.size() > 4) return false;
  QTest::mouseMove(&hands.canvas(), hands.empty_place());
  Hands::settle();
  hands.key(Qt::Key_N);
  hands.type("why " + QString::number(hands.below(1000)));
  hands.key(Qt::Key_Return, Qt::ControlModifier);
  return true;
}

// Where a note can be taken hold of; null: nowhere.
QPoint on_note(Hands& hands, const SceneNote& note) {
  const QPoint view = hands.canvas().to_view(note.rect.topLeft() + QPointF(12, 12)).toPoint();
  const QPointF at = hands.canvas().to_graph(view);
  const SceneNote* found = hands.canvas().scene().note_at(at);
  if (!found || found->name != note.name || hands.canvas().scene().node_at(at) ||
      hands.canvas().scene().port_at(at, 40) || !hands.canvas().rect().contains(view))
    return {};
  return view;
}

bool with_note(Hands& hands, const std::function<void(const SceneNote&, QPoint)>& act) {
  for (const SceneNote& note : hands.shuffled(hands.canvas().scene().notes())) {
    const QPoint at = on_note(hands, note);
    if (at.isNull()) continue;
    act(SceneNote(note), at);
    return true;
  }
  return false;
}

bool rewrite_note(Hands& hands) {
  return with_note(hands, [&](const SceneNote&, QPoint at) {
    hands.double_click(at);
    hands.type("because " + QString::number(hands.below(1000)));
    hands.key(Qt::Key_Return, Qt::ControlModifier);
  });
}

bool move_note(Hands& hands) {
  // Notes far out would make all nodes too small to be reached when everything is looked at.
  const QPoint home = hands.title(hands.one_of(hands.all()));
  return with_note(hands, [&](const SceneNote&, QPoint at) {
    const QPoint way = (home - at) / 2;
    hands.drag(at, at + (way.manhattanLength() > 150 ? way : QPoint(30, 24)));
  });
}

bool resize_note(Hands& hands) {
  return with_note(hands, [&](const SceneNote& note, QPoint) {
    const QPointF corner = note.rect.bottomRight() - QPointF(5, 5);
    const SceneNote* found = hands.canvas().scene().note_at(corner);
    if (!found || found->name != note.name || hands.canvas().scene().node_at(corner) ||
        hands.canvas().scene().port_at(corner, 40))
      return;
    const QPoint at = hands.canvas().to_view(corner).toPoint();
    hands.drag(at, at + QPoint(10 + hands.below(30), 8 + hands.below(20)));
  });
}

bool frame(Hands& hands) {
  if (hands.canvas().scene().frames().size() > 4 || !hands.choose_some(1)) return false;
  hands.key(Qt::Key_G);
  hands.type("part " + QString::number(hands.below(1000)));
  hands.key(Qt::Key_Return);
  return true;
}

bool with_frame(Hands& hands, const std::function<void(QPoint)>& act) {
  for (const SceneFrame& frame : hands.shuffled(hands.canvas().scene().frames())) {
    const QPoint view = hands.canvas().to_view(frame.title_bar.topLeft() + QPointF(16, 12)).toPoint();
    const QPointF at = hands.canvas().to_graph(view);  // what the pixel hits, from afar not quite that
    const SceneFrame* found = hands.canvas().scene().frame_title_at(at);
    if (!found || found->name != frame.name || hands.canvas().scene().node_at(at) ||
        hands.canvas().scene().note_at(at) || hands.canvas().scene().port_at(at, 40))
      continue;
    act(view);
    return true;
  }
  return false;
}

bool rename_frame(Hands& hands) {
  return with_frame(hands, [&](QPoint at) {
    hands.double_click(at);
    hands.type("named " + QString::number(hands.below(1000)));
    hands.key(Qt::Key_Return);
  });
}

bool move_frame(Hands& hands) {
  return with_frame(hands, [&](QPoint at) { hands.drag(at, at + QPoint(20, 30)); });
}

bool delete_decor(Hands& hands) {
  const auto remove = [&](QPoint at) {
    hands.click(hands.canvas(), at);
    if (hands.session().selected().empty()) hands.key(Qt::Key_Delete);  // or a node lay there
  };
  if (hands.document().ui.notes.size() > 2 &&
      with_note(hands, [&](const SceneNote&, QPoint at) { remove(at); }))
    return true;
  return hands.canvas().scene().frames().size() > 2 && with_frame(hands, remove);
}

bool collapse(Hands& hands) {
  if (hands.own().size() < 4 || !hands.choose_some(1)) return false;
  hands.answer_file_dialog(hands.new_file(".kg.json"));
  hands.key(Qt::Key_G, Qt::ControlModifier);
  return true;
}

bool copy_and_paste(Hands& hands) {
  if (!hands.few() || !hands.choose_some(1)) return false;
  hands.key(Qt::Key_C, Qt::ControlModifier);
  hands.key(Qt::Key_V, Qt::ControlModifier);
  return true;
}

bool cut_and_paste(Hands& hands) {
  if (!hands.choose_some(1)) return false;
  hands.key(Qt::Key_X, Qt::ControlModifier);
  hands.key(Qt::Key_V, Qt::ControlModifier);
  return true;
}

bool duplicate(Hands& hands) {
  if (!hands.few() || !hands.choose_some(1)) return false;
  hands.key(Qt::Key_D, Qt::ControlModifier);
  return true;
}

bool remove(Hands& hands) {
  if (hands.own().size() < 4 || !hands.choose_some(1)) return false;
  hands.key(Qt::Key_Delete);
  return true;
}

bool arrange(Hands& hands) {
  hands.key(Qt::Key_L, Qt::ControlModifier);
  return true;
}

bool move(Hands& hands) {
  for (const std::string& node : hands.shuffled(hands.all())) {
    const QPoint to = hands.empty_place();
    if (!hands.reaches(node) || to.isNull()) continue;
    hands.drag(hands.title(node), to);
    return true;
  }
  return false;
}

bool move_several(Hands& hands) {
  if (!hands.choose_some(2)) return false;
  for (const std::string& node : hands.session().selected())
    if (hands.reaches(node)) {
      hands.drag(hands.title(node), hands.title(node) + QPoint(40, hands.below(40) - 20));
      return true;
    }
  return false;
}

bool nudge(Hands& hands) {
  if (!hands.choose_some(1)) return false;
  const Qt::Key keys[] = {Qt::Key_Left, Qt::Key_Right, Qt::Key_Up, Qt::Key_Down};
  hands.key(keys[hands.below(4)], Qt::ControlModifier);
  return true;
}

bool take_out_by_key(Hands& hands) {
  for (const SceneWire& wire : hands.wires())
    if (!hands.given.count(wire.to) && hands.choose(wire.to)) {
      hands.key(Qt::Key_X);
      return true;
    }
  return false;
}

bool rename(Hands& hands) {
  for (const std::string& node : hands.shuffled(hands.own()))
    if (hands.choose(node)) {
      hands.key(Qt::Key_F2);
      hands.type("named_" + QString::number(hands.below(100000)));
      hands.key(Qt::Key_Return);
      return true;
    }
  return false;
}

// L, letters of the other's name, Enter.
bool link_by_search(Hands& hands) {
  for (const std::string& from : hands.shuffled(hands.own())) {
    const SceneNode& node = *hands.canvas().scene().node(from);
    for (const std::string& to : hands.shuffled(hands.own()))
      for (const ScenePort& output : node.outputs)
        for (const ScenePort& input : hands.canvas().scene().node(to)->inputs) {
          if (input.linked || !objection(hands.document(), hands.session().registry(),
                                         {from, output.name, false}, {to, input.name, true})
                                   .isEmpty())
            continue;
          if (!hands.choose(from)) break;
          hands.key(Qt::Key_L);
          hands.type(QString::fromStdString(to + "." + input.name));
          hands.key(Qt::Key_Return);
          return true;
        }
  }
  return false;
}

bool context_menu(Hands& hands) {
  for (const std::string& node : hands.shuffled(hands.own())) {
    if (!hands.choose(node)) continue;
    const QPoint at = hands.title(node);
    hands.when_asked([&](QWidget& menu) {
      const QString wanted = hands.document().nodes.at(node).enabled ? "Disable" : "Enable";
      hands.choose_in_menu(menu, wanted);
    });
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, hands.canvas().mapToGlobal(at));
    QApplication::sendEvent(&hands.canvas(), &event);
    Hands::settle();
    return true;
  }
  return false;
}

// What was done is taken back and done again: the steps stay what they were.
bool undo_and_redo(Hands& hands) {
  const int count = std::min<int>(int(steps(hands)), 1 + hands.below(8));
  for (int i = 0; i < count; ++i) hands.key(Qt::Key_Z, Qt::ControlModifier);
  for (int i = 0; i < count; ++i) hands.key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  return count > 0;
}

}  // namespace

std::vector<Gesture> canvas_gestures() {
  return {
      {"add by search", add_by_search},
      {"drag a wire", drag_wire},
      {"drag a wire to empty space", drag_wire_to_empty},
      {"take a link off", take_link_off},
      {"move a link", move_link},
      {"drop a node on a wire", drop_on_wire},
      {"Alt-drag a node out", alt_drag_out},
      {"Ctrl-drag across wires", cut_wires},
      {"Ctrl-click a dot", dot_on_wire},
      {"disable", disable},
      {"colour", color},
      {"note", write_note},
      {"write a note again", rewrite_note},
      {"move a note", move_note},
      {"resize a note", resize_note},
      {"frame", frame},
      {"name a frame", rename_frame},
      {"move a frame", move_frame},
      {"delete a note or frame", delete_decor},
      {"collapse", collapse},
      {"copy and paste", copy_and_paste},
      {"cut and paste", cut_and_paste, 2},
      {"duplicate", duplicate},
      {"delete", remove},
      {"arrange", arrange},
      {"move", move},
      {"move several", move_several},
      {"nudge", nudge},
      {"take out", take_out_by_key},
      {"rename", rename},
      {"link by search", link_by_search},
      {"context menu", context_menu},
      {"undo and redo", undo_and_redo, 0},
  };
}

}  // namespace kinegraph::editor_test
