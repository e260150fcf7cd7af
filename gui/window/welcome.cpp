#include "gui/window/welcome.h"

#include <QDir>
#include <QEvent>
#include <QFile>
#include <QFileInfo>
#include <QPainter>
#include <QScrollArea>
#include <QTimer>
#include <algorithm>

#include "gui/panels/files_panel.h"
#include "gui/window/example_card.h"

namespace kinegraph {
namespace {

constexpr int gap = 10, heading_height = 28, words_height = 124, margin = 16;
constexpr int most_recent = 4;

// In the order in which a new user should meet them; what else lies in the folder comes last.
struct Example {
  const char *group, *file, *about;
};
constexpr Example examples[] = {
    {"Style", "sneaky_walk", "A walk learns to sneak, in seven nodes"},
    {"Style", "style_transfer", "The whole method: warp, statistics, transfer, back"},
    {"Style", "euler_versus_quaternion", "Why styles are taken from quaternions"},
    {"Style", "styled_rubber_walk", "Style, components and rubber in one graph"},
    {"Components", "component_edit", "Scale, move and bend single components"},
    {"Components", "component_transfer", "Only the sneak's posture goes to the walk"},
    {"Components", "component_between", "Steps between two behaviours"},
    {"Components", "component_pieces", "A take cut up and seen in its components"},
    {"Components", "component_run_sneak", "Run and sneak change postures"},
    {"Components", "component_run_walk", "Run and walk change postures"},
    {"Components", "representations", "Points, quaternions, Euler angles, logarithms"},
    {"Components", "face", "A face taken apart and played anew"},
    {"Components", "explosion", "Free points: sparks that rise higher"},
    {"Cartoon", "cartoon_walk", "Exaggerated, with rubber limbs, on its feet"},
    {"Cartoon", "cartoon_run", "Limbs bend like hoses and follow through"},
    {"Cartoon", "cartoon_dance", "Springy steps, arms thrown up"},
    {"Cartoon", "cartoon_kick", "A kick that winds up first"},
    {"Cartoon", "cartoon_boxing", "A fist beyond its reach"},
    {"Cartoon", "cartoon_character", "A skinned mannequin of rubber"},
    {"Cartoon", "cartoon_comparison", "Four ways to exaggerate, side by side"},
    {"Feet and figures", "feet", "Sliding feet are found and held"},
    {"Feet and figures", "retarget", "A skinned figure walks, then sneaks"},
    {"Graphs in graphs", "reuse", "A graph used as one node"},
    {"Graphs in graphs", "sneaky_rubber", "Two pipelines behind one another"},
    {"Graphs in graphs", "sample_clips", "How the sample clips were made"},
};

}  // namespace

Welcome::Welcome(QWidget* canvas, const Registry& registry)
    : QWidget(canvas),
      registry_(registry),
      theme_(&dark_theme()),
      scroll_(new QScrollArea(this)),
      page_(new QWidget) {
  setObjectName("welcome");
  setAccessibleName(tr("Examples"));
  setAttribute(Qt::WA_NoSystemBackground);
  scroll_->setObjectName("examples");
  scroll_->setAccessibleName(tr("Examples"));
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll_->setFocusPolicy(Qt::NoFocus);
  scroll_->setWidget(page_);
  scroll_->viewport()->setAutoFillBackground(false);
  page_->setAutoFillBackground(false);
  canvas->installEventFilter(this);
  show_where(true);
}

void Welcome::show_recent(const QStringList& paths) {
  const QStringList shown = paths.mid(0, most_recent);
  if (shown == recent_) return;
  recent_ = shown;
  if (filled_) fill();
}

void Welcome::fill() {
  filled_ = true;
  for (const Group& group : groups_) {
    delete group.heading;
    qDeleteAll(group.cards);
  }
  groups_.clear();
  QStringList folders;
  for (const QString& path : recent_) folders << QFileInfo(path).dir().dirName();
  add_group(tr("Recent"), recent_, folders);
  const QString folder = examples_folder();
  if (folder.isEmpty()) return place();
  QStringList left;
  for (const QFileInfo& file : QDir(folder).entryInfoList({"*.kg.json"}, QDir::Files, QDir::Name))
    left << file.absoluteFilePath();
  QString title;
  QStringList paths, words;
  for (const Example& one : examples) {
    if (title != one.group) {
      add_group(title, paths, words);
      paths.clear();
      words.clear();
      title = one.group;
    }
    const QString path = QDir(folder).absoluteFilePath(QString(one.file) + ".kg.json");
    if (!left.removeOne(path)) continue;
    paths << path;
    words << tr(one.about);
  }
  add_group(title, paths, words);
  QStringList no_words;
  for (qsizetype i = 0; i < left.size(); ++i) no_words << QString();
  add_group(tr("More"), left, no_words);
  place();
}

void Welcome::add_group(const QString& title, const QStringList& paths, const QStringList& words) {
  if (paths.isEmpty()) return;
  Group group{new QLabel(title, page_), {}};
  group.heading->setObjectName("faint");
  group.heading->show();
  for (qsizetype i = 0; i < paths.size(); ++i) {
    auto* card = new ExampleCard(paths[i], words[i], registry_, page_);
    card->set_theme(*theme_);
    connect(card, &QPushButton::clicked, this, [this, path = paths[i]] { emit chosen(path); });
    card->show();
    group.cards.push_back(card);
  }
  groups_.push_back(std::move(group));
}

void Welcome::set_theme(const Theme& theme) {
  theme_ = &theme;
  update();
  for (const Group& group : groups_)
    for (ExampleCard* card : group.cards) card->set_theme(theme);
}

void Welcome::show_where(bool empty) {
  setVisible(empty);
  if (!empty) return;
  place();
  // A window that is opened on a graph never shows them, and shouldn't wait for them.
  QTimer::singleShot(0, this, [this] {
    if (isVisible() && !filled_) fill();
  });
}

bool Welcome::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) place();
  return QWidget::eventFilter(watched, event);
}

// As many cards in a row as fit; the rows scroll below the words.
void Welcome::place() {
  const QSize canvas = parentWidget()->size();
  setGeometry(1, 1, canvas.width() - 2, canvas.height() - 2);
  const int room = width() - 2 * margin - 12;  // beside the scroll bar
  const int across = std::clamp((room + gap) / (ExampleCard::wide + gap), 1, 6);
  const int row_width = across * (ExampleCard::wide + gap) - gap;
  const int left = std::max(0, (room - row_width) / 2);
  int y = 0;
  for (const Group& group : groups_) {
    group.heading->setGeometry(left + 2, y, row_width, heading_height);
    y += heading_height;
    for (int i = 0; i < int(group.cards.size()); ++i)
      group.cards[std::size_t(i)]->setGeometry(left + i % across * (ExampleCard::wide + gap),
                                               y + i / across * (ExampleCard::high + gap), ExampleCard::wide,
                                               ExampleCard::high);
    const int rows = (int(group.cards.size()) + across - 1) / across;
    y += rows * (ExampleCard::high + gap) + 4;
  }
  const int high = std::max(0, height() - words_height);
  page_->resize(room, y);
  scroll_->setGeometry(margin, words_height, width() - 2 * margin, high);
  scroll_->setVisible(high >= heading_height && !groups_.empty());
}

void Welcome::paintEvent(QPaintEvent*) {
  QPainter p(this);
  p.setRenderHint(QPainter::Antialiasing);
  QFont font;
  font.setPixelSize(19);
  font.setBold(true);
  p.setPen(theme_->text);
  p.setFont(font);
  p.drawText(QRect(0, 16, width(), 32), Qt::AlignCenter, tr("This graph is empty"));
  font.setPixelSize(13);
  font.setBold(false);
  p.setFont(font);
  const std::pair<QString, QString> ways[] = {{tr("Tab"), tr("add a node by its name")},
                                              {tr("Drop"), tr("a motion file here")},
                                              {tr("Ctrl+O"), tr("open a graph")}};
  const QFontMetrics metrics(font);
  const auto cap_width = [&](const QString& key) { return metrics.horizontalAdvance(key) + 18; };
  int total = -24;
  for (const auto& [key, what] : ways) total += cap_width(key) + 8 + metrics.horizontalAdvance(what) + 24;
  int x = (width() - total) / 2;
  for (const auto& [key, what] : ways) {
    const QRectF cap(x, 60, cap_width(key), 24);
    p.setPen(QPen(theme_->line, 1));
    p.setBrush(theme_->panel);
    p.drawRoundedRect(cap, 4, 4);
    p.setPen(theme_->text);
    p.drawText(cap, Qt::AlignCenter, key);
    const int words = metrics.horizontalAdvance(what);
    p.setPen(theme_->faint_text);
    p.drawText(QRectF(cap.right() + 8, 60, words + 4, 24), Qt::AlignVCenter, what);
    x += cap_width(key) + 8 + words + 24;
  }
  if (scroll_->isVisibleTo(this))
    p.drawText(QRect(0, 94, width(), 26), Qt::AlignCenter,
               recent_.isEmpty() ? tr("or begin with an example") : tr("or go on with one of these"));
}

}  // namespace kinegraph
