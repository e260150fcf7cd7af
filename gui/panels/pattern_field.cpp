// A joint pattern: typed, or put together by ticking joints in the skeleton's tree.
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <QWidgetAction>

#include "graph/work.h"
#include "gui/panels/text_field.h"
#include "nodes/motion/joint_pattern.h"

namespace kinegraph {
namespace {

using Joints = std::vector<std::pair<std::string, int>>;

QString escaped(const std::string& name) {
  QString text;
  for (const QChar c : QString::fromStdString(name)) {
    if (QString(",*>-\\").contains(c)) text += '\\';
    text += c;
  }
  return text;
}

// The shortest pattern for what is ticked: whole branches as "Name>", single joints by name.
QString pattern_of(const Joints& joints, const std::vector<bool>& ticked) {
  const std::size_t count = joints.size();
  bool all = true;
  for (bool one : ticked) all = all && one;
  if (all) return "*";
  std::vector<bool> whole(ticked), leaf(count, true);
  for (std::size_t i = count; i-- > 0;) {
    const int parent = joints[i].second;
    if (parent < 0) continue;
    leaf[std::size_t(parent)] = false;
    if (!whole[i]) whole[std::size_t(parent)] = false;
  }
  QStringList parts;
  std::vector<bool> said(count);
  for (std::size_t i = 0; i < count; ++i) {
    const int parent = joints[i].second;
    if (parent >= 0 && said[std::size_t(parent)] && whole[std::size_t(parent)]) {
      said[i] = true;
      continue;
    }
    if (!ticked[i]) continue;
    parts << escaped(joints[i].first) + (whole[i] && !leaf[i] ? ">" : "");
    said[i] = whole[i];
  }
  return parts.join(", ");
}

class PatternField : public TextField {
 public:
  PatternField(const Param& param, const FieldContext& context, QWidget* parent)
      : TextField(param, parent), context_(context) {
    line_->setPlaceholderText(tr("joints: *Leg*, Spine>, -Head"));
    auto* button = new QToolButton(this);
    button->setText(tr("Joints"));
    button->setAccessibleName(tr("Choose joints for %1").arg(QString::fromStdString(param.name)));
    button->setToolTip(tr("Choose joints in the skeleton's tree"));
    layout()->addWidget(button);
    connect(button, &QToolButton::clicked, this, [this, button] { open_tree(button); });
  }

 private:
  void open_tree(QWidget* below) {
    const Joints joints = context_.joints ? context_.joints() : Joints();
    QMenu menu(this);
    auto* tree = new QTreeWidget;
    tree->setHeaderHidden(true);
    tree->setMinimumSize(280, 440);
    tree->setFrameShape(QFrame::NoFrame);
    tree->setAccessibleName(tr("Joints"));
    std::vector<std::string> names;
    for (const auto& [name, parent] : joints) names.push_back(name);
    std::vector<bool> ticked(joints.size());
    try {
      ticked = chosen(joints);
    } catch (const Failure&) {
      // What is typed doesn't fit this skeleton: the tree starts without ticks.
    }
    std::vector<QTreeWidgetItem*> items;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const int parent = joints[i].second;
      auto* item = parent >= 0 ? new QTreeWidgetItem(items[std::size_t(parent)]) : new QTreeWidgetItem(tree);
      item->setText(0, QString::fromStdString(names[i]));
      item->setSizeHint(0, QSize(0, tree->fontMetrics().height() + 6));
      item->setCheckState(0, ticked[i] ? Qt::Checked : Qt::Unchecked);
      items.push_back(item);
    }
    tree->expandAll();
    if (joints.empty()) new QTreeWidgetItem(tree, {tr("Link a motion to see its joints.")});
    bool changed = false;
    // A tick goes down the branch, as limbs are chosen more often than single joints.
    connect(tree, &QTreeWidget::itemChanged, tree, [&](QTreeWidgetItem* item) {
      changed = true;
      if (QGuiApplication::keyboardModifiers() & Qt::ControlModifier) return;
      for (int i = 0; i < item->childCount(); ++i) item->child(i)->setCheckState(0, item->checkState(0));
    });
    auto* box = new QWidget;
    auto* column = new QVBoxLayout(box);
    column->setContentsMargins(4, 4, 4, 4);
    column->addWidget(tree);
    if (!joints.empty()) {
      auto* words = new QLabel(tr("A tick takes the whole branch; with Ctrl only the joint."), box);
      words->setObjectName("faint");
      words->setMargin(4);
      column->addWidget(words);
    }
    auto* action = new QWidgetAction(&menu);
    action->setDefaultWidget(box);
    menu.addAction(action);
    menu.exec(below->mapToGlobal(QPoint(0, below->height())));
    if (!changed || joints.empty()) return;
    for (std::size_t i = 0; i < joints.size(); ++i) ticked[i] = items[i]->checkState(0) == Qt::Checked;
    const QString text = pattern_of(joints, ticked);
    if (text != shown_) emit edited(Json(text.toStdString()));
  }
  std::vector<bool> chosen(const Joints& joints) const {
    Skeleton skeleton;
    for (const auto& [name, parent] : joints) {
      Joint joint;
      joint.name = name;
      joint.parent = parent;
      skeleton.joints.push_back(std::move(joint));
    }
    Alone work;
    return chosen_joints(shown_.toStdString(), skeleton, type_.name, work);
  }

  FieldContext context_;
};

}  // namespace

ParamField* make_pattern_field(const Param& param, const FieldContext& context, QWidget* parent) {
  return new PatternField(param, context, parent);
}

}  // namespace kinegraph
