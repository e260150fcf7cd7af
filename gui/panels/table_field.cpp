// Lists, lists of objects (edits, rules, keys) and tables of patterns: rows that are typed into, added,
// removed, moved.
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QScrollBar>
#include <QStyle>
#include <QStyledItemDelegate>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "gui/document/problem_text.h"
#include "gui/panels/param_field.h"
#include "gui/panels/typed_words.h"
#include "gui/panels/variants.h"

namespace kinegraph {
namespace {

constexpr int most_rows_seen = 10, least_column = 56;

class ChoiceDelegate : public QStyledItemDelegate {
 public:
  ChoiceDelegate(const std::vector<ParamType>& columns, QObject* parent)
      : QStyledItemDelegate(parent), columns_(columns) {}
  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option,
                        const QModelIndex& index) const override {
    const ParamType& type = columns_[std::size_t(index.column())];
    QStringList choices;
    for (const ParamType::Choice& choice : type.choices) choices << QString::fromStdString(choice.key);
    if (type.kind == ParamType::Kind::boolean) choices = {QObject::tr("yes"), QObject::tr("no")};
    if (choices.isEmpty()) return QStyledItemDelegate::createEditor(parent, option, index);
    auto* box = new QComboBox(parent);
    box->addItems(choices);
    return box;
  }
  void setEditorData(QWidget* editor, const QModelIndex& index) const override {
    if (auto* box = qobject_cast<QComboBox*>(editor))
      box->setCurrentText(index.data(Qt::EditRole).toString());
    else
      QStyledItemDelegate::setEditorData(editor, index);
  }
  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override {
    if (auto* box = qobject_cast<QComboBox*>(editor))
      model->setData(index, box->currentText());
    else
      QStyledItemDelegate::setModelData(editor, model, index);
  }

 protected:
  // What holds where nothing is typed.
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    if (!option->text.isEmpty()) return;
    const ParamType& type = columns_[std::size_t(index.column())];
    if (!type.fallback) return;
    option->text = type.fallback->is_null() ? QStringLiteral("–") : typed_text(type, *type.fallback);
    option->features |= QStyleOptionViewItem::HasDisplay;
    option->palette.setColor(QPalette::Text, option->palette.color(QPalette::PlaceholderText));
  }

 private:
  std::vector<ParamType> columns_;
};

class TableField : public ParamField {
 public:
  TableField(const Param& param, QWidget* parent)
      : ParamField(parent),
        type_(param),
        table_(new QTableWidget(this)),
        none_(new QLabel(tr("None"), table_->viewport())) {
    using Kind = ParamType::Kind;
    const ParamType element = param.parts.empty() ? text("") : param.parts[0];
    by_name_ = param.kind == Kind::table;
    objects_ = !by_name_ && element.kind == Kind::object;
    QStringList titles;
    if (by_name_) {
      columns_ = {text(""), element};
      if (element.kind == Kind::pattern)
        titles << tr("name") << tr("joints");
      else
        titles << tr("joints") << tr("value");
    } else if (objects_) {
      columns_ = element.parts;
      for (const ParamType& field : element.parts)
        titles << QString::fromStdString(field.unit.empty() ? field.name : field.name + " " + field.unit);
    } else if (has_variants(element)) {
      variants_ = element;
      columns_ = {choice_of_variants(element), text("")};
      titles << QString::fromStdString(columns_[0].name) << tr("of what, and how");
    } else {
      columns_ = {element};
    }
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    table_->setColumnCount(int(columns_.size()));
    table_->setAccessibleName(QString::fromStdString(param.name));
    table_->verticalHeader()->hide();
    table_->setShowGrid(false);
    table_->horizontalHeader()->setHighlightSections(false);
    table_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 10);
    table_->verticalHeader()->setMinimumSectionSize(fontMetrics().height() + 10);
    table_->horizontalHeader()->setVisible(!titles.isEmpty());
    table_->horizontalHeader()->setMinimumSectionSize(least_column);
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setTabKeyNavigation(false);
    table_->setItemDelegate(new ChoiceDelegate(columns_, table_));
    if (!titles.isEmpty()) table_->setHorizontalHeaderLabels(titles);
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (QTableWidgetItem* header = table_->horizontalHeaderItem(int(i)))
        header->setToolTip(
            QString::fromStdString(columns_[i].help.empty() ? described(columns_[i]) : columns_[i].help));
    column->addWidget(table_);
    none_->setObjectName("faint");
    none_->setAlignment(Qt::AlignCenter);
    none_->setAttribute(Qt::WA_TransparentForMouseEvents);
    auto* over = new QVBoxLayout(table_->viewport());
    over->setContentsMargins(0, 0, 0, 0);
    over->addWidget(none_);
    auto* row = new QHBoxLayout;
    row->setSpacing(4);
    const auto tool = [&](const QString& sign, const QString& what, auto act) {
      auto* button = new QToolButton(this);
      button->setText(sign);
      button->setToolTip(what);
      button->setAccessibleName(tr("%1: %2").arg(QString::fromStdString(type_.name), what));
      connect(button, &QToolButton::clicked, this, act);
      row->addWidget(button);
      return button;
    };
    tool(tr("Add"), tr("add a row"), [this] { add_row(); });
    remove_ = tool(tr("Remove"), tr("remove the chosen row"), [this] { remove_row(); });
    if (!by_name_) {
      up_ = tool(tr("Up"), tr("move the chosen row up"), [this] { move_row(-1); });
      down_ = tool(tr("Down"), tr("move the chosen row down"), [this] { move_row(1); });
    }
    connect(table_, &QTableWidget::currentCellChanged, this, &TableField::enable_tools);
    enable_tools();
    row->addStretch(1);
    column->addLayout(row);
    setFocusProxy(table_);
    connect(table_, &QTableWidget::cellChanged, this, [this](int r, int c) {
      if (!showing_) changed(r, c);
    });
    fit();
  }

  void show_value(const Json& value) override {
    // What was typed here stands in its cells already; filling them anew would take the editor away.
    if (value == value_ && table_->rowCount() > 0) return fit();
    showing_ = true;
    value_ = value;
    if (by_name_ ? !value.is_object() : !value.is_array())
      value_ = by_name_ ? Json(Json::Object{}) : Json(Json::Array{});
    if (!adding_) fill();
    showing_ = false;
  }
  bool is_being_edited() const override { return adding_; }
  void drop_typed() override {
    adding_ = false;
    value_ = Json();
  }
  void mark_wrong(bool wrong) override {
    mark(table_, wrong);
    if (!wrong) say_wrong(-1, 0, {});
  }

 protected:
  // Only what is shown has its fonts and edges.
  void showEvent(QShowEvent* event) override {
    ParamField::showEvent(event);
    fit();
  }
  void resizeEvent(QResizeEvent* event) override {
    ParamField::resizeEvent(event);
    fit();
  }

 private:
  void set_cell(int row, int column, const QString& text) {
    auto* item = new QTableWidgetItem(text);
    item->setToolTip(text);
    item->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    table_->setItem(row, column, item);
  }

  void fill() {
    wrong_row_ = -1;
    const int row_before = table_->currentRow(), column_before = table_->currentColumn();
    table_->setRowCount(0);
    if (by_name_) {
      for (const auto& [name, one] : value_.object()) {
        const int row = table_->rowCount();
        table_->insertRow(row);
        set_cell(row, 0, QString::fromStdString(name));
        set_cell(row, 1, typed_text(columns_[1], one));
      }
    } else {
      for (const Json& one : value_.array()) {
        const int row = table_->rowCount();
        table_->insertRow(row);
        if (variants_) {
          set_cell(row, 0, variant_key(*variants_, one));
          set_cell(row, 1, variant_text(*variants_, one));
          continue;
        }
        if (!objects_) {
          set_cell(row, 0, typed_text(columns_[0], one));
          continue;
        }
        for (std::size_t i = 0; i < columns_.size(); ++i) {
          const Json* field = one.find(columns_[i].name);
          set_cell(row, int(i), field ? typed_text(columns_[i], *field) : QString());
        }
      }
    }
    if (row_before >= 0 && table_->rowCount() > 0)
      table_->setCurrentCell(std::min(row_before, table_->rowCount() - 1), column_before);
    enable_tools();
    fit();
  }

  // Columns as wide as what they hold, the widest narrower where there is no room for all, the last with what
  // is left; rows as high as their wrapped words, and so many of them seen whole.
  void fit() {
    QHeaderView& across = *table_->horizontalHeader();
    const int columns = table_->columnCount(),
              room =
                  width() - 2 * table_->frameWidth() -
                  (table_->rowCount() > most_rows_seen ? table_->verticalScrollBar()->sizeHint().width() : 0);
    std::vector<int> wide;
    for (int c = 0; c < columns; ++c)
      wide.push_back(std::max({least_column, across.isVisibleTo(table_) ? across.sectionSizeHint(c) : 0,
                               static_cast<QAbstractItemView*>(table_)->sizeHintForColumn(c) + 4}));
    int all = std::accumulate(wide.begin(), wide.end(), 0);
    while (all > room) {
      const auto widest = std::max_element(wide.begin(), wide.end());
      const int second = [&] {
        int most = least_column;
        for (auto at = wide.begin(); at != wide.end(); ++at)
          if (at != widest && *at < *widest) most = std::max(most, *at);
        return most;
      }();
      const int less = std::max(1, std::min(all - room, *widest - second));
      if (*widest - less < least_column) break;
      *widest -= less;
      all -= less;
    }
    if (all < room) wide.back() += room - all;
    for (int c = 0; c < columns; ++c)
      if (table_->columnWidth(c) != wide[std::size_t(c)]) table_->setColumnWidth(c, wide[std::size_t(c)]);
    table_->resizeRowsToContents();
    int high = across.isVisibleTo(table_) ? across.sizeHint().height() : 0;
    for (int r = 0; r < std::min(table_->rowCount(), most_rows_seen); ++r) high += table_->rowHeight(r);
    if (table_->rowCount() == 0) high += table_->verticalHeader()->defaultSectionSize();
    if (all > room) high += table_->horizontalScrollBar()->sizeHint().height();
    table_->setFixedHeight(high + 2 * table_->frameWidth());
    none_->setVisible(table_->rowCount() == 0);
  }

  // Marks the cell that doesn't fit, and no other.
  void say_wrong(int row, int column, const QString& why) {
    const bool before = std::exchange(showing_, true);
    if (QTableWidgetItem* item = table_->item(wrong_row_, wrong_column_)) {
      item->setData(Qt::ForegroundRole, {});
      item->setIcon({});
      item->setToolTip(item->text());
    }
    wrong_row_ = row;
    wrong_column_ = column;
    wrong_ = why;
    if (QTableWidgetItem* item = table_->item(row, column)) {
      item->setForeground(palette().color(QPalette::BrightText));
      item->setIcon(style()->standardIcon(QStyle::SP_MessageBoxCritical));
      item->setToolTip(why);
    }
    showing_ = before;
    if (row >= 0) {
      emit wrong(why);
      fit();
    }
  }

  QString cell(int row, int column) const {
    const QTableWidgetItem* item = table_->item(row, column);
    return item ? item->text().trimmed() : QString();
  }

  // What a new row starts with: the fields' defaults, so that it can be completed in place.
  void add_row() {
    showing_ = adding_ = true;
    const int row = table_->rowCount();
    table_->insertRow(row);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      QString start;
      const ParamType& type = columns_[i];
      if (!type.choices.empty() && (variants_ || !type.fallback))
        start = QString::fromStdString(type.choices.front().key);
      set_cell(row, int(i), start);
    }
    if (variants_) {
      set_cell(row, 1, fresh_variant_text(*variants_, cell(row, 0), Json(Json::Object{})));
      showing_ = false;
      changed(row, 1);
      table_->setCurrentCell(row, 0);
      return;
    }
    showing_ = false;
    fit();
    table_->setCurrentCell(row, 0);
    table_->editItem(table_->item(row, 0));
  }

  // Those that would do something.
  void enable_tools() {
    const int row = table_->currentRow();
    remove_->setEnabled(row >= 0);
    if (up_) up_->setEnabled(row > 0 && !adding_);
    if (down_) down_->setEnabled(row >= 0 && row + 1 < table_->rowCount() && !adding_);
  }

  void remove_row() {
    const int row = table_->currentRow();
    if (row < 0) return;
    adding_ = false;
    if (by_name_) {
      value_.object().erase(cell(row, 0).toStdString());
    } else if (std::size_t(row) < value_.array().size()) {
      value_.array().erase(value_.array().begin() + row);
    }
    emit edited(value_);
    showing_ = true;
    fill();
    showing_ = false;
  }

  void move_row(int by) {
    const int row = table_->currentRow(), to = row + by;
    if (row < 0 || to < 0 || std::size_t(std::max(row, to)) >= value_.array().size()) return;
    std::swap(value_.array()[std::size_t(row)], value_.array()[std::size_t(to)]);
    emit edited(value_);
    showing_ = true;
    fill();
    showing_ = false;
    table_->setCurrentCell(to, 0);
  }

  // A row is taken over once all of it fits; until then it says what is missing.
  void changed(int row, int column) {
    QString why;
    int wrong_column = by_name_ || variants_ ? 1 : column;
    std::optional<Json> element;
    if (variants_) {
      const bool known = std::size_t(row) < value_.array().size();
      if (column == 0) {
        // Another form: what both have stays.
        showing_ = true;
        set_cell(row, 1,
                 fresh_variant_text(*variants_, cell(row, 0),
                                    known ? value_.array()[std::size_t(row)] : Json(Json::Object{})));
        showing_ = false;
      }
      element = variant_of(*variants_, cell(row, 0), cell(row, 1), &why);
    } else if (objects_) {
      Json::Object object;
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (cell(row, int(i)).isEmpty()) {
          if (columns_[i].fallback) continue;
          why = tr("%1 is still missing.").arg(QString::fromStdString(columns_[i].name));
          wrong_column = int(i);
          break;
        }
        const auto value = typed_value(columns_[i], cell(row, int(i)), &why);
        if (!value) {
          why = QString::fromStdString(columns_[i].name) + ": " + why;
          wrong_column = int(i);
          break;
        }
        object[columns_[i].name] = *value;
      }
      if (why.isEmpty()) element = Json(std::move(object));
    } else {
      element = typed_value(columns_.back(), cell(row, int(columns_.size()) - 1), &why);
    }
    if (by_name_ && cell(row, 0).isEmpty()) return;
    if (!element) return say_wrong(row, wrong_column, why);
    Json next = value_;
    if (by_name_) {
      // A renamed row: its old name is the one that stands in no cell any more.
      std::set<std::string> names;
      for (int r = 0; r < table_->rowCount(); ++r) names.insert(cell(r, 0).toStdString());
      std::erase_if(next.object(), [&](const auto& entry) { return !names.count(entry.first); });
      next.object()[cell(row, 0).toStdString()] = *element;
    } else if (std::size_t(row) < next.array().size()) {
      next.array()[std::size_t(row)] = *element;
    } else {
      next.array().push_back(*element);
    }
    const Diagnostics problems = check(type_, next, type_.name);
    if (has_error(problems)) return say_wrong(row, column, problem_text(problems.front()));
    adding_ = false;
    enable_tools();
    value_ = next;
    const int still = wrong_row_ == row ? -1 : wrong_row_;
    const QString still_why = wrong_;
    const int still_column = wrong_column_;
    say_wrong(-1, 0, {});  // by itself: the node may have failed of another cell
    emit edited(next);
    emit corrected();
    if (still >= 0) say_wrong(still, still_column, still_why);
    fit();
  }

  ParamType type_;
  QTableWidget* table_;
  QLabel* none_;
  QToolButton *remove_ = nullptr, *up_ = nullptr, *down_ = nullptr;
  std::vector<ParamType> columns_;
  std::optional<ParamType> variants_;  // of a row: objects of several forms
  bool by_name_ = false, objects_ = false, showing_ = false, adding_ = false;
  int wrong_row_ = -1, wrong_column_ = 0;  // the cell that doesn't fit, and why
  QString wrong_;
  Json value_ = Json(Json::Array{});
};

}  // namespace

ParamField* make_table_field(const Param& param, const FieldContext&, QWidget* parent) {
  return new TableField(param, parent);
}

}  // namespace kinegraph
