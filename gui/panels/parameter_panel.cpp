#include "gui/panels/parameter_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QScrollArea>
#include <QStackedLayout>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <set>
#include <utility>

#include "graph/nested.h"
#include "gui/canvas/node_painter.h"
#include "gui/document/problem_text.h"
#include "gui/panels/typed_words.h"
#include "gui/viewing/looked_at.h"
#include "nodes/motion/motion.h"

namespace kinegraph {
namespace {

constexpr int most_told = 3;                       // problems of a node, in the panel
constexpr int least_label = 80, most_label = 140;  // a column as wide as its longest name

QLabel* faint_label(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setObjectName("faint");
  label->setWordWrap(true);
  return label;
}

bool is_wide(const Param& param) {
  return param.kind == ParamType::Kind::list || param.kind == ParamType::Kind::table;
}

}  // namespace

ParameterPanel::ParameterPanel(Session& session, Evaluation& evaluation, QWidget* parent)
    : QWidget(parent), session_(session), evaluation_(evaluation), theme_(&dark_theme()) {
  setMinimumWidth(300);
  auto* stack = new QStackedLayout(this);
  auto* none = faint_label(tr("Select a node to see its parameters."), this);
  none->setAlignment(Qt::AlignCenter);
  none_ = none;
  some_ = new QWidget(this);
  stack->addWidget(none_);
  stack->addWidget(some_);
  auto* column = new QVBoxLayout(some_);
  column->setContentsMargins(10, 10, 10, 6);
  column->setSpacing(6);

  auto* head = new QGridLayout;
  head->setHorizontalSpacing(8);
  head->setVerticalSpacing(6);
  name_ = new ElidedLine(some_);
  name_->setObjectName("node_name");
  name_->setAccessibleName(tr("Name of the node"));
  enabled_ = new QCheckBox(tr("Enabled"), some_);
  enabled_->setAccessibleName(tr("Enabled"));
  note_ = new ElidedLine(some_);
  note_->setObjectName("node_note");
  note_->setAccessibleName(tr("Note"));
  note_->setPlaceholderText(tr("Add a note…"));
  type_label_ = new QLabel(some_);
  type_label_->setWordWrap(true);
  type_label_->setTextFormat(Qt::RichText);
  head->addWidget(name_, 0, 0);
  head->addWidget(enabled_, 0, 1);
  head->addWidget(type_label_, 1, 0, 1, 2);
  head->addWidget(note_, 2, 0, 1, 2);
  column->addLayout(head);
  state_ = new QLabel(some_);
  state_->setObjectName("node_state");
  state_->setWordWrap(true);
  state_->setTextFormat(Qt::RichText);
  state_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(state_);

  scroll_ = new QScrollArea(some_);
  scroll_->setObjectName("parameter_rows");
  scroll_->setWidgetResizable(true);
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll_->setFocusPolicy(Qt::NoFocus);
  column->addWidget(scroll_, 1);
  help_ = faint_label({}, some_);
  help_->setObjectName("param_help");
  help_->setIndent(0);
  help_->setTextFormat(Qt::RichText);
  help_->setAlignment(Qt::AlignTop);
  help_->setFixedHeight(help_height());
  column->addWidget(help_);

  connect(name_, &QLineEdit::editingFinished, this, [this] {
    const std::string wanted = name_->text().trimmed().toStdString(), before = node_;
    if (wanted.empty() || wanted == before || !session_.document().nodes.count(before)) return;
    if (session_.perform([&](const Document& d, const Registry&) { return rename_node(d, before, wanted); }))
      session_.select({wanted}, wanted);
    else
      name_->setText(QString::fromStdString(before));
  });
  connect(enabled_, &QCheckBox::clicked, this, [this](bool on) {
    session_.perform([&](const Document& d, const Registry&) { return set_enabled(d, node_, on); });
  });
  connect(note_, &QLineEdit::editingFinished, this, [this] {
    auto found = session_.document().nodes.find(node_);
    if (found == session_.document().nodes.end() || found->second.note == note_->text().toStdString()) return;
    session_.perform(
        [&](const Document& d, const Registry&) { return set_note(d, node_, note_->text().toStdString()); });
  });
  connect(&session_, &Session::page_changed, this, [this] { of_other_page_ = true; });
  connect(&session_, &Session::selection_changed, this, &ParameterPanel::show_node);
  connect(&session_, &Session::changed, this, &ParameterPanel::show_node);
  connect(&session_, &Session::problems_changed, this, &ParameterPanel::refresh_state);
  connect(&evaluation_, &Evaluation::status_changed, this, [this](const QString& node) {
    if (node.toStdString() == node_) refresh_state();
  });
  show_node();
}

// Two lines, and the line above them; more only for what needs more.
int ParameterPanel::help_height() const {
  return fontMetrics().lineSpacing() * 2 + 12;
}

void ParameterPanel::tell_help(const QString& text) {
  help_->setText(text);
  help_->setFixedHeight(std::max(help_height(), help_->heightForWidth(help_->width())));
}

void ParameterPanel::set_theme(const Theme& theme) {
  theme_ = &theme;
  refresh();
}

const NodeType* ParameterPanel::type() const {
  auto found = session_.document().nodes.find(node_);
  if (found == session_.document().nodes.end()) return nullptr;
  if (const NodeType* known = known_type(session_.registry(), found->second)) return known;
  // A Graph node whose file can't be used: what names the file is there to be mended.
  return found->second.missing ? nullptr : session_.registry().find(found->second.type);
}

void ParameterPanel::show_node() {
  // Whatever is still being typed was meant for the node before.
  const bool another = std::exchange(of_other_page_, false) || node_ != session_.current();
  node_ = session_.current();
  const auto found = session_.document().nodes.find(node_);
  const bool some = found != session_.document().nodes.end();
  static_cast<QStackedLayout*>(layout())->setCurrentIndex(some ? 1 : 0);
  static_cast<QLabel*>(none_)->setText(session_.selected().size() > 1
                                           ? tr("%1 nodes are selected.\nSelect one alone to see its "
                                                "parameters.")
                                                 .arg(session_.selected().size())
                                           : tr("Select a node to see its parameters."));
  if (!some) return;
  // Two Graph nodes may have different parameters, and one node others when its file changes.
  const NodeType* described = type();
  QStringList names{QString::fromStdString(found->second.type)};
  if (described)
    for (const Param& param : described->params) names << QString::fromStdString(param.name);
  const std::string rows = names.join('\n').toStdString();
  if (rows != node_type_ || found->second.missing) {
    node_type_ = rows;
    // One of the old fields may be what is telling of the change; what is left in them is of no use any more.
    for (const auto& [name, row] : rows_) row.field->disconnect(this);
    rows_.clear();
    if (QWidget* old = scroll_->takeWidget()) {
      old->hide();
      old->deleteLater();
    }
    if (described) {
      build(*described);
    } else {
      node_type_.clear();
      auto* words = faint_label(tr("It is saved back unchanged. Install the Kinegraph that made it, or what "
                                   "it came with, to run it."),
                                nullptr);
      words->setAlignment(Qt::AlignTop | Qt::AlignLeft);
      scroll_->setWidget(words);
    }
  }
  help_->setVisible(described && !described->params.empty());
  refresh(another);
}

void ParameterPanel::build(const NodeType& known) {
  auto* inside = new QWidget;
  auto* column = new QVBoxLayout(inside);
  column->setContentsMargins(0, 4, 2, 4);
  column->setSpacing(5);
  FieldContext context;
  context.folder = session_.folder();
  context.written_path = [this](const QString& path) { return session_.written_path(path); };
  context.joints = [this] { return joints(); };
  QFont bold = font();
  bold.setBold(true);
  int label_width = least_label;
  for (const Param& param : known.params)
    if (!is_wide(param))
      label_width = std::max(label_width,
                             QFontMetrics(bold).horizontalAdvance(QString::fromStdString(param.name) + " ↗"));
  label_width_ = std::min(label_width + 6, most_label);
  for (const Param& param : known.params) {
    const std::string name = param.name;
    Row row;
    row.line = new QWidget(inside);
    auto* grid = new QGridLayout(row.line);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(6);
    grid->setVerticalSpacing(2);
    row.label = new QLabel(QString::fromStdString(name), row.line);
    row.label->setFixedWidth(label_width_);
    row.label->setToolTip(QString::fromStdString(param.help));
    row.field = make_field(param, context, row.line);
    row.field->setObjectName("param_" + QString::fromStdString(name));
    row.field->setToolTip(QString::fromStdString(param.help));
    row.label->setBuddy(row.field);
    row.menu = new QToolButton(row.line);
    row.menu->setObjectName("row_menu");
    row.menu->setText("⋯");
    row.menu->setFixedWidth(24);
    row.menu->setAccessibleName(tr("More for %1").arg(QString::fromStdString(name)));
    row.menu->setToolTip(tr("Reset, publish, help"));
    row.mistake = new MistakeLine(row.line);
    grid->addWidget(row.mistake, 2, is_wide(param) ? 0 : 1, 1, is_wide(param) ? 3 : 2);
    if (is_wide(param)) {
      grid->setContentsMargins(0, 0, 0, 6);
      row.label->setMaximumWidth(QWIDGETSIZE_MAX);
      row.label->setMinimumWidth(0);
      grid->addWidget(row.label, 0, 0);
      grid->addWidget(row.menu, 0, 2);
      grid->addWidget(row.field, 1, 0, 1, 3);
      grid->setColumnStretch(1, 1);
    } else {
      grid->addWidget(row.label, 0, 0);
      grid->addWidget(row.field, 0, 1);
      grid->addWidget(row.menu, 0, 2);
      grid->setColumnStretch(1, 1);
    }
    for (QWidget* child : row.line->findChildren<QWidget*>()) {
      child->installEventFilter(this);
      child->setProperty("help", QString::fromStdString(param.help));
      child->setProperty("param", QString::fromStdString(name));
    }
    connect(row.field, &ParamField::edited, this, [this, name, field = row.field](const Json& value) {
      tell_mistake(name, {});
      set(name, value);
      // As it is kept, "1.5" for "3/2", though the keyboard is still there.
      if (const auto now = rows_.find(name); now != rows_.end() && now->second.field == field)
        field->show_value(now->second.value);
    });
    connect(row.field, &ParamField::drag_started, &session_, &Session::begin_gesture);
    connect(row.field, &ParamField::drag_ended, &session_, &Session::end_gesture);
    connect(row.field, &ParamField::wrong, this,
            [this, name](const QString& why) { tell_mistake(name, why); });
    connect(row.field, &ParamField::corrected, this, [this, name] { tell_mistake(name, {}); });
    QToolButton* button = row.menu;
    connect(button, &QToolButton::clicked, this, [this, name, button] { open_menu(name, button); });
    column->addWidget(row.line);
    rows_[name] = row;
  }
  if (known.params.empty())
    column->addWidget(
        faint_label(tr("%1 has no parameters.").arg(QString::fromStdString(known.name)), inside));
  column->addStretch(1);
  scroll_->setWidget(inside);
  // Numbers end on one line, whatever their units.
  int unit_width = 30;
  const QList<QLabel*> units = inside->findChildren<QLabel*>("unit");
  for (const QLabel* unit : units) unit_width = std::max(unit_width, unit->sizeHint().width());
  for (QLabel* unit : units) unit->setFixedWidth(unit_width);
  // Tab goes on from the note through the rows: widgets that come later would stand behind all other docks.
  QWidget* before = note_;
  for (QWidget* child : inside->findChildren<QWidget*>()) {
    if (!(child->focusPolicy() & Qt::TabFocus) || child->focusProxy() || child->window() != window() ||
        qobject_cast<QComboBox*>(child->parentWidget()))
      continue;
    setTabOrder(before, child);
    before = child;
  }
  tell_help(session_.is_read_only()
                ? tr("This graph may be read here, not changed: a newer Kinegraph wrote it.")
                : tr("Point at a parameter to read what it does."));
}

void ParameterPanel::refresh(bool another) {
  auto found = session_.document().nodes.find(node_);
  if (found == session_.document().nodes.end()) return;
  const Node& node = found->second;
  if (another || !name_->hasFocus()) {
    name_->setText(QString::fromStdString(node_));
    name_->setCursorPosition(0);
  }
  if (another || !note_->hasFocus()) {
    note_->setText(QString::fromStdString(node.note));
    note_->setCursorPosition(0);
  }
  enabled_->setChecked(node.enabled);
  const bool writable = !session_.is_read_only();
  enabled_->setEnabled(!node.missing && writable);
  name_->setReadOnly(!writable);
  note_->setReadOnly(!writable);
  const NodeType* known = type();
  type_label_->setText(QString("<b>%1</b> <span style='color:%2'>%3</span>")
                           .arg(QString::fromStdString(node.type).toHtmlEscaped(), theme_->faint_text.name(),
                                known ? QString::fromStdString(known->help).toHtmlEscaped() : QString()));
  for (auto& [name, row] : rows_) {
    const Param* param = known ? known->find_param(name) : nullptr;
    if (!param) continue;
    auto stored = node.params.find(name);
    const bool own = stored != node.params.end();
    const Json value = own ? stored->second : param->fallback.value_or(Json());
    // What was typed and doesn't fit stays until it is corrected or the value becomes another.
    const bool typed = row.field->is_being_edited() || (row.mistake->says_something() && value == row.value);
    if (another) row.field->drop_typed();
    if (another || !typed) {
      tell_mistake(name, {});
      row.field->show_value(value);
    }
    row.value = value;
    row.field->setEnabled(writable);
    row.menu->setEnabled(writable);
    QFont font = row.label->font();
    font.setBold(own && !is_default(*param, value));
    row.label->setFont(font);
    const std::string published = published_as(name);
    row.name = QString::fromStdString(name) + (published.empty() ? "" : " ↗");
  }
  fit_labels();
  refresh_state();
}

// The column of names gives way where the dock is narrow; what is cut ends in "…" and has a tool tip.
void ParameterPanel::fit_labels() {
  const NodeType* known = type();
  const int wide = std::min(label_width_, std::max(least_label, some_->width() * 36 / 100));
  for (auto& [name, row] : rows_) {
    const Param* param = known ? known->find_param(name) : nullptr;
    if (!param) continue;
    if (!is_wide(*param)) row.label->setFixedWidth(wide);
    row.label->setText(is_wide(*param)
                           ? row.name
                           : QFontMetrics(row.label->font()).elidedText(row.name, Qt::ElideRight, wide));
    const QString help = QString::fromStdString(param->help);
    row.label->setToolTip(row.label->text() == row.name ? help : row.name + "\n" + help);
  }
}

void ParameterPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fit_labels();
}

void ParameterPanel::refresh_state() {
  std::vector<std::pair<Severity, QString>> told;
  std::set<std::string> said;
  const auto say = [&](const Diagnostic& problem) {
    const Severity severity = shown_severity(problem);
    const QColor color = severity == Severity::error     ? theme_->error
                         : severity == Severity::warning ? theme_->warning
                                                         : theme_->faint_text;
    QString line = problem_text(problem).toHtmlEscaped();
    if (const std::string& where = problem.param.empty() ? problem.port : problem.param; !where.empty())
      line = "<b>" + QString::fromStdString(where).toHtmlEscaped() + "</b>: " + line;
    if (const QString advice = advice_on(problem); !advice.isEmpty())
      line +=
          QString("<br><span style='color:%1'>%2</span>").arg(theme_->text.name(), advice.toHtmlEscaped());
    // The structure's check and the run may say the same of one parameter in other words.
    if (!said.insert(problem.code + "\n" + problem.param + problem.port +
                     (problem.param.empty() ? "\n" + problem.message : std::string()))
             .second)
      return;
    told.emplace_back(problem.severity, QString("<div style='color:%1'>%2</div>").arg(color.name(), line));
  };
  for (const Diagnostic& problem : session_.problems())
    if (problem.node == node_) say(problem);
  if (const NodeStatus* status = evaluation_.status(node_))
    for (const Diagnostic& problem : status->diagnostics) say(problem);
  // The worst first, and not so many that the parameters have no room.
  QString text;
  int left = most_told;
  for (const Severity severity : {Severity::error, Severity::warning, Severity::info})
    for (const auto& [own, words] : told)
      if (own == severity && left-- > 0) text += words;
  if (left < 0)
    text += QString("<div style='color:%1'>%2</div>")
                .arg(theme_->faint_text.name(), tr("… and %1 more, see Problems").arg(-left));
  state_->setText(text);
  state_->setVisible(!text.isEmpty());
  mark_problems();
}

// A value that stands in the graph and doesn't fit, or made the node fail, is marked where it stands as well.
void ParameterPanel::mark_problems() {
  std::set<std::string> wrong;
  for (const Diagnostic& problem : session_.problems())
    if (problem.node == node_ && problem.severity == Severity::error)
      wrong.insert(problem.param.substr(0, problem.param.find_first_of(".[")));
  if (const NodeStatus* status = evaluation_.status(node_))
    for (const Diagnostic& problem : status->diagnostics)
      if (problem.severity == Severity::error && problem.port.empty())
        wrong.insert(problem.param.substr(0, problem.param.find_first_of(".[")));
  for (auto& [name, row] : rows_) row.field->mark_wrong(row.mistake->says_something() || wrong.count(name));
}

void ParameterPanel::tell_mistake(const std::string& param, const QString& why) {
  const auto found = rows_.find(param);
  if (found == rows_.end()) return;
  Row& row = found->second;
  const bool news = row.mistake->says_something() != !why.isEmpty();
  row.mistake->say(why);
  row.field->setAccessibleDescription(why);
  if (news) mark_problems();
  if (why.isEmpty()) return;
  // Once the sentence has its lines.
  QTimer::singleShot(0, row.mistake,
                     [this, seen = row.mistake] { scroll_->ensureWidgetVisible(seen, 0, 4); });
}

// Escape: what stands there is the value again. False where it is already.
bool ParameterPanel::give_up(const QString& param) {
  const auto found = rows_.find(param.toStdString());
  if (found == rows_.end()) return false;
  Row& row = found->second;
  if (!row.mistake->says_something() && !row.field->is_being_edited()) return false;
  row.field->drop_typed();
  row.field->show_value(row.value);
  tell_mistake(found->first, {});
  return true;
}

void ParameterPanel::set(const std::string& param, const Json& value) {
  const std::string node = node_;
  const NodeType* known = type();
  const Param* description = known ? known->find_param(param) : nullptr;
  if (!description) return;
  session_.perform([&](const Document& d, const Registry& r) {
    if (!(value.is_string() && value.string().starts_with("${")) && is_default(*description, value) &&
        !has_error(check(*description, value, param)))
      return reset_param(d, node, param);
    return set_param(d, r, node, param, value);
  });
}

std::string ParameterPanel::published_as(const std::string& param) const {
  for (const auto& [name, targets] : session_.document().publish.params)
    for (const Link& target : targets)
      if (target.node == node_ && target.port == param) return name;
  return {};
}

void ParameterPanel::publish(const std::string& param, bool on) {
  const std::string node = node_;
  session_.perform([&](const Document& document, const Registry&) {
    if (!on) {
      const std::string name = published_as(param);
      Json::Array left;
      for (const Link& target : document.publish.params.at(name))
        if (!(target.node == node && target.port == param)) left.push_back(to_text(target));
      std::optional<Json> after;
      if (left.size() == 1) after = left.front();
      if (left.size() > 1) after = Json(std::move(left));
      return set_unit(document, {Unit::Kind::publish_param, name, {}}, after, "Unpublish " + param);
    }
    std::string name = param == "file" ? node : param;
    if (document.publish.params.count(name)) name = node + "_" + param;
    return set_unit(document, {Unit::Kind::publish_param, name, {}}, Json(node + "." + param),
                    "Publish " + param);
  });
}

void ParameterPanel::open_menu(const std::string& param, QToolButton* button) {
  const NodeType* known = type();
  const Param* description = known ? known->find_param(param) : nullptr;
  if (!description) return;
  QMenu menu(this);
  const auto& node = session_.document().nodes.at(node_);
  const QString usual = fontMetrics().elidedText(
      typed_text(*description, description->fallback.value_or(Json())), Qt::ElideRight, 200);
  QAction* reset = menu.addAction(
      usual.isEmpty() ? tr("Reset to default") : tr("Reset to default (%1)").arg(usual), this, [this, param] {
        session_.perform([&](const Document& d, const Registry&) { return reset_param(d, node_, param); });
      });
  reset->setEnabled(node.params.count(param) > 0);
  const std::string published = published_as(param);
  menu.addAction(
      published.empty() ? tr("Publish") : tr("Unpublish (%1)").arg(QString::fromStdString(published)), this,
      [this, param, on = published.empty()] { publish(param, on); });
  menu.addAction(tr("Help"), this, [this, description] {
    QString text = QString::fromStdString(description->help).toHtmlEscaped() + "<br>" +
                   QString::fromStdString(described(*description)).toHtmlEscaped();
    for (const ParamType::Choice& choice : description->choices)
      text += "<br><b>" + QString::fromStdString(choice.key).toHtmlEscaped() +
              "</b>: " + QString::fromStdString(choice.help).toHtmlEscaped();
    tell_help(text);
  });
  menu.exec(button->mapToGlobal(QPoint(0, button->height())));
}

bool ParameterPanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape &&
      give_up(watched->property("param").toString()))
    return true;
  if (event->type() == QEvent::FocusIn || event->type() == QEvent::Enter) {
    if (const QVariant help = watched->property("help"); help.isValid()) {
      tell_help(help.toString().toHtmlEscaped());
    }
    if (event->type() == QEvent::FocusIn)
      if (auto* widget = qobject_cast<QWidget*>(watched)) scroll_->ensureWidgetVisible(widget, 10, 10);
  }
  return QWidget::eventFilter(watched, event);
}

std::vector<std::pair<std::string, int>> ParameterPanel::joints() const {
  std::vector<std::pair<std::string, int>> found;
  const auto target = nearest_output(session_.document(), session_.registry(), node_, {"Motion"});
  if (!target) return found;
  const auto motion = std::dynamic_pointer_cast<const Motion>(evaluation_.value(target->node, target->port));
  if (!motion) return found;
  for (const Joint& joint : motion->skeleton().joints) found.emplace_back(joint.name, joint.parent);
  return found;
}

}  // namespace kinegraph
