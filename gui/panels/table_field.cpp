// Lists, lists of objects (edits, rules, keys) and tables of patterns: rows that are typed into, added,
// removed, moved.
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QStyledItemDelegate>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <set>

#include "gui/panels/param_field.h"
#include "gui/panels/variants.h"

namespace kinegraph {
namespace {

constexpr int most_rows_seen = 6;

class ChoiceDelegate : public QStyledItemDelegate {
 public:
  ChoiceDelegate(const std::vector<ParamType>& columns, QObject* parent)
      : QStyledItemDelegate(parent), columns_(columns) {}
  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option,
                        const QModelIndex& index) const override {
    const ParamType& type = columns_[std::size_t(index.column())];
    QStringList choices;
    for (const ParamType::Choice& choice : type.choices) choices << QString::fromStdString(choice.key);
    if (type.kind == ParamType::Kind::boolean) choices = {"true", "false"};
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
      titles << tr("joints") << tr("value");
    } else if (objects_) {
      columns_ = element.parts;
      for (const ParamType& field : element.parts) titles << QString::fromStdString(field.name);
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
    table_->horizontalHeader()->setVisible(!titles.isEmpty());
    table_->horizontalHeader()->setSectionResizeMode(columns_.size() > 4 ? QHeaderView::ResizeToContents
                                                                         : QHeaderView::Stretch);
    if (variants_) table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
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
    };
    tool(tr("Add"), tr("add a row"), [this] { add_row(); });
    tool(tr("Remove"), tr("remove the chosen row"), [this] { remove_row(); });
    if (!by_name_) {
      tool(tr("Up"), tr("move the chosen row up"), [this] { move_row(-1); });
      tool(tr("Down"), tr("move the chosen row down"), [this] { move_row(1); });
    }
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
    if (value == value_ && table_->rowCount() > 0) return;
    showing_ = true;
    value_ = value;
    if (by_name_ ? !value.is_object() : !value.is_array())
      value_ = by_name_ ? Json(Json::Object{}) : Json(Json::Array{});
    if (!adding_) fill();
    showing_ = false;
  }
  bool is_being_edited() const override { return adding_; }

 protected:
  // Only what is shown has its fonts and edges.
  void showEvent(QShowEvent* event) override {
    ParamField::showEvent(event);
    fit();
  }

 private:
  void set_cell(int row, int column, const QString& text) {
    table_->setItem(row, column, new QTableWidgetItem(text));
  }

  void fill() {
    table_->setRowCount(0);
    if (by_name_) {
      for (const auto& [name, one] : value_.object()) {
        const int row = table_->rowCount();
        table_->insertRow(row);
        set_cell(row, 0, QString::fromStdString(name));
        set_cell(row, 1, typed_text(one));
      }
    } else {
      for (const Json& one : value_.array()) {
        const int row = table_->rowCount();
        table_->insertRow(row);
        if (variants_) {
          set_cell(row, 0, variant_key(*variants_, one));
          set_cell(row, 1, variant_text(*variants_, one));
          table_->item(row, 1)->setToolTip(table_->item(row, 1)->text());
          continue;
        }
        if (!objects_) {
          set_cell(row, 0, typed_text(one));
          continue;
        }
        for (std::size_t i = 0; i < columns_.size(); ++i) {
          const Json* field = one.find(columns_[i].name);
          set_cell(row, int(i), field ? typed_text(*field) : QString());
        }
      }
    }
    fit();
  }

  void fit() {
    const int rows = std::clamp(table_->rowCount(), 1, most_rows_seen);
    table_->setFixedHeight(rows * table_->verticalHeader()->defaultSectionSize() +
                           (table_->horizontalHeader()->isVisibleTo(table_)
                                ? table_->horizontalHeader()->sizeHint().height()
                                : 0) +
                           4);
    none_->setVisible(table_->rowCount() == 0);
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
          break;
        }
        const auto value = typed_value(columns_[i], cell(row, int(i)), &why);
        if (!value) {
          why = QString::fromStdString(columns_[i].name) + ": " + why;
          break;
        }
        object[columns_[i].name] = *value;
      }
      if (why.isEmpty()) element = Json(std::move(object));
    } else {
      element = typed_value(columns_.back(), cell(row, int(columns_.size()) - 1), &why);
    }
    if (by_name_ && cell(row, 0).isEmpty()) return;
    if (!element) {
      emit wrong(why);
      return;
    }
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
    if (has_error(problems)) {
      emit wrong(QString::fromStdString(problems.front().message));
      return;
    }
    adding_ = false;
    value_ = next;
    emit edited(next);
  }

  ParamType type_;
  QTableWidget* table_;
  QLabel* none_;
  std::vector<ParamType> columns_;
  std::optional<ParamType> variants_;  // of a row: objects of several forms
  bool by_name_ = false, objects_ = false, showing_ = false, adding_ = false;
  Json value_ = Json(Json::Array{});
};

}  // namespace

ParamField* make_table_field(const Param& param, const FieldContext&, QWidget* parent) {
  return new TableField(param, parent);
}

}  // namespace kinegraph
