#include "gui/window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QProgressBar>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QTabBar>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "graph/nested.h"
#include "gui/look/settings.h"
#include "gui/viewing/looked_at.h"
#include "gui/window/welcome.h"

// Resources of a library are only there when they are asked for.
static void load_pictures() {
  Q_INIT_RESOURCE(pictures);
}

namespace kinegraph {
namespace {

constexpr int frame_room = 40;  // pixels that a window manager may take around a window

}  // namespace

MainWindow::MainWindow(const Registry& registry, const Options& options)
    : registry_(registry),
      options_(options),
      session_(registry),
      evaluation_(registry, options.cache_folder),
      theme_(&dark_theme()),
      canvas_(new GraphCanvas(session_, evaluation_)),
      page_tabs_(new QTabBar),
      welcome_(new Welcome(canvas_, registry_)),
      notice_(new NoticeBar),
      state_(new StateLine),
      hover_text_(new QLabel),
      progress_(new QProgressBar) {
  load_pictures();
  setObjectName("main_window");
  setDockOptions(QMainWindow::AllowNestedDocks | QMainWindow::AllowTabbedDocks |
                 QMainWindow::GroupedDragging);
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  setAcceptDrops(true);
  setWindowIcon(icon(Sign::graph, light_theme()));
  auto* middle = new QWidget;
  auto* column = new QVBoxLayout(middle);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  page_tabs_->setObjectName("pages");
  page_tabs_->setAccessibleName(tr("Open graphs"));
  page_tabs_->setTabsClosable(true);
  page_tabs_->setDrawBase(false);
  page_tabs_->setExpanding(false);
  page_tabs_->setElideMode(Qt::ElideNone);
  page_tabs_->setFocusPolicy(Qt::TabFocus);
  column->addWidget(page_tabs_);
  column->addWidget(notice_);
  column->addWidget(canvas_, 1);
  setCentralWidget(middle);

  hover_text_->setObjectName("faint");
  hover_text_->setAccessibleName(tr("What is under the pointer"));
  hover_text_->setContentsMargins(10, 0, 6, 0);
  progress_->setAccessibleName(tr("Progress"));
  progress_->setFixedSize(140, 8);
  progress_->setTextVisible(false);
  progress_->setRange(0, 1000);
  progress_->hide();
  hover_text_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  statusBar()->addWidget(hover_text_, 1);
  statusBar()->addPermanentWidget(state_);
  statusBar()->addPermanentWidget(progress_);
  statusBar()->setContentsMargins(0, 0, 10, 0);
  statusBar()->setSizeGripEnabled(false);

  make_docks();
  make_actions();
  make_menus();

  connect(canvas_, &GraphCanvas::hovered_text, hover_text_, &QLabel::setText);
  connect(canvas_, &GraphCanvas::file_dropped, this, &MainWindow::open);
  connect(canvas_, &GraphCanvas::opened_inside, this,
          [this](const QString& node) { open_inside(node.toStdString()); });
  connect(welcome_, &Welcome::chosen, this, &MainWindow::open);
  connect(page_tabs_, &QTabBar::currentChanged, this, [this](int page) {
    finish_typing();  // a click on a tab takes no keyboard away
    session_.show_page(page);
  });
  connect(page_tabs_, &QTabBar::tabCloseRequested, this, &MainWindow::close_page);
  connect(&session_, &Session::page_changed, this, [this] {
    evaluation_.forget();
    notice_->hide();
    canvas_->frame_all();
  });
  connect(&session_, &Session::changed, this, [this] {
    const bool empty =
        session_.document().nodes.empty() && session_.document().ui.notes.empty() && !session_.is_read_only();
    if (empty && !welcome_->isVisible()) welcome_->show_recent(recent());
    welcome_->show_where(empty);
  });
  connect(&session_, &Session::changed, this, &MainWindow::update_actions);
  connect(&session_, &Session::selection_changed, this, &MainWindow::update_actions);
  connect(&session_, &Session::file_changed, this, &MainWindow::update_title);
  // Nothing is evaluated there, which would tell how it stands.
  connect(&session_, &Session::changed, this, [this] {
    if (session_.is_read_only()) update_progress();
  });
  connect(&session_, &Session::refused, this, [this](const QString& message, const QString& hint) {
    const QString end = message.endsWith('.') ? QString() : QStringLiteral(".");
    notice_->say(NoticeBar::Kind::warning, hint.isEmpty() ? message : message + end + " " + hint, {}, 8);
  });
  // Once all docks have heard of a change, so that they are asked what they want afterwards.
  const auto later = [this] {
    if (evaluation_due_) return;
    evaluation_due_ = true;
    QMetaObject::invokeMethod(this, &MainWindow::evaluate, Qt::QueuedConnection);
  };
  connect(&session_, &Session::meaning_changed, this, later);
  connect(&session_, &Session::selection_changed, this, later);
  connect(&session_, &Session::reading_changed, this, &MainWindow::update_progress);
  connect(&evaluation_, &Evaluation::busy_changed, this, &MainWindow::update_progress);
  // Once for all nodes that tell of themselves in one turn.
  connect(&evaluation_, &Evaluation::status_changed, this, [this] {
    if (std::exchange(progress_due_, true)) return;
    QMetaObject::invokeMethod(this, &MainWindow::update_progress, Qt::QueuedConnection);
  });
  connect(&evaluation_, &Evaluation::finished, this, [this](bool effects) {
    update_progress();
    if (effects) ran_effects();
  });
  slow_.setSingleShot(true);
  slow_.setInterval(120);
  connect(&slow_, &QTimer::timeout, this, [this] {
    is_slow_ = true;
    update_progress();
  });
  reload_.setSingleShot(true);
  reload_.setInterval(150);
  connect(&watcher_, &QFileSystemWatcher::fileChanged, this, &MainWindow::file_changed_on_disk);
  connect(&session_, &Session::meaning_changed, this, &MainWindow::watch_other_files);
  connect(&watcher_, &QFileSystemWatcher::directoryChanged, this, &MainWindow::file_changed_on_disk);
  connect(&reload_, &QTimer::timeout, this, &MainWindow::look_at_changed_files);

  resize(1280, 800);
  bool dark = true;
  if (options_.remember) {
    const auto settings = user_settings();
    const bool was_open = restoreGeometry(settings->value("window/geometry").toByteArray());
    // With its frame it has to fit on the screen.
    const QSize room = screen()->availableSize() - size();
    if (!was_open && std::min(room.width() - frame_room, room.height() - frame_room) < 0)
      setWindowState(Qt::WindowMaximized);
    laid_out_ = restoreState(settings->value("window/layout").toByteArray(), layout_version);
    dark = settings->value("window/theme", "dark").toString() != "light";
  }
  welcome_->show_recent(recent());
  set_theme(dark ? dark_theme() : light_theme());
  update_title();
  update_actions();
  update_progress();
  canvas_->setFocus();
  qApp->installEventFilter(this);
}

// What is being typed ends with the window, while there is still a session to take it.
MainWindow::~MainWindow() {
  hide();
}

void MainWindow::set_theme(const Theme& theme) {
  theme_ = &theme;
  qApp->setPalette(theme.palette());
  qApp->setStyleSheet(theme.style_sheet());
  canvas_->set_theme(theme);
  welcome_->set_theme(theme);
  state_->set_theme(theme);
  for (const auto& apply_theme : themed_) apply_theme(theme);
  update_icons();
  emit theme_changed();
}

void MainWindow::evaluate() {
  evaluation_due_ = false;
  if (session_.is_read_only() || session_.is_reading_inside()) return;  // once it is read this is due again
  EvaluationRequest request;
  request.document = session_.document();
  request.file = session_.title().toStdString();
  request.folder = session_.folder().toStdString();
  std::set<std::pair<std::string, std::string>> asked;
  const auto ask = [&](const Target& target) {
    if (asked.insert({target.node, target.port}).second) request.targets.push_back(target);
  };
  // The current node, so that its state is known. What writes or checks runs only with the Run button: of
  // those what is linked to them.
  std::string looked_at = session_.current();
  if (looked_at.empty()) looked_at = node_to_look_at(session_.document(), registry_);
  if (auto found = session_.document().nodes.find(looked_at); found != session_.document().nodes.end()) {
    const NodeType* type = known_type(registry_, found->second);
    if (type && type->effect != Effect::none) {
      for (const auto& [port, inputs] : found->second.inputs)
        for (const Link& link : inputs.links) ask({link.node, link.port});
    } else if (type) {
      // A reader gives only what its file holds, and what makes motions or points makes one of them: of such
      // outputs those that are linked.
      const bool either = !outputs_of(session_.document(), registry_, looked_at, "Motion").empty() &&
                          !outputs_of(session_.document(), registry_, looked_at, "Points").empty();
      if (either || type->outputs.size() > 3) {
        for (const auto& [name, node] : session_.document().nodes)
          for (const auto& [port, inputs] : node.inputs)
            for (const Link& link : inputs.links)
              if (link.node == looked_at) ask({link.node, link.port});
        if (asked.empty() && either)
          if (const auto shown =
                  nearest_output(session_.document(), registry_, looked_at, {"Motion", "Points"}))
            ask(*shown);
        for (const OutputPort& port : type->outputs) {
          if (!asked.empty()) break;
          for (const Target& own : outputs_of(session_.document(), registry_, looked_at, port.type))
            if (own.port == port.name) ask(own);
        }
      } else {
        ask({looked_at, ""});
      }
    }
  }
  for (const auto& wanted : wants_)
    for (const Target& target : wanted()) ask(target);
  evaluation_.request(std::move(request));
}

void MainWindow::update_progress() {
  progress_due_ = false;
  const bool reads = session_.is_reading_inside(), busy = reads || evaluation_.is_busy();
  actions_.at("cancel")->setEnabled(busy);
  // What is over in a moment is not worth a word: the status bar would flicker at every step of a drag.
  if (!busy) {
    slow_.stop();
    is_slow_ = false;
  } else if (!is_slow_) {
    if (!slow_.isActive()) slow_.start();
    return;
  }
  progress_->setVisible(busy);
  progress_->setRange(0, reads ? 0 : 1000);
  double progress = 0;
  const Document& document = session_.document();
  const Standing at_work = standing_at_work(document, evaluation_, &progress);
  progress_->setValue(int(1000 * progress));
  if (session_.is_read_only())
    state_->say({Standing::Tone::quiet, tr("Read-only")});
  else if (reads)
    state_->say({Standing::Tone::busy, tr("Reading the graph files inside")});
  else
    state_->say(busy ? at_work : standing_of(document, registry_, evaluation_));
}

void MainWindow::update_title() {
  update_pages();
  setWindowTitle(tr("%1[*] – Kinegraph").arg(session_.title()));
  setWindowModified(session_.is_modified());
}

// Sizes that docks get before the window has its own don't last.
void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  if (!std::exchange(laid_out_, true))
    QTimer::singleShot(0, this, [this] {
      size_docks();
      QTimer::singleShot(0, canvas_, &GraphCanvas::frame_all);  // in the room that is left for it
    });
}

// A line takes Ctrl+Z for its own text, also where nothing was typed: then the last step of the graph is
// meant. And a drag ends with the button, also where what was dragged went away under it.
bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseButtonRelease && session_.in_gesture())
    QMetaObject::invokeMethod(&session_, &Session::end_gesture, Qt::QueuedConnection);
  if (event->type() == QEvent::ShortcutOverride)
    if (const auto* line = qobject_cast<QLineEdit*>(watched)) {
      const auto* keys = static_cast<QKeyEvent*>(event);
      if ((keys->matches(QKeySequence::Undo) && !line->isUndoAvailable()) ||
          (keys->matches(QKeySequence::Redo) && !line->isRedoAvailable())) {
        event->ignore();
        return true;
      }
    }
  return QMainWindow::eventFilter(watched, event);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  finish_typing();
  if (options_.ask && !may_discard_all()) {
    event->ignore();
    return;
  }
  if (options_.remember) {
    const auto settings = user_settings();
    settings->setValue("window/geometry", saveGeometry());
    settings->setValue("window/layout", saveState(layout_version));
    settings->setValue("window/theme", theme_->dark ? "dark" : "light");
  }
  evaluation_.cancel();
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  for (const QUrl& url : event->mimeData()->urls())
    if (url.toLocalFile().endsWith(".kg.json")) return event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls())
    if (url.toLocalFile().endsWith(".kg.json")) {
      open(url.toLocalFile());
      return;
    }
}

}  // namespace kinegraph
