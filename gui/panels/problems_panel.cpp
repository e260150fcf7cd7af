#include "gui/panels/problems_panel.h"

#include <QDir>
#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QStackedLayout>
#include <QStyledItemDelegate>
#include <algorithm>
#include <set>

#include "gui/document/problem_text.h"
#include "gui/look/icons.h"

namespace kinegraph {
namespace {

// Rows as high as their longest wrapped text.
class WrappedRows : public QStyledItemDelegate {
 public:
  explicit WrappedRows(QTreeWidget* list) : QStyledItemDelegate(list), list_(list) {}
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const int beside = index.column() == 0 ? 50 : 26, width = list_->columnWidth(index.column()) - beside;
    const QRect words = option.fontMetrics.boundingRect(QRect(0, 0, std::max(40, width), 2000),
                                                        Qt::TextWordWrap, index.data().toString());
    return QSize(words.width() + beside, words.height() + 10);
  }

 private:
  QTreeWidget* list_;
};

}  // namespace

ProblemsPanel::ProblemsPanel(Session& session, Evaluation& evaluation, QWidget* parent)
    : QWidget(parent),
      session_(session),
      evaluation_(evaluation),
      theme_(&dark_theme()),
      list_(new QTreeWidget(this)),
      none_(new QLabel(this)) {
  auto* layout = new QStackedLayout(this);
  layout->addWidget(list_);
  layout->addWidget(none_);
  none_->setText(tr("No problems."));
  none_->setObjectName("faint");
  none_->setAlignment(Qt::AlignCenter);
  list_->setObjectName("problem_list");
  list_->setAccessibleName(tr("Problems"));
  list_->setHeaderLabels({tr("Node"), tr("Problem"), tr("What to do")});
  list_->setRootIsDecorated(false);
  list_->setWordWrap(true);
  list_->setItemDelegate(new WrappedRows(list_));
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(1, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(2, QHeaderView::Stretch);
  list_->setColumnWidth(0, 160);
  list_->header()->setMinimumSectionSize(60);
  // Rows are as high as their wrapped words, which change with the columns.
  connect(list_->header(), &QHeaderView::sectionResized, this,
          [this] { QTimer::singleShot(0, list_, &QTreeWidget::doItemsLayout); });
  const auto go = [this](QTreeWidgetItem* item) {
    const QString node = item->data(0, Qt::UserRole).toString();
    if (!node.isEmpty()) emit go_to(node);
  };
  connect(list_, &QTreeWidget::itemClicked, this, go);
  connect(list_, &QTreeWidget::itemActivated, this, go);
  due_.setSingleShot(true);
  due_.setInterval(50);
  connect(&due_, &QTimer::timeout, this, &ProblemsPanel::fill);
  const auto soon = [this] { due_.start(); };
  connect(&session_, &Session::problems_changed, this, soon);
  connect(&evaluation_, &Evaluation::finished, this, soon);
  connect(&evaluation_, &Evaluation::status_changed, this, soon);
  fill();
}

void ProblemsPanel::set_theme(const Theme& theme) {
  theme_ = &theme;
  shown_.clear();
  list_->clear();
  fill();
}

std::vector<ProblemsPanel::Row> ProblemsPanel::rows() const {
  std::vector<Row> rows;
  // A file that was asked for and can't be opened comes first, named short.
  const Session::Refused& refused = session_.refused_file();
  const QString file = QFileInfo(refused.path).fileName();
  for (const Diagnostic& problem : refused.problems) {
    const QString where = place_of(problem);
    rows.push_back({problem.severity,
                    where.isEmpty() ? file : file + ": " + where,
                    problem_text(problem),
                    advice_on(problem),
                    QDir::toNativeSeparators(refused.path),
                    {}});
  }
  std::set<std::string> said;
  const auto add = [&](const Diagnostic& problem, const std::string& node) {
    // The structure's check and the run may say the same of one parameter in other words.
    const std::string about = node + "\n" + problem.code + "\n" + problem.param + problem.port + "\n";
    if (!said.insert(problem.param.empty() ? about + problem.message : about).second) return;
    const QString name = QString::fromStdString(node);
    const std::string& part = problem.port.empty() ? problem.param : problem.port;
    rows.push_back({shown_severity(problem),
                    part.empty() ? name : name + "." + QString::fromStdString(part),
                    problem_text(problem),
                    advice_on(problem),
                    {},
                    name});
  };
  for (const Severity severity : {Severity::error, Severity::warning, Severity::info}) {
    for (const Diagnostic& problem : session_.problems())
      if (shown_severity(problem) == severity) add(problem, problem.node);
    for (const auto& [name, node] : session_.document().nodes)
      if (const NodeStatus* status = evaluation_.status(name))
        for (const Diagnostic& problem : status->diagnostics)
          if (shown_severity(problem) == severity) add(problem, name);
    for (const Diagnostic& problem : evaluation_.log().diagnostics)
      if (shown_severity(problem) == severity) add(problem, problem.node);
  }
  return rows;
}

// Evaluation tells of itself many times a second; mostly nothing is new here.
void ProblemsPanel::fill() {
  std::vector<Row> fresh = rows();
  const bool same = fresh == shown_;
  shown_ = std::move(fresh);
  static_cast<QStackedLayout*>(layout())->setCurrentIndex(shown_.empty() ? 1 : 0);
  if (same) return;
  list_->clear();
  int errors = 0, warnings = 0;
  for (const Row& row : shown_) {
    errors += row.severity == Severity::error;
    warnings += row.severity == Severity::warning;
    auto* item = new QTreeWidgetItem({row.where, row.what, row.advice});
    item->setIcon(0, icon(row.severity == Severity::error     ? Sign::error
                          : row.severity == Severity::warning ? Sign::warning
                                                              : Sign::info,
                          *theme_));
    for (int column = 0; column < 3; ++column) item->setToolTip(column, item->text(column));
    if (!row.file.isEmpty()) item->setToolTip(0, row.file);
    item->setData(0, Qt::UserRole, row.node);
    list_->addTopLevelItem(item);
  }
  emit counted(errors, warnings);
}

}  // namespace kinegraph
