#include "gui/canvas/graph_canvas.h"

#include <QAccessible>
#include <QPlainTextEdit>
#include <algorithm>
#include <cmath>

#include "gui/canvas/canvas_accessible.h"
#include "gui/document/problem_text.h"

namespace kinegraph {
namespace {

constexpr int steps_a_doubling = 4;
constexpr int smallest_step = -20, largest_step = 6;  // zoom 1/32 to 2.8: "all" is all, however far apart
constexpr int rest_after_ms = 120;
constexpr int states_ms = 30;  // nodes' states may come in so much later, many at once

}  // namespace

GraphCanvas::GraphCanvas(Session& session, Evaluation& evaluation, QWidget* parent)
    : QWidget(parent),
      session_(session),
      evaluation_(evaluation),
      theme_(&dark_theme()),
      search_(new SearchBox(this)) {
  setObjectName("canvas");
  QAccessible::installFactory(canvas_accessible);
  setAccessibleName(tr("Graph"));
  setAccessibleDescription(
      tr("Nodes and the links between them. Tab adds a node, arrow keys walk along links."));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAcceptDrops(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(240, 160);
  rest_.setSingleShot(true);
  rest_.setInterval(rest_after_ms);
  connect(&rest_, &QTimer::timeout, this, [this] {
    resting_ = true;
    update();
  });
  connect(&session_, &Session::changed, this, [this] {
    rebuild();
    if (gesture_ && !gesture_->follow()) give_up_gesture();
  });
  connect(&session_, &Session::page_changed, this, &GraphCanvas::give_up_gesture);
  connect(&session_, &Session::problems_changed, this, [this] {
    const auto before = problems_;
    find_problems();
    for (const SceneNode& node : scene_.nodes()) {
      const auto old = before.find(node.name);
      if ((old == before.end() ? std::nullopt : std::optional(old->second)) != problem_of(node.name))
        pixmaps_.forget(node.name);
    }
    update();
  });
  connect(&session_, &Session::selection_changed, this, [this] {
    scene_.raise(session_.selected());
    update();
    tell_of_current_node(*this);
  });
  connect(&evaluation_, &Evaluation::status_changed, this, [this](const QString& node) {
    pixmaps_.forget(node.toStdString());
    if (!states_due_.isActive()) states_due_.start();
  });
  states_due_.setSingleShot(true);
  states_due_.setInterval(states_ms);
  connect(&states_due_, &QTimer::timeout, this, QOverload<>::of(&QWidget::update));
  find_problems();
  rebuild();
}

GraphCanvas::~GraphCanvas() = default;

void GraphCanvas::set_theme(const Theme& theme) {
  theme_ = &theme;
  pixmaps_.forget();
  update();
}

void GraphCanvas::rebuild() {
  for (const std::string& node : scene_.rebuild(session_.document(), session_.registry(), expanded_))
    pixmaps_.forget(node);
  scene_.raise(session_.selected());
  std::erase_if(selected_frames_,
                [&](const auto& name) { return !session_.document().ui.frames.count(name); });
  std::erase_if(selected_notes_, [&](const auto& name) { return !session_.document().ui.notes.count(name); });
  update();
}

void GraphCanvas::find_problems() {
  problems_.clear();
  for (const Diagnostic& problem : session_.problems()) {
    if (problem.node.empty() || problem.severity == Severity::info) continue;
    const Severity severity = shown_severity(problem);
    Severity& worst = problems_.emplace(problem.node, severity).first->second;
    worst = std::max(worst, severity);
  }
}

std::optional<Severity> GraphCanvas::problem_of(const std::string& node) const {
  auto found = problems_.find(node);
  if (found == problems_.end()) return {};
  return found->second;
}

void GraphCanvas::moving() {
  resting_ = false;
  rest_.start();
  update();
}

void GraphCanvas::pan_by(QPointF pixels) {
  pan_ += pixels;
  moving();
}

void GraphCanvas::zoom_at(QPointF view, int steps) {
  const int step = std::clamp(zoom_step_ + steps, smallest_step, largest_step);
  if (step == zoom_step_) return;
  const QPointF fixed = to_graph(view);
  zoom_step_ = step;
  zoom_ = std::pow(2.0, double(step) / steps_a_doubling);
  pan_ = view - fixed * zoom_;
  moving();
}

void GraphCanvas::show_rect(QRectF graph) {
  if (graph.isNull()) graph = QRectF(-200, -120, 400, 240);
  const QSizeF room(std::max(50.0, width() - 60.0), std::max(50.0, height() - 60.0));
  const double fit = std::min({room.width() / graph.width(), room.height() / graph.height(), 1.0});
  zoom_step_ =
      std::clamp(int(std::floor(std::log2(fit) * steps_a_doubling + 1e-6)), smallest_step, largest_step);
  zoom_ = std::pow(2.0, double(zoom_step_) / steps_a_doubling);
  pan_ = QRectF(rect()).center() - graph.center() * zoom_;
  framed_once_ = true;
  update();
}

void GraphCanvas::make_visible(const std::string& name) {
  const SceneNode* node = scene_.node(name);
  if (!node) return;
  const QRectF seen(to_graph({20, 20}), to_graph({width() - 20.0, height() - 20.0}));
  if (seen.contains(node->rect)) return;
  if (zoom_ < 0.5) zoom_at(rect().center(), -zoom_step_);
  pan_ = QRectF(rect()).center() - node->rect.center() * zoom_;
  moving();
}

void GraphCanvas::select_decor(std::set<std::string> frames, std::set<std::string> notes) {
  selected_frames_ = std::move(frames);
  selected_notes_ = std::move(notes);
  update();
}

void GraphCanvas::set_hint(const QString& text, QPointF view, bool refused) {
  hint_ = text;
  hint_at_ = view;
  hint_refused_ = refused;
  update();
}

void GraphCanvas::begin(std::unique_ptr<CanvasGesture> gesture) {
  gesture_ = std::move(gesture);
  setCursor(gesture_->cursor());
  update();
}

bool GraphCanvas::give_up_gesture() {
  const auto gesture = std::move(gesture_);
  if (!gesture) return false;
  gesture->cancel();
  unsetCursor();
  rebuild();
  return true;
}

QPointF GraphCanvas::pointer() const {
  const QPoint at = mapFromGlobal(QCursor::pos());
  return to_graph(rect().contains(at) && underMouse() ? QPointF(at) : QRectF(rect()).center());
}

std::vector<std::string> GraphCanvas::selection() const {
  return {session_.selected().begin(), session_.selected().end()};
}

void GraphCanvas::resizeEvent(QResizeEvent* event) {
  // The first size counts; later ones keep what is in the middle there.
  if (!framed_once_ || event->oldSize().isEmpty())
    show_rect(scene_.bounds());
  else
    pan_ += QPointF(event->size().width() - event->oldSize().width(),
                    event->size().height() - event->oldSize().height()) /
            2;
  framed_once_ = isVisible();
  search_->stay_inside();  // a notice that comes up must not end what is being typed
}

void GraphCanvas::focusInEvent(QFocusEvent*) {
  update();
  tell_of_current_node(*this);
}
void GraphCanvas::focusOutEvent(QFocusEvent*) {
  space_ = false;
  update();
}

void GraphCanvas::edit_text(QRectF graph, const QString& text, std::function<void(const QString&)> done) {
  delete text_edit_;
  auto* edit = new QPlainTextEdit(this);
  text_edit_ = edit;
  edit->setObjectName("canvas_text");
  edit->setAccessibleName(tr("Text"));
  edit->setPlainText(text);
  edit->selectAll();
  const QRect place = QRectF(to_view(graph.topLeft()), to_view(graph.bottomRight())).toRect();
  if (const bool one_line = graph.height() < 40; one_line) {
    edit->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    edit->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    edit->setLineWrapMode(QPlainTextEdit::NoWrap);
  }
  const int words = std::clamp(edit->fontMetrics().horizontalAdvance(text) + 48, 110, 160);
  edit->setGeometry(
      QRect(place.topLeft(), QSize(std::max(words, place.width()), std::max(36, place.height()))));
  edit->setToolTip(tr("Ctrl+Enter or a click beside it keeps the text, Escape leaves it as it was"));
  edit->show();
  edit->setFocus();
  // Ends on focus loss, Ctrl+Enter (Enter on a single line) and Escape.
  class Watch : public QObject {
   public:
    Watch(QPlainTextEdit* parent, bool one_line, std::function<void(const QString&)> end)
        : QObject(parent), edit_(parent), one_line_(one_line), end_(std::move(end)) {
      parent->installEventFilter(this);
    }
    bool eventFilter(QObject*, QEvent* event) override {
      if (event->type() == QEvent::ShortcutOverride) {
        event->accept();
        return true;
      }
      if (event->type() == QEvent::FocusOut) close(true);
      if (event->type() != QEvent::KeyPress) return false;
      auto* key = static_cast<QKeyEvent*>(event);
      const bool enter = key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter;
      if (key->key() == Qt::Key_Escape || (enter && (one_line_ || key->modifiers() & Qt::ControlModifier))) {
        close(enter);
        return true;
      }
      return false;
    }

   private:
    void close(bool keep) {
      if (closed_) return;
      closed_ = true;
      const auto end = end_;
      const QString written = edit_->toPlainText();
      QWidget* canvas = edit_->parentWidget();
      edit_->hide();
      edit_->deleteLater();
      canvas->setFocus();
      if (keep) end(written);
    }
    QPlainTextEdit* edit_;
    bool one_line_, closed_ = false;
    std::function<void(const QString&)> end_;
  };
  new Watch(edit, graph.height() < 40, [this, done = std::move(done), edit](const QString& written) {
    if (text_edit_ == edit) text_edit_ = nullptr;
    done(written);
  });
}

QRectF GraphCanvas::mini_map_rect() const {
  const QRectF all = scene_.bounds();
  if (scene_.nodes().size() < 2 || width() < 480 || height() < 260) return {};
  const QRectF seen(to_graph({0, 0}), to_graph({double(width()), double(height())}));
  if (seen.contains(all)) return {};
  return {width() - 172.0, height() - 122.0, 160, 110};
}

QPointF GraphCanvas::mini_map_to_graph(QPointF view) const {
  const QRectF map = mini_map_rect().adjusted(6, 6, -6, -6), all = scene_.bounds();
  const double scale = std::min(map.width() / all.width(), map.height() / all.height());
  return all.center() + (view - map.center()) / scale;
}

}  // namespace kinegraph
