#include "gui/window/relink_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "graph/nested.h"
#include "gui/canvas/canvas_edits.h"
#include "gui/look/ask_file.h"
#include "gui/panels/files_panel.h"

namespace kinegraph {
namespace {

constexpr int same_content = Qt::UserRole + 1;

}  // namespace

std::vector<MissingFile> missing_files(const Session& session) {
  std::vector<MissingFile> missing;
  for (const auto& [name, node] : session.document().nodes) {
    const NodeType* type = node.missing ? nullptr : session.registry().find(node.type);
    if (!type) continue;
    for (const auto& [key, value] : node.params) {
      const Param* param = type->find_param(key);
      if (!param || param->kind != ParamType::Kind::open_file || !value.is_string()) continue;
      const QString written = QString::fromStdString(value.string());
      if (written.isEmpty() || written.contains("${")) continue;
      const QString path = QDir::cleanPath(QDir(session.folder()).absoluteFilePath(written));
      if (!QFile::exists(path)) missing.push_back({name, key, path});
    }
  }
  return missing;
}

RelinkDialog::RelinkDialog(Session& session, const KnownFiles& known, std::vector<MissingFile> missing,
                           QWidget* parent)
    : QDialog(parent),
      session_(session),
      known_(known),
      missing_(std::move(missing)),
      table_(new QTableWidget(int(missing_.size()), 3, this)),
      state_(new QLabel(this)),
      progress_(new QProgressBar(this)) {
  setObjectName("relink_dialog");
  setWindowTitle(tr("Find missing files"));
  resize(820, 150 + 36 * int(std::clamp<std::size_t>(missing_.size() + 1, 3, 9)));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(10);
  auto* words = new QLabel(
      tr("These files aren't where the graph says. Files of the same name, or of the same content\n"
         "under another name, are looked for beside the graph."),
      this);
  column->addWidget(words);
  table_->setAccessibleName(tr("Missing files"));
  table_->setHorizontalHeaderLabels({tr("Node"), tr("Missing file"), tr("Use instead")});
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table_->horizontalHeader()->setSectionResizeMode(2, QHeaderView::Stretch);
  table_->setColumnWidth(0, 130);
  table_->setColumnWidth(1, 210);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(34);
  table_->setShowGrid(false);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setFocusPolicy(Qt::NoFocus);
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    const int row = int(i);
    table_->setItem(row, 0, new QTableWidgetItem(QString::fromStdString(missing_[i].node)));
    auto* file = new QTableWidgetItem(QFileInfo(missing_[i].path).fileName());
    file->setToolTip(QDir::toNativeSeparators(missing_[i].path));
    table_->setItem(row, 1, file);
    auto* choice = new QComboBox(table_);
    choice->setAccessibleName(tr("File for %1").arg(QString::fromStdString(missing_[i].node)));
    choice->addItem(tr("Searching…"));
    connect(choice, &QComboBox::currentIndexChanged, this, &RelinkDialog::update_state);
    table_->setCellWidget(row, 2, choice);
    choices_.push_back(choice);
  }
  column->addWidget(table_, 1);
  auto* row = new QHBoxLayout;
  progress_->setRange(0, 0);
  progress_->setTextVisible(false);
  progress_->setFixedSize(140, 8);
  progress_->setAccessibleName(tr("Search"));
  stop_ = new QPushButton(tr("Stop searching"), this);
  stop_->setAutoDefault(false);
  row->addWidget(state_, 1);
  row->addWidget(progress_);
  row->addWidget(stop_);
  column->addLayout(row);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  relink_ = buttons->addButton(tr("Relink"), QDialogButtonBox::AcceptRole);
  relink_->setDefault(true);
  auto* other = buttons->addButton(tr("Look in a folder…"), QDialogButtonBox::ResetRole);
  other->setAutoDefault(false);
  column->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &RelinkDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &RelinkDialog::reject);
  connect(other, &QPushButton::clicked, this, [this] {
    const QString folder = ask_for_folder(this, tr("Look in a folder"), session_.folder());
    if (!folder.isEmpty()) search({folder});
  });
  connect(stop_, &QPushButton::clicked, this, [this] {
    if (search_) search_->stop();
  });
  QStringList folders{session_.folder()};
  if (QDir up(session_.folder()); up.cdUp() && !up.isRoot()) folders << up.absolutePath();
  if (const QString examples = examples_folder(); !examples.isEmpty()) folders << examples;
  if (!choices_.empty()) choices_.front()->setFocus();
  search(folders);
}

void RelinkDialog::search(const QStringList& folders) {
  std::vector<FileSearch::Wanted> wanted;
  for (const MissingFile& one : missing_) wanted.push_back({one.path, known_.find(one.path)});
  search_ = std::make_unique<FileSearch>(std::move(wanted), folders);
  connect(search_.get(), &FileSearch::found, this, &RelinkDialog::add_found);
  files_ = 0;
  connect(search_.get(), &FileSearch::looked_at, this, [this](int files) {
    files_ = files;
    update_state();
  });
  connect(search_.get(), &QThread::finished, this, &RelinkDialog::update_state);
  search_->start();
  update_state();
}

void RelinkDialog::add_found(int row, const QString& path, bool same) {
  QComboBox* choice = choices_[std::size_t(row)];
  if (choice->findData(path) >= 0) return;
  QString shown = QDir(session_.folder()).relativeFilePath(path);
  if (same) shown += tr("  · same content");
  choice->addItem(shown, path);
  choice->setItemData(choice->count() - 1, QDir::toNativeSeparators(path), Qt::ToolTipRole);
  choice->setItemText(0, tr("Leave it missing"));
  choice->setItemData(choice->count() - 1, same, same_content);
  // The same content is surer than the same name, and what is nearer is looked at first.
  if (choice->currentIndex() == 0 || (same && !choice->currentData(same_content).toBool()))
    choice->setCurrentIndex(choice->count() - 1);
  update_state();
}

void RelinkDialog::update_state() {
  const bool busy = search_ && search_->isRunning();
  progress_->setVisible(busy);
  stop_->setVisible(busy);
  int found = 0, chosen = 0;
  for (QComboBox* choice : choices_) {
    found += choice->count() > 1;
    chosen += choice->currentIndex() > 0;
    if (choice->count() == 1) choice->setItemText(0, busy ? tr("Searching…") : tr("Nothing found"));
  }
  if (relink_) relink_->setEnabled(chosen > 0);
  const QString looked_at =
      files_ == 1 ? tr("1 file looked at") : tr("%1 files looked at").arg(QLocale().toString(files_));
  if (busy || found == int(choices_.size()))
    state_->setText(looked_at);
  else
    state_->setText((found ? looked_at + "." : tr("Nothing was found: %1.").arg(looked_at)) + " " +
                    tr("Look in another folder, such as an archive."));
}

void RelinkDialog::accept() {
  session_.perform([&](const Document& document, const Registry& registry) {
    std::vector<EditStep> steps;
    for (std::size_t i = 0; i < missing_.size(); ++i) {
      const QString path = choices_[i]->currentData().toString();
      if (path.isEmpty()) continue;
      steps.push_back([&, i, path](const Document& d, const Registry& r) {
        return set_param(d, r, missing_[i].node, missing_[i].param,
                         Json(session_.written_path(path).toStdString()));
      });
    }
    return one_after_another(document, registry, "Relink files", steps);
  });
  QDialog::accept();
}

}  // namespace kinegraph
