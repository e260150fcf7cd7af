#include "gui/window/welcome.h"

#include <QDir>
#include <QEvent>
#include <QFile>
#include <QFileInfo>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <algorithm>

#include "graph/file/parse_json.h"
#include "gui/panels/files_panel.h"

namespace kinegraph {
namespace {

constexpr int card_width = 186, card_height = 112, gap = 12, words_height = 186;
// The first ones that a new user should see; the rest of the room is filled by name.
const char* const first_examples[] = {"sneaky_walk",  "style_transfer", "component_edit",
                                      "cartoon_walk", "feet",           "component_transfer"};

struct Thumbnail {
  std::vector<QRectF> nodes;
  std::vector<QLineF> wires;
  QRectF bounds;
};

// A graph's boxes and lines, as saved under `ui`: reading them needs no registry.
Thumbnail thumbnail_of(const QString& path) {
  Thumbnail made;
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return made;
  Diagnostics problems;
  const Json json = parse_json(file.readAll().toStdString(), path.toStdString(), problems);
  const Json* nodes = json.find("nodes");
  const Json* ui = json.find("ui");
  const Json* places = ui ? ui->find("nodes") : nullptr;
  if (!nodes || !nodes->is_object() || !places || !places->is_object()) return made;
  std::map<std::string, QRectF> at;
  for (const auto& [name, entry] : places->object())
    if (const auto pos = point_of(&entry, "pos")) at[name] = QRectF(*pos, QSizeF(180, 90));
  for (const auto& [name, box] : at) {
    made.nodes.push_back(box);
    made.bounds = made.bounds.united(box);
  }
  for (const auto& [name, node] : nodes->object()) {
    const Json* inputs = node.find("inputs");
    if (!inputs || !inputs->is_object() || !at.count(name)) continue;
    for (const auto& [port, links] : inputs->object()) {
      const auto draw = [&](const Json& link) {
        const auto from = link.is_string() ? link_from_text(link.string()) : std::nullopt;
        if (from && at.count(from->node))
          made.wires.emplace_back(QPointF(at[from->node].right(), at[from->node].center().y()),
                                  QPointF(at[name].left(), at[name].center().y()));
      };
      if (links.is_array())
        for (const Json& link : links.array()) draw(link);
      else
        draw(links);
    }
  }
  return made;
}

class Card : public QPushButton {
 public:
  Card(const QString& path, QWidget* parent) : QPushButton(parent), picture_(thumbnail_of(path)) {
    title_ = QFileInfo(path).fileName().remove(".kg.json").replace('_', ' ');
    if (!title_.isEmpty()) title_[0] = title_[0].toUpper();
    setAccessibleName(title_);
    setToolTip(QDir::toNativeSeparators(path));
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);
  }
  const Theme* theme = &dark_theme();

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter p(this);
    p.setRenderHint(QPainter::Antialiasing);
    const bool lit = underMouse() || hasFocus();
    p.setPen(QPen(lit ? theme->accent : theme->line, hasFocus() ? 2 : 1));
    p.setBrush(theme->panel);
    p.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 7, 7);
    const QRectF room = QRectF(rect()).adjusted(14, 12, -14, -34);
    if (!picture_.bounds.isEmpty()) {
      const double scale =
          std::min({room.width() / picture_.bounds.width(), room.height() / picture_.bounds.height(), 0.2});
      const auto place = [&](QPointF at) { return room.center() + (at - picture_.bounds.center()) * scale; };
      p.setPen(QPen(theme->wire, 1));
      for (const QLineF& wire : picture_.wires) {
        const QPointF a = place(wire.p1()), b = place(wire.p2());
        QPainterPath curve(a);
        const double bow = std::max(4.0, (b.x() - a.x()) / 2);
        curve.cubicTo(a + QPointF(bow, 0), b - QPointF(bow, 0), b);
        p.drawPath(curve);
      }
      p.setPen(Qt::NoPen);
      p.setBrush(lit ? theme->accent : theme->faint_text);
      for (const QRectF& node : picture_.nodes)
        p.drawRoundedRect(QRectF(place(node.topLeft()), place(node.bottomRight())), 1.5, 1.5);
    }
    p.setPen(theme->text);
    p.drawText(rect().adjusted(10, height() - 32, -10, -6), Qt::AlignCenter, title_);
  }

 private:
  Thumbnail picture_;
  QString title_;
};

}  // namespace

Welcome::Welcome(QWidget* canvas) : QWidget(canvas), theme_(&dark_theme()) {
  setObjectName("welcome");
  setAccessibleName(tr("Examples"));
  setAttribute(Qt::WA_NoSystemBackground);
  const QString folder = examples_folder();
  QStringList paths;
  if (!folder.isEmpty()) {
    for (const char* name : first_examples) {
      const QString path = QDir(folder).filePath(QString(name) + ".kg.json");
      if (QFile::exists(path)) paths << path;
    }
    for (const QFileInfo& file : QDir(folder).entryInfoList({"*.kg.json"}, QDir::Files, QDir::Name))
      if (!paths.contains(file.absoluteFilePath())) paths << file.absoluteFilePath();
  }
  for (const QString& path : paths.mid(0, 6)) {
    auto* card = new Card(path, this);
    connect(card, &QPushButton::clicked, this, [this, path] { emit chosen(path); });
    cards_.push_back(card);
  }
  canvas->installEventFilter(this);
  show_where(true);
}

void Welcome::set_theme(const Theme& theme) {
  theme_ = &theme;
  update();
  for (QPushButton* card : cards_) {
    static_cast<Card*>(card)->theme = &theme;
    card->update();
  }
}

void Welcome::show_where(bool empty) {
  setVisible(empty);
  if (empty) place();
}

bool Welcome::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) place();
  return QWidget::eventFilter(watched, event);
}

// Three cards in a row, fewer where it is narrow; only the rows that fit below the words.
void Welcome::place() {
  const QSize canvas = parentWidget()->size();
  const int across = std::clamp((canvas.width() - gap) / (card_width + gap), 1, 3);
  const int needed = (int(cards_.size()) + across - 1) / across;
  const int rows = std::clamp((canvas.height() - words_height - gap) / (card_height + gap), 0, needed);
  const int wide = across * (card_width + gap) - gap;
  const int high = words_height + rows * (card_height + gap);
  setGeometry((canvas.width() - wide) / 2, std::max(0, (canvas.height() - high) / 2), wide, high);
  for (int i = 0; i < int(cards_.size()); ++i) {
    cards_[std::size_t(i)]->setGeometry(i % across * (card_width + gap),
                                        words_height + i / across * (card_height + gap), card_width,
                                        card_height);
    cards_[std::size_t(i)]->setVisible(i < across * rows);
  }
}

void Welcome::paintEvent(QPaintEvent*) {
  QPainter p(this);
  p.setRenderHint(QPainter::Antialiasing);
  const auto lettering = [](int pixels, bool bold) {
    QFont font;
    font.setPixelSize(pixels);
    font.setBold(bold);
    return font;
  };
  p.setPen(theme_->text);
  p.setFont(lettering(19, true));
  p.drawText(QRect(0, 0, width(), 34), Qt::AlignCenter, tr("This graph is empty"));
  const std::pair<QString, QString> lines[] = {{tr("Tab"), tr("add a node by its name")},
                                               {tr("Drop"), tr("a motion file here to load it")},
                                               {tr("Ctrl+O"), tr("open a graph")}};
  double y = 44;
  p.setFont(lettering(13, false));
  for (const auto& [key, what] : lines) {
    const QRectF cap(width() / 2.0 - 130, y, 62, 24);
    p.setPen(QPen(theme_->line, 1));
    p.setBrush(theme_->panel);
    p.drawRoundedRect(cap, 4, 4);
    p.setPen(theme_->text);
    p.drawText(cap, Qt::AlignCenter, key);
    p.setPen(theme_->faint_text);
    p.drawText(QRectF(cap.right() + 14, y, 260, 24), Qt::AlignVCenter, what);
    y += 30;
  }
  if (!cards_.empty() && cards_.front()->isVisibleTo(this))
    p.drawText(QRect(0, words_height - 38, width(), 26), Qt::AlignCenter, tr("or begin with an example"));
}

}  // namespace kinegraph
