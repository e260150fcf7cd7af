#include "gui/panels/problems_panel.h"

#include <QHeaderView>
#include <QLabel>
#include <QPainter>
#include <QStackedLayout>
#include <set>

namespace kinegraph {
namespace {

QIcon mark(const QColor& color) {
  QPixmap pixmap(24, 24);
  pixmap.fill(Qt::transparent);
  QPainter p(&pixmap);
  p.setRenderHint(QPainter::Antialiasing);
  p.setPen(Qt::NoPen);
  p.setBrush(color);
  p.drawEllipse(5, 5, 14, 14);
  return QIcon(pixmap);
}

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
  list_->setUniformRowHeights(true);
  list_->header()->setStretchLastSection(true);
  list_->setColumnWidth(0, 150);
  list_->setColumnWidth(1, 420);
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
  fill();
}

void ProblemsPanel::fill() {
  list_->clear();
  int errors = 0, warnings = 0;
  std::set<std::string> said;
  const auto add = [&](const Diagnostic& problem, const std::string& node) {
    // The structure's check and the run may say the same of one parameter in other words.
    const std::string about = node + "\n" + problem.code + "\n" + problem.param + problem.port + "\n";
    if (!said.insert(problem.param.empty() ? about + problem.message : about).second) return;
    errors += problem.severity == Severity::error;
    warnings += problem.severity == Severity::warning;
    QString where = QString::fromStdString(node);
    if (const std::string& part = problem.port.empty() ? problem.param : problem.port; !part.empty())
      where += "." + QString::fromStdString(part);
    QString what = QString::fromStdString(problem.message);
    if (!problem.joint.empty()) what += tr(", joint %1").arg(QString::fromStdString(problem.joint));
    if (problem.frame) what += tr(", frame %1").arg(*problem.frame);
    auto* item = new QTreeWidgetItem({where, what, QString::fromStdString(problem.hint)});
    item->setIcon(0, mark(problem.severity == Severity::error     ? theme_->error
                          : problem.severity == Severity::warning ? theme_->warning
                                                                  : theme_->accent));
    item->setData(0, Qt::UserRole, QString::fromStdString(node));
    for (int column = 0; column < 3; ++column) item->setToolTip(column, item->text(column));
    list_->addTopLevelItem(item);
  };
  for (const Severity severity : {Severity::error, Severity::warning, Severity::info}) {
    for (const Diagnostic& problem : session_.problems())
      if (problem.severity == severity) add(problem, problem.node);
    for (const auto& [name, node] : session_.document().nodes)
      if (const NodeStatus* status = evaluation_.status(name))
        for (const Diagnostic& problem : status->diagnostics)
          if (problem.severity == severity) add(problem, name);
    for (const Diagnostic& problem : evaluation_.log().diagnostics)
      if (problem.severity == severity) add(problem, problem.node);
  }
  static_cast<QStackedLayout*>(layout())->setCurrentIndex(list_->topLevelItemCount() ? 0 : 1);
  emit counted(errors, warnings);
}

}  // namespace kinegraph
