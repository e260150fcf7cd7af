#include "gui/look/ask_file.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHeaderView>
#include <QLineEdit>
#include <QListView>
#include <QMessageBox>
#include <QPushButton>
#include <QSplitter>
#include <QTreeView>

namespace kinegraph {
namespace {

QString chosen(QFileDialog& dialog, const QString& start, const QString& filter) {
  const QFileInfo at(start);
  if (!filter.isEmpty()) dialog.setNameFilters(filter.split(";;"));
  dialog.setDirectory(at.isDir() ? at.absoluteFilePath() : at.absolutePath());
  const bool folder = dialog.fileMode() == QFileDialog::Directory;
  if (!folder && !at.isDir() && (at.exists() || dialog.acceptMode() == QFileDialog::AcceptSave))
    dialog.selectFile(at.absoluteFilePath());
  dialog.resize(760, 480);
  // Qt's own dialog; a system's has none of these.
  if (auto* files = dialog.findChild<QTreeView*>("treeView")) {
    files->header()->setStretchLastSection(false);
    files->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    files->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    files->header()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    files->header()->setFixedHeight(files->fontMetrics().height() + 12);
    files->setColumnHidden(2, true);  // the kind is told by the name's end
  }
  // What is typed or pasted replaces the name that is offered, and the one that is marked in the list.
  if (auto* name = dialog.findChild<QLineEdit*>("fileNameEdit")) {
    name->selectAll();
    if (auto* list = dialog.findChild<QListView*>("listView"))
      QObject::connect(name, &QLineEdit::textEdited, list, [list] { list->selectionModel()->clear(); });
  }
  if (auto* split = dialog.findChild<QSplitter*>("splitter")) {
    split->setSizes({150, 590});
    split->setHandleWidth(6);
  }
  if (auto* places = dialog.findChild<QListView*>("sidebar")) places->setIconSize({16, 16});
  dialog.setSizeGripEnabled(false);
  dialog.setLabelText(QFileDialog::LookIn, QObject::tr("Folder:"));
  dialog.setLabelText(QFileDialog::FileType, QObject::tr("Kinds:"));
  if (folder) {
    dialog.setLabelText(QFileDialog::FileName, QObject::tr("Folder:"));
    for (const char* kind : {"fileTypeLabel", "fileTypeCombo"})
      if (auto* part = dialog.findChild<QWidget*>(kind)) part->hide();
    // Without a row for kinds of files the buttons stand side by side.
    if (auto* buttons = dialog.findChild<QDialogButtonBox*>("buttonBox"))
      buttons->setOrientation(Qt::Horizontal);
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
  return box.exec() == QMessageBox::Ok;
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
