#include "gui/window/keys_dialog.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/look/actions.h"

namespace kinegraph {
namespace {

enum Column { keys, name, what };
constexpr int row_height = 26, cap_height = 20, frame = 1, rows_at_first = 20;

// Keys on caps, all of one height and look; headings over the groups.
class Rows : public QStyledItemDelegate {
 public:
  Rows(const Theme& theme, QObject* parent) : QStyledItemDelegate(parent), theme_(theme) {}

  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    return {QStyledItemDelegate::sizeHint(option, index).width(), row_height};
  }
  void paint(QPainter* p, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    p->save();
    p->setRenderHint(QPainter::Antialiasing);
    if (option.state & QStyle::State_Selected) p->fillRect(option.rect, theme_.selection);
    const QRect place = option.rect.adjusted(12, 0, -6, 0);
    const QString text = index.data().toString();
    const bool heading = !index.siblingAtColumn(name).data().isValid();
    QFont font = option.font;
    font.setBold(heading);
    p->setFont(font);
    const QFontMetrics metrics(font);
    if (index.column() == keys && !heading) {
      int x = place.left();
      for (const QString& cap : text.split(", ")) {
        const QRectF box(x + 0.5, place.center().y() - cap_height / 2 + 0.5,
                         metrics.horizontalAdvance(cap) + 13, cap_height);
        p->setPen(QPen(theme_.line, 1));
        p->setBrush(theme_.raised);
        p->drawRoundedRect(box, 4, 4);
        p->setPen(theme_.text);
        p->drawText(box, Qt::AlignCenter, cap);
        x += int(box.width()) + 6;
      }
    } else {
      p->setPen(index.column() == what && !(option.state & QStyle::State_Selected) ? theme_.faint_text
                                                                                   : theme_.text);
      p->drawText(place, Qt::AlignVCenter | Qt::AlignLeft,
                  metrics.elidedText(text, Qt::ElideRight, place.width()));
    }
    p->restore();
  }

 private:
  const Theme& theme_;
};

}  // namespace

KeysDialog::KeysDialog(const Theme& theme, QWidget* parent)
    : QDialog(parent),
      letters_(new QLineEdit(this)),
      list_(new QTreeWidget(this)),
      nothing_(new QLabel(tr("No action of that name."), list_)) {
  setObjectName("keys_dialog");
  setWindowTitle(tr("Keys and mouse"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(10);
  letters_->setPlaceholderText(tr("Find an action or a key"));
  letters_->setAccessibleName(tr("Find an action or a key"));
  letters_->setClearButtonEnabled(true);
  letters_->installEventFilter(this);
  column->addWidget(letters_);
  list_->setAccessibleName(tr("Actions with their keys"));
  list_->setColumnCount(3);
  list_->header()->hide();
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setVerticalScrollMode(QAbstractItemView::ScrollPerItem);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setItemDelegate(new Rows(theme, list_));
  column->addWidget(list_, 1);
  column->addStretch(0);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
  nothing_->setObjectName("faint");
  nothing_->setAlignment(Qt::AlignCenter);
  nothing_->hide();
  fill();
  connect(letters_, &QLineEdit::textChanged, this, &KeysDialog::filter);
  resize(860, letters_->sizeHint().height() + buttons->sizeHint().height() + 2 * 14 + 2 * 10 +
                  rows_at_first * row_height + 2 * frame);
}

void KeysDialog::fill() {
  const auto heading = [&](const QString& title) {
    auto* item = new QTreeWidgetItem(list_, {title});
    item->setFlags(Qt::ItemIsEnabled);
    item->setFirstColumnSpanned(true);
  };
  using Where = ActionRow::Where;
  const std::pair<Where, QString> places[] = {{Where::window, tr("Everywhere")},
                                              {Where::graph, tr("In the graph")},
                                              {Where::viewer, tr("In the viewer")},
                                              {Where::timeline, tr("In the timeline")}};
  for (const auto& [where, title] : places) {
    heading(title);
    for (const ActionRow& row : all_actions())
      if (row.where == where)
        new QTreeWidgetItem(list_,
                            {tr(row.keys), QString(tr(row.text)).remove('&').remove("…"), tr(row.what)});
  }
  heading(tr("With the mouse"));
  for (const MouseRow& row : mouse_gestures())
    new QTreeWidgetItem(list_, {tr("Mouse"), tr(row.gesture), tr(row.what)});
  for (const Column column : {keys, name}) {
    int wide = 0;
    for (int i = 0; i < list_->topLevelItemCount(); ++i)
      if (const QTreeWidgetItem* item = list_->topLevelItem(i); item->data(name, Qt::DisplayRole).isValid())
        wide = std::max(wide, fontMetrics().horizontalAdvance(item->text(column)) +
                                  (column == keys ? 13 + 6 * int(item->text(keys).count(", ")) : 0));
    list_->setColumnWidth(column, wide + 26);
  }
}

// A heading stays with its rows: those of which every word that was typed is a part of one of their words.
void KeysDialog::filter(const QString& letters) {
  const QStringList wanted = letters.split(' ', Qt::SkipEmptyParts);
  QTreeWidgetItem* heading = nullptr;
  QTreeWidgetItem* first = nullptr;
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = list_->topLevelItem(i);
    if (!item->data(name, Qt::DisplayRole).isValid()) {
      heading = item;
      heading->setHidden(true);
      continue;
    }
    const QString all = item->text(keys) + " " + item->text(name) + " " + item->text(what);
    const bool fits = std::all_of(wanted.begin(), wanted.end(), [&](const QString& word) {
      return all.contains(word, Qt::CaseInsensitive);
    });
    item->setHidden(!fits);
    if (!fits) continue;
    if (heading) heading->setHidden(false);
    if (!first) first = item;
  }
  list_->setCurrentItem(wanted.isEmpty() ? nullptr : first);
  list_->scrollToTop();
  nothing_->setVisible(!first);
  nothing_->setGeometry(list_->viewport()->rect().adjusted(0, 0, 0, -list_->viewport()->height() / 2));
}

// The list is moved from the line as well.
bool KeysDialog::eventFilter(QObject* watched, QEvent* event) {
  if (watched == letters_ && event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    QScrollBar* bar = list_->verticalScrollBar();
    const int page = std::max(1, bar->pageStep() - 1);
    const int by = key->key() == Qt::Key_Down       ? 1
                   : key->key() == Qt::Key_Up       ? -1
                   : key->key() == Qt::Key_PageDown ? page
                   : key->key() == Qt::Key_PageUp   ? -page
                                                    : 0;
    if (by != 0) {
      bar->setValue(bar->value() + by);
      return true;
    }
  }
  return QDialog::eventFilter(watched, event);
}

void KeysDialog::resizeEvent(QResizeEvent* event) {
  QDialog::resizeEvent(event);
  show_whole_rows();
}

// No row is cut: what is left of the height goes below the list.
void KeysDialog::show_whole_rows() {
  layout()->activate();
  list_->setMaximumHeight(QWIDGETSIZE_MAX);
  layout()->activate();
  const int rows = (list_->height() - 2 * frame) / row_height;
  list_->setMaximumHeight(rows * row_height + 2 * frame);
}

}  // namespace kinegraph
