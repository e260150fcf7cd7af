#include "gui/look/ask_file.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFileSystemModel>
#include <QGridLayout>
#include <QHeaderView>
#include <QIdentityProxyModel>
#include <QLineEdit>
#include <QListView>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>
#include <QSplitter>
#include <QStandardPaths>
#include <QStyledItemDelegate>
#include <QTreeView>

#include "gui/look/words.h"

namespace kinegraph {
namespace {

enum Column { name_column, size_column, kind_column, date_column };
constexpr int url_role = Qt::UserRole + 1;  // of the list of places

// Dates and heads of columns in the editor's words; the arrow of what is sorted stands at its word.
class Files : public QIdentityProxyModel {
 public:
  using QIdentityProxyModel::QIdentityProxyModel;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override {
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
      return role == Qt::DecorationRole ? QVariant()
                                        : QIdentityProxyModel::headerData(section, orientation, role);
    const QString words = section == name_column   ? QObject::tr("Name")
                          : section == size_column ? QObject::tr("Size")
                          : section == date_column ? QObject::tr("Changed")
                                                   : QString();
    return section == sorted_ ? words + (up_ ? QStringLiteral(" ▴") : QStringLiteral(" ▾")) : words;
  }
  QVariant data(const QModelIndex& index, int role) const override {
    if (role == Qt::DisplayRole && index.column() == date_column)
      if (const auto* files = qobject_cast<const QFileSystemModel*>(sourceModel()))
        return QLocale(QLocale::English)
            .toString(files->lastModified(mapToSource(index)), "d MMM yyyy, HH:mm");
    return QIdentityProxyModel::data(index, role);
  }
  void sort(int column, Qt::SortOrder order) override {
    QIdentityProxyModel::sort(column, order);
    sorted_ = column;
    up_ = order == Qt::AscendingOrder;
    emit headerDataChanged(Qt::Horizontal, 0, columnCount() - 1);
  }

 private:
  int sorted_ = name_column;
  bool up_ = true;
};

// Names of places: a person's own folder is not called as their account is.
class Places : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    return {QStyledItemDelegate::sizeHint(option, index).width(), option.fontMetrics.height() + 12};
  }

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    if (index.data(url_role).toUrl().toLocalFile() == QDir::homePath()) option->text = QObject::tr("Home");
  }
};

QList<QUrl> places(const QString& here) {
  QList<QUrl> found;
  for (const QString& folder :
       {here, QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation), QDir::homePath()})
    if (const QUrl url = QUrl::fromLocalFile(QDir::cleanPath(folder));
        QFileInfo(folder).isDir() && !found.contains(url))
      found << url;
  return found << QUrl("file:");
}

// What Qt's own dialog is made of, put together as the other dialogs are. A system's dialog has none of it.
void set_parts(QFileDialog& dialog) {
  if (auto* grid = qobject_cast<QGridLayout*>(dialog.layout())) {
    grid->setContentsMargins(16, 14, 16, 14);
    grid->setHorizontalSpacing(10);
    grid->setVerticalSpacing(8);
    grid->setColumnStretch(1, 1);
    if (auto* buttons = dialog.findChild<QDialogButtonBox*>("buttonBox")) {
      grid->removeWidget(buttons);
      buttons->setOrientation(Qt::Horizontal);
      grid->addWidget(buttons, grid->rowCount(), 0, 1, grid->columnCount());
    }
    for (const char* wide : {"fileNameEdit", "fileTypeCombo"})
      if (auto* part = dialog.findChild<QWidget*>(wide)) {
        int row = 0, column = 0, rows = 1, columns = 1;
        grid->getItemPosition(grid->indexOf(part), &row, &column, &rows, &columns);
        grid->removeWidget(part);
        grid->addWidget(part, row, column, 1, grid->columnCount() - column);
      }
  }
  if (auto* files = dialog.findChild<QTreeView*>("treeView")) {
    QHeaderView* header = files->header();
    header->setStretchLastSection(false);
    header->setSectionResizeMode(QHeaderView::ResizeToContents);
    header->setSectionResizeMode(name_column, QHeaderView::Stretch);
    header->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    header->setFixedHeight(files->fontMetrics().height() + 12);
    files->setColumnHidden(kind_column, true);  // it is told by the name's end
  }
  // What is typed or pasted replaces the name that is offered, and the one that is marked in the list.
  if (auto* name = dialog.findChild<QLineEdit*>("fileNameEdit")) {
    name->selectAll();
    if (auto* list = dialog.findChild<QListView*>("listView"))
      QObject::connect(name, &QLineEdit::textEdited, list, [list] { list->selectionModel()->clear(); });
  }
  if (auto* split = dialog.findChild<QSplitter*>("splitter")) {
    split->setSizes({150, 590});
    split->setHandleWidth(8);
  }
  if (auto* list = dialog.findChild<QListView*>("sidebar")) {
    list->setIconSize({16, 16});
    list->setItemDelegate(new Places(list));
  }
  dialog.setSizeGripEnabled(false);
}

QString chosen(QFileDialog& dialog, const QString& start, const QString& filter) {
  const QFileInfo at(start);
  dialog.setProxyModel(new Files(&dialog));
  if (!filter.isEmpty()) dialog.setNameFilters(filter.split(";;"));
  dialog.setDirectory(at.isDir() ? at.absoluteFilePath() : at.absolutePath());
  const bool folder = dialog.fileMode() == QFileDialog::Directory;
  if (!folder && !at.isDir() && (at.exists() || dialog.acceptMode() == QFileDialog::AcceptSave))
    dialog.selectFile(at.absoluteFilePath());
  dialog.setSidebarUrls(places(dialog.directory().absolutePath()));
  set_parts(dialog);
  dialog.resize(780, 500);
  dialog.setLabelText(QFileDialog::LookIn, QObject::tr("Folder:"));
  dialog.setLabelText(QFileDialog::FileName, QObject::tr("Name:"));
  dialog.setLabelText(QFileDialog::FileType, QObject::tr("Kind:"));
  dialog.setLabelText(QFileDialog::Reject, QObject::tr("Cancel"));
  dialog.setLabelText(QFileDialog::Accept, dialog.acceptMode() == QFileDialog::AcceptSave
                                               ? QObject::tr("Save")
                                           : folder ? QObject::tr("Choose")
                                                    : QObject::tr("Open"));
  if (folder) {
    for (const char* kind : {"fileTypeLabel", "fileTypeCombo"})
      if (auto* part = dialog.findChild<QWidget*>(kind)) part->hide();
  }
  return dialog.exec() && !dialog.selectedFiles().isEmpty() ? dialog.selectedFiles().first() : QString();
}

bool may_replace(QWidget* parent, const QString& path) {
  QMessageBox box(QMessageBox::Warning, QObject::tr("Kinegraph"),
                  QObject::tr("Replace %1?").arg(QFileInfo(path).fileName()),
                  QMessageBox::Ok | QMessageBox::Cancel, parent);
  box.setInformativeText(QObject::tr("There is a file of that name. What it holds will be lost."));
  box.button(QMessageBox::Ok)->setText(QObject::tr("Replace"));
  box.setDefaultButton(QMessageBox::Cancel);
  return ask(box) == QMessageBox::Ok;
}

}  // namespace

QString ask_to_open(QWidget* parent, const QString& title, const QString& start, const QString& filter) {
  QFileDialog dialog(parent, title);
  dialog.setFileMode(QFileDialog::ExistingFile);
  return chosen(dialog, start, filter);
}

QString ask_where_to_save(QWidget* parent, const QString& title, const QString& start,
                          const QString& filter) {
  QFileDialog dialog(parent, title);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setFileMode(QFileDialog::AnyFile);
  dialog.setOption(
      QFileDialog::DontConfirmOverwrite);  // it is asked here, in the words of the other questions
  for (QString from = start;;) {
    const QString path = chosen(dialog, from, filter);
    if (path.isEmpty() || !QFileInfo::exists(path) || may_replace(parent, path)) return path;
    from = path;
  }
}

QString ask_for_folder(QWidget* parent, const QString& title, const QString& start) {
  QFileDialog dialog(parent, title);
  dialog.setFileMode(QFileDialog::Directory);
  dialog.setOption(QFileDialog::ShowDirsOnly);
  return chosen(dialog, start, {});
}

}  // namespace kinegraph
