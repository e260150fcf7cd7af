#include "gui/canvas/search_box.h"

#include <QKeyEvent>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/canvas/fuzzy.h"

namespace kinegraph {
namespace {

constexpr int rows_seen = 10;
constexpr int index_role = Qt::UserRole, detail_role = Qt::UserRole + 1;

// The name on the left, its family on the right.
class EntryDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const override {
    return {100, option.fontMetrics.height() + 8};
  }
  void paint(QPainter* p, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const bool selected = option.state & QStyle::State_Selected;
    if (selected) {
      p->setPen(Qt::NoPen);
      p->setBrush(option.palette.highlight());
      p->drawRoundedRect(option.rect.adjusted(2, 1, -2, -1), 4, 4);
    }
    const QRect inside = option.rect.adjusted(10, 0, -10, 0);
    const QString detail = index.data(detail_role).toString();
    p->setPen(option.palette.color(selected ? QPalette::HighlightedText : QPalette::Text));
    p->setFont(option.font);
    const int room = inside.width() - option.fontMetrics.horizontalAdvance(detail) - 12;
    p->drawText(inside, Qt::AlignVCenter | Qt::AlignLeft,
                option.fontMetrics.elidedText(index.data().toString(), Qt::ElideRight, room));
    if (!selected) p->setPen(option.palette.color(QPalette::PlaceholderText));
    p->drawText(inside, Qt::AlignVCenter | Qt::AlignRight, detail);
  }
};

}  // namespace

SearchBox::SearchBox(QWidget* parent) : QFrame(parent) {
  setObjectName("search_box");
  setAutoFillBackground(true);
  setFrameShape(QFrame::NoFrame);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(6);
  line_ = new QLineEdit(this);
  line_->setObjectName("search_line");
  line_->setAccessibleName(tr("Search"));
  line_->setClearButtonEnabled(false);
  list_ = new QListWidget(this);
  list_->setObjectName("search_list");
  list_->setAccessibleName(tr("What was found"));
  list_->setItemDelegate(new EntryDelegate(list_));
  list_->setFocusPolicy(Qt::NoFocus);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  help_ = new QLabel(this);
  help_->setObjectName("faint");
  help_->setWordWrap(true);
  help_->setAlignment(Qt::AlignTop);
  help_->setFixedHeight(fontMetrics().lineSpacing() * 3 + 4);
  layout->addWidget(line_);
  layout->addWidget(list_);
  layout->addWidget(help_);
  line_->installEventFilter(this);
  connect(line_, &QLineEdit::textChanged, this, &SearchBox::filter);
  connect(list_, &QListWidget::itemClicked, this, [this] { choose(); });
  connect(list_, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* item) {
    help_->setText(item ? entries_[std::size_t(item->data(index_role).toInt())].help
                        : tr("Nothing goes by that name."));
  });
  hide();
}

void SearchBox::open(QPoint at, const QString& prompt, std::vector<Entry> entries,
                     std::function<void(int)> chosen) {
  entries_ = std::move(entries);
  chosen_ = std::move(chosen);
  line_->setPlaceholderText(prompt);
  line_->setAccessibleName(prompt);
  line_->clear();
  filter();
  move(at);
  stay_inside();
  show();
  raise();
  line_->setFocus(Qt::PopupFocusReason);
}

void SearchBox::stay_inside() {
  const QRect room = parentWidget()->rect().adjusted(8, 8, -8, -8);
  move(std::max(room.left(), std::min(x(), room.right() - width())),
       std::max(room.top(), std::min(y(), room.bottom() - height())));
}

void SearchBox::cancel() {
  if (!isVisible()) return;
  chosen_ = nullptr;
  hide();
  parentWidget()->setFocus();
}

void SearchBox::filter() {
  std::vector<std::pair<double, int>> found;
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (const double score = fuzzy_score(line_->text(), entries_[i].name, entries_[i].keywords); score > 0)
      found.push_back({-score, int(i)});
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  list_->clear();
  for (const auto& [score, i] : found) {
    auto* item = new QListWidgetItem(entries_[std::size_t(i)].name);
    item->setData(index_role, i);
    item->setData(detail_role, entries_[std::size_t(i)].detail);
    list_->addItem(item);
  }
  const int row = list_->fontMetrics().height() + 8;
  list_->setFixedHeight(std::min(list_->count(), rows_seen) * row + 4);
  list_->setVisible(list_->count() > 0);
  help_->setFixedHeight(fontMetrics().lineSpacing() * (list_->count() > 0 ? 3 : 1) + 4);
  help_->setVisible(list_->count() == 0 || std::any_of(entries_.begin(), entries_.end(),
                                                       [](const Entry& e) { return !e.help.isEmpty(); }));
  resize(340, layout()->sizeHint().height());
  if (list_->count())
    list_->setCurrentRow(0);
  else
    help_->setText(tr("Nothing goes by that name."));
}

void SearchBox::choose() {
  QListWidgetItem* item = list_->currentItem();
  if (!item) return;
  const int index = item->data(index_role).toInt();
  const auto chosen = std::move(chosen_);
  chosen_ = nullptr;
  hide();
  parentWidget()->setFocus();
  if (chosen) chosen(index);
}

bool SearchBox::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusOut && isVisible()) {
    // A click elsewhere closes it.
    if (static_cast<QFocusEvent*>(event)->reason() == Qt::MouseFocusReason) cancel();
    return false;
  }
  if (event->type() == QEvent::ShortcutOverride) {
    event->accept();  // what is typed here is no shortcut
    return true;
  }
  if (event->type() != QEvent::KeyPress) return QFrame::eventFilter(watched, event);
  auto* key = static_cast<QKeyEvent*>(event);
  const int row = list_->currentRow(), last = list_->count() - 1;
  switch (key->key()) {
    case Qt::Key_Down:
      list_->setCurrentRow(std::min(row + 1, last));
      return true;
    case Qt::Key_Up:
      list_->setCurrentRow(std::max(row - 1, 0));
      return true;
    case Qt::Key_PageDown:
      list_->setCurrentRow(std::min(row + 8, last));
      return true;
    case Qt::Key_PageUp:
      list_->setCurrentRow(std::max(row - 8, 0));
      return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_Tab:
      choose();
      return true;
    case Qt::Key_Escape:
      cancel();
      return true;
    default:
      return QFrame::eventFilter(watched, event);
  }
}

}  // namespace kinegraph
