#include "gui/panels/files_panel.h"

#include <QCoreApplication>
#include <QDir>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QUrl>
#include <QVBoxLayout>
#include <vector>

#include "gui/look/ask_file.h"
#include "gui/look/icons.h"
#include "gui/look/settings.h"

namespace kinegraph {
namespace {

constexpr int path_role = Qt::UserRole;

// Files leave it as paths, so that any program takes them.
class FileTree : public QTreeWidget {
 public:
  using QTreeWidget::QTreeWidget;

 protected:
  QMimeData* mimeData(const QList<QTreeWidgetItem*>& items) const override {
    QList<QUrl> urls;
    for (const QTreeWidgetItem* item : items)
      if (const QString path = item->data(0, path_role).toString(); !path.isEmpty())
        urls << QUrl::fromLocalFile(path);
    if (urls.isEmpty()) return nullptr;
    auto* paths = new QMimeData;
    paths->setUrls(urls);
    return paths;
  }
};

}  // namespace

QString examples_folder() {
  QDir folder(QCoreApplication::applicationDirPath());
  for (int up = 0; up < 5; ++up) {
    for (const char* name : {"graphs", "share/kinegraph/graphs"})
      if (QDir(folder.filePath(name)).entryList({"*.kg.json"}).size()) return folder.filePath(name);
    if (!folder.cdUp()) break;
  }
  return {};
}

FilesPanel::FilesPanel(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      theme_(&dark_theme()),
      filter_(new QLineEdit(this)),
      tree_(new FileTree(this)),
      walk_(new ClipWalk(this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  filter_->setPlaceholderText(tr("Filter by name"));
  filter_->setAccessibleName(tr("Filter files by name"));
  filter_->setClearButtonEnabled(true);
  tree_->setObjectName("file_tree");
  tree_->setAccessibleName(tr("Files"));
  tree_->setHeaderHidden(true);
  tree_->setDragEnabled(true);
  tree_->setDragDropMode(QAbstractItemView::DragOnly);
  tree_->setTextElideMode(Qt::ElideMiddle);
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  auto* more = new QPushButton(tr("Add a folder…"), this);
  more->setAccessibleName(tr("Add a folder of clips"));
  more->setToolTip(tr("Lists the clips of another folder too"));
  row->addWidget(filter_, 1);
  row->addWidget(more);
  column->addLayout(row);
  connect(more, &QPushButton::clicked, this, [this] {
    const QString folder = ask_for_folder(this, tr("A folder of clips"), session_.folder());
    if (folder.isEmpty()) return;
    const auto settings = user_settings();
    QStringList folders = settings->value("assets").toStringList();
    if (!folders.contains(folder)) folders << folder;
    settings->setValue("assets", folders);
    settings->sync();
    look();
  });
  column->addWidget(tree_, 1);
  connect(filter_, &QLineEdit::textChanged, this, &FilesPanel::fill);
  connect(tree_, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* item) {
    const QString path = item->data(0, path_role).toString();
    if (path.endsWith(".kg.json"))
      emit open_graph(path);
    else if (!path.isEmpty())
      emit add_clip(path);
  });
  connect(&session_, &Session::file_changed, this, [this] {
    if (folder_ != clip_folder()) look();
  });
  connect(walk_, &ClipWalk::found, this, [this](const QString& folder, const QStringList& clips) {
    clips_[folder] = clips;
    fill();
  });
  look();
}

// The clips beside the graph, or of the examples where there is no graph.
QString FilesPanel::clip_folder() const {
  return session_.path().isEmpty() ? examples_folder() : session_.folder();
}

void FilesPanel::look() {
  folder_ = clip_folder();
  QStringList folders;
  if (!folder_.isEmpty()) folders << folder_;
  folders += user_settings()->value("assets").toStringList();
  walk_->look_through(folders);
  fill();
}

void FilesPanel::set_theme(const Theme& theme) {
  theme_ = &theme;
  fill();
}

void FilesPanel::fill() {
  tree_->clear();
  const QString wanted = filter_->text().trimmed();
  const auto section = [this](const QString& title) {
    auto* item = new QTreeWidgetItem(tree_, {title});
    QFont bold = font();
    bold.setBold(true);
    item->setFont(0, bold);
    item->setFlags(Qt::ItemIsEnabled);
    return item;
  };
  const auto add = [&](QTreeWidgetItem* parent, const QString& path, const QString& shown, Sign sign) {
    if (!wanted.isEmpty() && !shown.contains(wanted, Qt::CaseInsensitive)) return;
    auto* item = new QTreeWidgetItem(parent, {shown});
    item->setData(0, path_role, path);
    item->setToolTip(0, QDir::toNativeSeparators(path));
    item->setIcon(0, icon(sign, *theme_));
  };
  const QString folder = examples_folder();
  // An example's name is words wherever it is listed.
  const auto name_of = [&](const QFileInfo& file) {
    const QString name = file.fileName().remove(".kg.json");
    const bool example = !folder.isEmpty() && file.absoluteDir() == QDir(folder);
    return example ? QString(name).replace('_', ' ') : name;
  };
  auto* recent = section(tr("Recent graphs"));
  for (const QString& path : user_settings()->value("recent").toStringList())
    if (QFile::exists(path)) add(recent, path, name_of(QFileInfo(path)), Sign::graph);
  auto* examples = section(tr("Examples"));
  if (!folder.isEmpty())
    for (const QFileInfo& file : QDir(folder).entryInfoList({"*.kg.json"}, QDir::Files, QDir::Name))
      add(examples, file.absoluteFilePath(), name_of(file), Sign::graph);
  std::vector<QTreeWidgetItem*> sections{recent, examples};
  const auto add_clips = [&](const QString& title, const QString& in) {
    sections.push_back(section(title));
    sections.back()->setToolTip(0, QDir::toNativeSeparators(in));
    const auto known = clips_.find(in);
    if (known == clips_.end()) {
      auto* looking = new QTreeWidgetItem(sections.back(), {tr("Looking…")});
      looking->setFlags(Qt::NoItemFlags);
      return;
    }
    for (const QString& path : known->second)
      add(sections.back(), path, QDir(in).relativeFilePath(path), Sign::clip);
  };
  if (!folder_.isEmpty()) add_clips(tr("Clips"), folder_);
  for (const QString& assets : user_settings()->value("assets").toStringList())
    if (QDir(assets).exists()) add_clips(QDir(assets).dirName(), assets);
  bool any = false;
  for (QTreeWidgetItem* item : sections) {
    item->setExpanded(true);
    any = any || item->childCount();
    if (item->childCount()) continue;
    item->setHidden(!wanted.isEmpty());
    auto* none = new QTreeWidgetItem(item, {tr("None yet")});
    none->setFlags(Qt::NoItemFlags);
  }
  if (!any && !wanted.isEmpty()) {
    auto* none = new QTreeWidgetItem(tree_, {tr("No graph or clip is called “%1”").arg(wanted)});
    none->setFlags(Qt::NoItemFlags);
  }
}

}  // namespace kinegraph
